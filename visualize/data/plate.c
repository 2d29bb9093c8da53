// Enlarging copies bytes; only shrinking has to go through linear light and back.
#include "plate.h"

#include "png.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int least(int a, int b)
{
    return a < b ? a : b;
}

static int ceil_ratio(int a, int b)
{
    return b > 0 ? (a + b - 1) / b : a;
}

int pm_plate_fit(int width, int height, int room_width, int room_height)
{
    if (width <= room_width && height <= room_height) {
        return least(room_width / width, room_height / height);
    }
    int across = ceil_ratio(width, room_width);
    int down = ceil_ratio(height, room_height);
    return -(across > down ? across : down);
}

int pm_plate_length(int length, int zoom)
{
    return zoom > 0 ? length * zoom : ceil_ratio(length, -zoom);
}

const char *pm_plate_zoom_text(int zoom, char *text, size_t room)
{
    snprintf(text, room, zoom > 0 ? "%dx" : "1/%d", abs(zoom));
    return text;
}

pm_status pm_plate_make(int width, int height, pm_plate *plate)
{
    uint8_t *pixels = calloc((size_t)width * (size_t)height, 3);
    if (pixels == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for a picture of %dx%d", width, height);
    }
    *plate = (pm_plate){width, height, pixels};
    return PM_OK;
}

pm_status pm_plate_of(const char *name, const pm_image *image, double exposure, pm_plate *plate)
{
    pm_plate made;
    PM_TRY(pm_plate_make(image->width, image->height, &made));
    pm_status status = pm_png_pixels(name, image, exposure, made.pixels);
    if (status != PM_OK) {
        pm_plate_free(&made);
        return status;
    }
    *plate = made;
    return PM_OK;
}

static const uint8_t *pixel_of(const pm_plate *plate, int x, int y)
{
    return plate->pixels + 3 * ((size_t)y * (size_t)plate->width + (size_t)x);
}

// The sRGB curve of IEC 61966-2-1 and back, on [0, 1].
static double decode(double coded)
{
    return coded <= 0.04045 ? coded / 12.92 : pow((coded + 0.055) / 1.055, 2.4);
}

static double encode(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

/// What `side` x `side` pixels from (x, y) on, as far as there are, look like from afar.
static void melt(const pm_plate *from, int x, int y, int side, const double light[256],
                 uint8_t *to)
{
    double sum[3] = {0.0, 0.0, 0.0};
    int right = least(x + side, from->width);
    int bottom = least(y + side, from->height);
    for (int v = y; v < bottom; v++) {
        for (int u = x; u < right; u++) {
            for (int c = 0; c < 3; c++) {
                sum[c] += light[pixel_of(from, u, v)[c]];
            }
        }
    }
    double count = (double)(right - x) * (double)(bottom - y);
    for (int c = 0; c < 3; c++) {
        to[c] = (uint8_t)lround(255.0 * encode(sum[c] / count));
    }
}

static void shrink(const pm_plate *from, int side, pm_plate *to)
{
    double light[256];
    for (int i = 0; i < 256; i++) {
        light[i] = decode(i / 255.0);
    }
    uint8_t *next = to->pixels;
    for (int y = 0; y < to->height; y++) {
        for (int x = 0; x < to->width; x++) {
            melt(from, x * side, y * side, side, light, next);
            next += 3;
        }
    }
}

static void enlarge(const pm_plate *from, int zoom, pm_plate *to)
{
    uint8_t *next = to->pixels;
    for (int y = 0; y < to->height; y++) {
        for (int x = 0; x < to->width; x++) {
            memcpy(next, pixel_of(from, x / zoom, y / zoom), 3);
            next += 3;
        }
    }
}

pm_status pm_plate_zoom(pm_plate *plate, int zoom)
{
    pm_plate zoomed = {0};
    PM_TRY(pm_plate_make(pm_plate_length(plate->width, zoom),
                         pm_plate_length(plate->height, zoom), &zoomed));
    if (zoom > 0) {
        enlarge(plate, zoom, &zoomed);
    } else {
        shrink(plate, -zoom, &zoomed);
    }
    pm_plate_free(plate);
    *plate = zoomed;
    return PM_OK;
}

void pm_plate_free(pm_plate *plate)
{
    free(plate->pixels);
    *plate = (pm_plate){0};
}

// 8-bit sRGB by libpng. Only here do pictures lose what is above 1 or below 0.
#include "png.h"

#include "file.h"

#include <errno.h>
#include <libpng16/png.h> // by folder: <png.h> would find the header beside this file
#include <math.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

static void fail_png(png_structp png, png_const_charp message)
{
    (void)message;
    longjmp(png_jmpbuf(png), 1);
}

static void ignore_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

// Nothing of this frame is touched between setjmp and longjmp, so nothing can be clobbered.
static pm_status write_rows(png_structp png, png_infop info, pm_file *file,
                            const uint8_t *pixels, int width, int height)
{
    if (setjmp(png_jmpbuf(png)) != 0) {
        return pm_status_fail(PM_EIO, "%s: cannot be written: %s", file->path,
                              errno != 0 ? strerror(errno) : "libpng failed");
    }
    errno = 0;
    png_init_io(png, file->stream);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(png, info);
    for (int y = 0; y < height; y++) {
        png_write_row(png, pixels + (size_t)y * (size_t)width * 3);
    }
    png_write_end(png, info);
    return PM_OK;
}

static pm_status write_to(pm_file *file, const uint8_t *pixels, int width, int height)
{
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, fail_png, ignore_warning);
    png_infop info = png != NULL ? png_create_info_struct(png) : NULL;
    if (info == NULL) {
        png_destroy_write_struct(&png, NULL);
        return PM_FAIL(PM_ENOMEM, "no memory to write a PNG");
    }
    pm_status status = write_rows(png, info, file, pixels, width, height);
    png_destroy_write_struct(&png, &info);
    return status;
}

pm_status pm_png_write_bytes(const char *path, const uint8_t *pixels, int width, int height)
{
    if (width < 1 || height < 1 || width > 65536 || height > 65536) {
        return PM_FAIL(PM_EINPUT, "a PNG is 1 to 65536 pixels a side, got %dx%d", width,
                       height);
    }
    pm_file file;
    PM_TRY(pm_file_begin(path, &file));
    pm_status status = write_to(&file, pixels, width, height);
    if (status != PM_OK) {
        pm_file_abandon(&file);
        return status;
    }
    return pm_file_commit(&file);
}

// The sRGB curve of IEC 61966-2-1, on [0, 1].
static double encode_srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1.0 / 2.4) - 0.055;
}

pm_status pm_png_pixels(const char *name, const pm_image *image, double exposure,
                        uint8_t *pixels)
{
    static const char *const names[3] = {"R", "G", "B"};
    double gain = exp2(exposure);
    size_t count = (size_t)image->width * (size_t)image->height;
    for (int c = 0; c < 3; c++) {
        const float *plane = pm_image_plane(image, names[c]);
        if (plane == NULL) {
            return PM_FAIL(PM_EINPUT, "a PNG needs the channels R, G and B; %s is missing",
                           names[c]);
        }
        for (size_t i = 0; i < count; i++) {
            if (isnan(plane[i])) {
                return pm_status_fail(PM_EINPUT, "%s: pixel %zu,%zu of channel %s is NaN", name,
                                      i % (size_t)image->width, i / (size_t)image->width,
                                      names[c]);
            }
            double linear = fmin(fmax((double)plane[i] * gain, 0.0), 1.0);
            pixels[3 * i + (size_t)c] = (uint8_t)lround(255.0 * encode_srgb(linear));
        }
    }
    return PM_OK;
}

pm_status pm_png_write(const char *path, const pm_image *image, double exposure)
{
    size_t count = (size_t)image->width * (size_t)image->height;
    uint8_t *pixels = malloc(count * 3);
    if (pixels == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory to write a PNG");
    }
    pm_status status = pm_png_pixels(path, image, exposure, pixels);
    if (status == PM_OK) {
        status = pm_png_write_bytes(path, pixels, image->width, image->height);
    }
    free(pixels);
    return status;
}

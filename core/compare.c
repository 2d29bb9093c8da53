// The pair, its mask and its measures. What they mean is judged in compare_judge.c.
#include "compare.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const channel_names[3] = {"R", "G", "B"};

static const float *find_channel(const pm_image *image, const char *layer, int channel)
{
    char name[48];
    snprintf(name, sizeof name, "%s%s%s", layer, layer[0] != '\0' ? "." : "",
             channel_names[channel]);
    return pm_image_plane(image, name);
}

static bool has_layer(const pm_image *image, const char *layer)
{
    return find_channel(image, layer, 0) != NULL && find_channel(image, layer, 1) != NULL &&
           find_channel(image, layer, 2) != NULL;
}

static size_t pixel_count(const pm_image *image)
{
    return (size_t)image->width * (size_t)image->height;
}

bool pm_compare_has(const pm_compare_pair *pair, const char *layer)
{
    return has_layer(pair->image[0], layer) && has_layer(pair->image[1], layer);
}

static pm_status check_finite(const pm_image *image, const char *name)
{
    size_t width = (size_t)image->width;
    for (int c = 0; c < image->channel_count; c++) {
        for (size_t i = 0; i < pixel_count(image); i++) {
            if (!isfinite(image->plane[c][i])) {
                return pm_status_fail(PM_EINPUT, "%s: pixel %zu,%zu of channel %s is %g", name,
                                      i % width, i / width, image->name[c],
                                      (double)image->plane[c][i]);
            }
        }
    }
    return PM_OK;
}

static pm_status check_image(const pm_image *image, const char *name)
{
    for (int c = 0; c < 3; c++) {
        if (find_channel(image, "", c) == NULL) {
            return pm_status_fail(PM_EINPUT, "%s: has no channel %s", name, channel_names[c]);
        }
    }
    return check_finite(image, name);
}

static void leave_out_frame(int width, int height, uint8_t *counted)
{
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            bool inside = x >= PM_COMPARE_FRAME && y >= PM_COMPARE_FRAME &&
                          x < width - PM_COMPARE_FRAME && y < height - PM_COMPARE_FRAME;
            if (!inside) {
                counted[(size_t)y * (size_t)width + (size_t)x] = 0;
            }
        }
    }
}

static void leave_out_around(int width, int height, int x, int y, uint8_t *counted)
{
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < height; v++) {
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < width; u++) {
            counted[(size_t)v * (size_t)width + (size_t)u] = 0;
        }
    }
}

static void leave_out_emitters(const pm_image *image, uint8_t *counted)
{
    const float *mask = pm_image_plane(image, "mask.emitter");
    for (int y = 0; mask != NULL && y < image->height; y++) {
        for (int x = 0; x < image->width; x++) {
            if (mask[(size_t)y * (size_t)image->width + (size_t)x] != 0.0F) {
                leave_out_around(image->width, image->height, x, y, counted);
            }
        }
    }
}

static pm_status make_mask(const char *const names[2], bool masked, pm_compare_pair *pair)
{
    const pm_image *a = pair->image[0];
    size_t pixels = pixel_count(a);
    pair->counted = malloc(pixels);
    if (pair->counted == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for a mask of %zu pixels", pixels);
    }
    memset(pair->counted, 1, pixels);
    if (masked) {
        leave_out_frame(a->width, a->height, pair->counted);
        leave_out_emitters(a, pair->counted);
        leave_out_emitters(pair->image[1], pair->counted);
    }
    pair->count = 0;
    for (size_t i = 0; i < pixels; i++) {
        pair->count += pair->counted[i];
    }
    if (pair->count == 0) {
        return pm_status_fail(
            PM_EINPUT,
            "%s and %s: the mask (emitters and a frame of %d pixels) leaves no "
            "pixel; --no-mask compares all",
            names[0], names[1], PM_COMPARE_FRAME);
    }
    return PM_OK;
}

pm_status pm_compare_pair_make(const pm_image *a, const pm_image *b, const char *const names[2],
                               bool masked, pm_compare_pair *pair)
{
    if (a->width != b->width || a->height != b->height) {
        return pm_status_fail(PM_EINPUT, "%s is %dx%d, %s is %dx%d: sizes must be equal",
                              names[0], a->width, a->height, names[1], b->width, b->height);
    }
    PM_TRY(check_image(a, names[0]));
    PM_TRY(check_image(b, names[1]));
    pm_compare_pair made = {.image = {a, b}};
    pm_status status = make_mask(names, masked, &made);
    if (status != PM_OK) {
        pm_compare_pair_free(&made);
        return status;
    }
    *pair = made;
    return PM_OK;
}

void pm_compare_pair_free(pm_compare_pair *pair)
{
    free(pair->counted);
    *pair = (pm_compare_pair){0};
}

// Luminances while one layer is measured.
typedef struct {
    size_t pixels;
    double *a, *b;
    double *difference;
    double *half[2][2]; // [A or B][first or second], NULL without halves
    double *noise[2];
} planes;

static double *make_luminance(const pm_image *image, const char *layer)
{
    double *plane = malloc(pixel_count(image) * sizeof *plane);
    const float *c[3];
    for (int i = 0; i < 3; i++) {
        c[i] = find_channel(image, layer, i);
    }
    for (size_t i = 0; plane != NULL && i < pixel_count(image); i++) {
        plane[i] =
            pm_spectrum_luminance(pm_rgb((double)c[0][i], (double)c[1][i], (double)c[2][i]));
    }
    return plane;
}

static double *make_combination(const double *a, const double *b, double factor, size_t count)
{
    double *plane = a != NULL && b != NULL ? malloc(count * sizeof *plane) : NULL;
    for (size_t i = 0; plane != NULL && i < count; i++) {
        plane[i] = factor * (a[i] - b[i]);
    }
    return plane;
}

/// Halves of the picture or of one layer ("half1.caustic"), where the image has them.
static bool make_noise(const pm_image *image, const char *layer, double *half[2],
                       double **noise)
{
    char name[2][40];
    for (int h = 0; h < 2; h++) {
        snprintf(name[h], sizeof name[h], "half%d%s%s", h + 1, layer[0] != '\0' ? "." : "",
                 layer);
        if (!has_layer(image, name[h])) {
            return true;
        }
    }
    half[0] = make_luminance(image, name[0]);
    half[1] = make_luminance(image, name[1]);
    *noise = make_combination(half[0], half[1], 0.5, pixel_count(image));
    return *noise != NULL;
}

static pm_status make_planes(const pm_compare_pair *pair, const char *layer, planes *p)
{
    p->pixels = pixel_count(pair->image[0]);
    p->a = make_luminance(pair->image[0], layer);
    p->b = make_luminance(pair->image[1], layer);
    p->difference = make_combination(p->a, p->b, 1.0, p->pixels);
    bool made = p->difference != NULL;
    for (int i = 0; i < 2; i++) {
        made = make_noise(pair->image[i], layer, p->half[i], &p->noise[i]) && made;
    }
    return made ? PM_OK : PM_FAIL(PM_ENOMEM, "no memory to compare %zu pixels", p->pixels);
}

static void free_planes(planes *p)
{
    free(p->a);
    free(p->b);
    free(p->difference);
    for (int i = 0; i < 2; i++) {
        free(p->half[i][0]);
        free(p->half[i][1]);
        free(p->noise[i]);
    }
}

// a / b, where two zeros are the same and a lone one under the line is no number.
static double divide(double a, double b)
{
    if (b == 0.0) {
        return a == 0.0 ? 1.0 : (double)NAN;
    }
    return a / b;
}

static void measure_error(const pm_compare_pair *pair, const planes *p, pm_compare_part *part)
{
    double sum_b = 0.0;
    double squares = 0.0;
    double count = (double)pair->count;
    part->halves = p->noise[1] != NULL;
    for (size_t i = 0; i < p->pixels; i++) {
        if (!pair->counted[i]) {
            continue;
        }
        sum_b += p->b[i];
        squares += part->halves ? (p->a[i] - p->half[1][0][i]) * (p->a[i] - p->half[1][1][i])
                                : p->difference[i] * p->difference[i];
        if (fabs(p->difference[i]) > part->max) {
            part->max = fabs(p->difference[i]);
            part->max_x = (int)(i % (size_t)pair->image[0]->width);
            part->max_y = (int)(i / (size_t)pair->image[0]->width);
        }
    }
    part->mean_b = sum_b / count;
    part->rel_mse = squares == 0.0 ? 0.0 : divide(squares / count, part->mean_b * part->mean_b);
    part->rel_rmse = part->rel_mse < 0.0 ? 0.0 : sqrt(part->rel_mse);
}

static void measure_ratios(const pm_compare_pair *pair, const char *layer,
                           pm_compare_part *part)
{
    for (int c = 0; c < 3; c++) {
        const float *a = find_channel(pair->image[0], layer, c);
        const float *b = find_channel(pair->image[1], layer, c);
        double sum[2] = {0.0, 0.0};
        for (size_t i = 0; i < pixel_count(pair->image[0]); i++) {
            sum[0] += pair->counted[i] ? (double)a[i] : 0.0;
            sum[1] += pair->counted[i] ? (double)b[i] : 0.0;
        }
        part->mean_ratio[c] = divide(sum[0], sum[1]);
    }
}

pm_status pm_compare_measure(const pm_compare_pair *pair, const char *layer,
                             pm_compare_part *part)
{
    planes p = {0};
    pm_compare_part measured = {0};
    pm_status status = make_planes(pair, layer, &p);
    if (status == PM_OK) {
        pm_coherence_planes input = {.width = pair->image[0]->width,
                                     .height = pair->image[0]->height,
                                     .counted = pair->counted,
                                     .difference = p.difference,
                                     .noise = {p.noise[0], p.noise[1]}};
        snprintf(measured.name, sizeof measured.name, "%s", layer);
        measured.noise_known = p.noise[0] != NULL && p.noise[1] != NULL;
        measure_error(pair, &p, &measured);
        measure_ratios(pair, layer, &measured);
        status = pm_coherence_measure(&input, &measured.coherence);
    }
    free_planes(&p);
    if (status == PM_OK) {
        *part = measured;
    }
    return status;
}

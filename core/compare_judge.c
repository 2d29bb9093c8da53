// What the measures mean, in a sentence, and as a picture.
#include "compare.h"

#include "png.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// Of layers whose difference leans one way, the one that leans most; NULL when none does.
static const pm_compare_part *find_leaning(const pm_compare_part *layers, int count)
{
    const pm_compare_part *most = NULL;
    for (int i = 0; i < count; i++) {
        bool leans = layers[i].coherence.z > PM_COMPARE_SIGMA;
        if (leans &&
            (most == NULL || layers[i].coherence.coherent > most->coherence.coherent)) {
            most = &layers[i];
        }
    }
    return most;
}

static void say_fault(const pm_compare_part *whole, const pm_compare_part *layers, int count,
                      char *sentence, size_t room)
{
    const pm_compare_part *leaning = find_leaning(layers, count);
    char where[64] = "";
    if (leaning != NULL) {
        snprintf(where, sizeof where, ", most of it in the layer %s", leaning->name);
    }
    snprintf(sentence, room,
             "a fault or a bias, not noise: whole regions differ the same way (z = %.1f), by "
             "%.2g %% of the mean%s",
             whole->coherence.z, 100.0 * whole->coherence.coherent / fabs(whole->mean_b),
             where);
}

pm_compare_verdict pm_compare_judge(const pm_compare_part *whole, const pm_compare_part *layers,
                                    int count, char *sentence, size_t room)
{
    const pm_coherence *found = &whole->coherence;
    if (whole->max == 0.0) {
        snprintf(sentence, room, "the same: no pixel differs");
        return PM_COMPARE_EQUAL;
    }
    if (whole->mean_b == 0.0) {
        snprintf(sentence, room, "a fault: the right picture is black, the other is not");
        return PM_COMPARE_FAULT;
    }
    if (found->pairs < PM_COMPARE_PAIRS_MIN) {
        snprintf(sentence, room, "too few pixels to tell a fault from noise: render larger");
        return PM_COMPARE_UNCERTAIN;
    }
    if (found->z <= PM_COMPARE_SIGMA) {
        snprintf(sentence, room,
                 "noise: neighbouring regions differ by chance (z = %.1f, a fault is above "
                 "%.0f)",
                 found->z, PM_COMPARE_SIGMA);
        return PM_COMPARE_NOISE;
    }
    bool small = found->coherent < PM_COMPARE_SHARED * fabs(whole->mean_b);
    if (small && !whole->noise_known) {
        snprintf(
            sentence, room,
            "unclear: whole regions differ the same way (z = %.1f), but only by %.2g %% of "
            "the mean, as two photon maps of different seeds do; more photons or halves "
            "would tell",
            found->z, 100.0 * found->coherent / fabs(whole->mean_b));
        return PM_COMPARE_UNCERTAIN;
    }
    say_fault(whole, layers, count, sentence, room);
    return PM_COMPARE_FAULT;
}

static double luminance_at(const pm_image *image, size_t pixel)
{
    return pm_spectrum_luminance(pm_rgb((double)pm_image_plane(image, "R")[pixel],
                                        (double)pm_image_plane(image, "G")[pixel],
                                        (double)pm_image_plane(image, "B")[pixel]));
}

static int order_doubles(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

// The 99 % quantile of |difference| over the pixels that count.
static double find_full(const pm_compare_pair *pair, const double *difference, size_t pixels,
                        double *sorted)
{
    size_t count = 0;
    for (size_t i = 0; i < pixels; i++) {
        if (pair->counted[i]) {
            sorted[count++] = fabs(difference[i]);
        }
    }
    qsort(sorted, count, sizeof *sorted, order_doubles);
    double quantile = sorted[(count - 1) * 99 / 100];
    return quantile > 0.0 ? quantile : sorted[count - 1];
}

static void paint(const pm_compare_pair *pair, const double *difference, size_t pixels,
                  double full, uint8_t *rgb)
{
    for (size_t i = 0; i < pixels; i++) {
        double share = full > 0.0 ? fmin(fabs(difference[i]) / full, 1.0) : 0.0;
        uint8_t strong = (uint8_t)lround(255.0 * sqrt(share));
        uint8_t weak = (uint8_t)lround(255.0 * share * share);
        bool brighter = difference[i] > 0.0;
        rgb[3 * i] = pair->counted[i] ? (brighter ? strong : 0) : 96;
        rgb[3 * i + 1] = pair->counted[i] ? weak : 96;
        rgb[3 * i + 2] = pair->counted[i] ? (brighter ? 0 : strong) : 96;
    }
}

pm_status pm_compare_picture(const pm_compare_pair *pair, const char *path, double *full)
{
    const pm_image *a = pair->image[0];
    size_t pixels = (size_t)a->width * (size_t)a->height;
    double *difference = malloc(pixels * sizeof *difference);
    double *sorted = malloc(pixels * sizeof *sorted);
    uint8_t *rgb = malloc(pixels * 3);
    pm_status status = PM_OK;
    if (difference == NULL || sorted == NULL || rgb == NULL) {
        status = PM_FAIL(PM_ENOMEM, "no memory for a picture of %zu pixels", pixels);
    } else {
        for (size_t i = 0; i < pixels; i++) {
            difference[i] = luminance_at(a, i) - luminance_at(pair->image[1], i);
        }
        double quantile = find_full(pair, difference, pixels, sorted);
        paint(pair, difference, pixels, quantile, rgb);
        status = pm_png_write_bytes(path, rgb, a->width, a->height);
        *full = quantile;
    }
    free(difference);
    free(sorted);
    free(rgb);
    return status;
}

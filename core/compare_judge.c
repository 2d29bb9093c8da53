// What the measures mean, in a sentence, and as a picture.
#include "compare.h"

#include "png.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// The part whose difference leans most in absolute terms, of those that lean at all; NULL when
// none does. A layer can lean clearly while the noise of others hides it in the whole picture.
static const pm_compare_part *find_leaning(const pm_compare_part *whole,
                                           const pm_compare_part *layers, int count)
{
    const pm_compare_part *most = whole->coherence.z > PM_COMPARE_SIGMA ? whole : NULL;
    for (int i = 0; i < count; i++) {
        const pm_coherence *found = &layers[i].coherence;
        if (found->z > PM_COMPARE_SIGMA &&
            (most == NULL || found->coherent >= most->coherence.coherent)) {
            most = &layers[i];
        }
    }
    return most;
}

// A layer that is black in one picture only: switched off, not noisy.
static const pm_compare_part *find_missing(const pm_compare_part *layers, int count)
{
    for (int i = 0; i < count; i++) {
        const double *ratio = layers[i].mean_ratio;
        bool none_in_a = ratio[0] == 0.0 && ratio[1] == 0.0 && ratio[2] == 0.0;
        if (none_in_a || (layers[i].mean_b == 0.0 && layers[i].max > 0.0)) {
            return &layers[i];
        }
    }
    return NULL;
}

static pm_compare_verdict say_leaning(const pm_compare_part *whole,
                                      const pm_compare_part *leaning, char *sentence,
                                      size_t room)
{
    const pm_coherence *found = &leaning->coherence;
    double share = found->coherent / fabs(whole->mean_b);
    char where[64] = "";
    if (leaning->name[0] != '\0') {
        snprintf(where, sizeof where, " in the layer %s", leaning->name);
    }
    if (share < PM_COMPARE_SHARED && !whole->noise_known) {
        snprintf(
            sentence, room,
            "unclear: whole regions differ the same way%s (z = %.1f), but only by %.2g %% "
            "of the picture's mean, as photon maps of two seeds do; more photons or halves "
            "would tell",
            where, found->z, 100.0 * share);
        return PM_COMPARE_UNCERTAIN;
    }
    snprintf(sentence, room,
             "a fault or a bias, not noise: whole regions differ the same way%s (z = %.1f), by "
             "%.2g %% of the picture's mean",
             where, found->z, 100.0 * share);
    return PM_COMPARE_FAULT;
}

// What needs no statistics: true when it has decided.
static bool judge_plainly(const pm_compare_part *whole, const pm_compare_part *layers,
                          int count, pm_compare_verdict *verdict, char *sentence, size_t room)
{
    const pm_compare_part *missing = find_missing(layers, count);
    if (missing != NULL) {
        bool in_a = missing->mean_b == 0.0;
        snprintf(sentence, room, "a fault: the layer %s is black in %s only", missing->name,
                 in_a ? "B" : "A");
        *verdict = PM_COMPARE_FAULT;
        return true;
    }
    if (whole->max == 0.0) {
        snprintf(sentence, room, "the same: no pixel differs");
        *verdict = PM_COMPARE_EQUAL;
        return true;
    }
    if (whole->mean_b == 0.0) {
        snprintf(sentence, room, "a fault: the right picture is black, the other is not");
        *verdict = PM_COMPARE_FAULT;
        return true;
    }
    return false;
}

pm_compare_verdict pm_compare_judge(const pm_compare_part *whole, const pm_compare_part *layers,
                                    int count, char *sentence, size_t room)
{
    pm_compare_verdict verdict;
    if (judge_plainly(whole, layers, count, &verdict, sentence, room)) {
        return verdict;
    }
    if (whole->coherence.pairs < PM_COMPARE_PAIRS_MIN) {
        snprintf(sentence, room, "too few pixels to tell a fault from noise: render larger");
        return PM_COMPARE_UNCERTAIN;
    }
    const pm_compare_part *leaning = find_leaning(whole, layers, count);
    if (leaning != NULL) {
        return say_leaning(whole, leaning, sentence, room);
    }
    snprintf(
        sentence, room,
        "noise: regions differ by chance (z = %.1f, a fault is above %.0f); a fault within "
        "a few tiles would show only in --map",
        whole->coherence.z, PM_COMPARE_SIGMA);
    return PM_COMPARE_NOISE;
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

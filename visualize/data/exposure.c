// Lamps are far brighter than what they light: a few pixels may burn out.
#include "exposure.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

static const double shown_share = 0.95; // of the pixels that are not burnt out
static const double shown_at = 0.9;     // linear light that the brightest of them get at most

static int compare(const void *a, const void *b)
{
    float x = *(const float *)a;
    float y = *(const float *)b;
    return (x > y) - (x < y);
}

double pm_exposure_choose(float *values, size_t count)
{
    qsort(values, count, sizeof *values, compare);
    double bright = (double)values[(size_t)(shown_share * (double)(count - 1))];
    bright = bright > 0.0 ? bright : (double)values[count - 1];
    bool shows = bright > 0.0 && isfinite(bright);
    return shows ? 0.5 * floor(2.0 * log2(shown_at / bright)) : 0.0;
}

pm_status pm_exposure_of(const pm_image *image, double *stops)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    const float *r = pm_image_plane(image, "R");
    const float *g = pm_image_plane(image, "G");
    const float *b = pm_image_plane(image, "B");
    float *values = malloc(pixels * sizeof *values);
    if (values == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %zu pixels", pixels);
    }
    for (size_t i = 0; i < pixels; i++) {
        values[i] = fmaxf(r[i], fmaxf(g[i], b[i]));
    }
    *stops = pm_exposure_choose(values, pixels);
    free(values);
    return PM_OK;
}

// Three channels of linear sRGB, in double: power [W], radiance, irradiance or a plain ratio,
// as the name beside it says.
#ifndef PM_SPECTRUM_H
#define PM_SPECTRUM_H

#include <math.h>
#include <stdbool.h>

typedef struct {
    double c[3];
} pm_spectrum;

static inline pm_spectrum pm_rgb(double r, double g, double b)
{
    return (pm_spectrum){{r, g, b}};
}

static inline pm_spectrum pm_gray(double v)
{
    return (pm_spectrum){{v, v, v}};
}

static inline pm_spectrum pm_spectrum_add(pm_spectrum a, pm_spectrum b)
{
    return pm_rgb(a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2]);
}

static inline pm_spectrum pm_spectrum_sub(pm_spectrum a, pm_spectrum b)
{
    return pm_rgb(a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]);
}

static inline pm_spectrum pm_spectrum_mul(pm_spectrum a, pm_spectrum b)
{
    return pm_rgb(a.c[0] * b.c[0], a.c[1] * b.c[1], a.c[2] * b.c[2]);
}

static inline pm_spectrum pm_spectrum_scale(pm_spectrum a, double f)
{
    return pm_rgb(a.c[0] * f, a.c[1] * f, a.c[2] * f);
}

static inline double pm_spectrum_max(pm_spectrum a)
{
    double two = a.c[0] > a.c[1] ? a.c[0] : a.c[1];
    return two > a.c[2] ? two : a.c[2];
}

static inline double pm_spectrum_mean(pm_spectrum a)
{
    return (a.c[0] + a.c[1] + a.c[2]) / 3.0;
}

static inline bool pm_spectrum_is_black(pm_spectrum a)
{
    return a.c[0] == 0.0 && a.c[1] == 0.0 && a.c[2] == 0.0;
}

static inline bool pm_spectrum_is_finite(pm_spectrum a)
{
    return isfinite(a.c[0]) && isfinite(a.c[1]) && isfinite(a.c[2]);
}

/// Relative luminance Y by Rec. 709.
static inline double pm_spectrum_luminance(pm_spectrum a)
{
    return 0.2126 * a.c[0] + 0.7152 * a.c[1] + 0.0722 * a.c[2];
}

#endif

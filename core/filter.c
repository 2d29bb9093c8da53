// Kernels over the unit disc. A photon at u = d^2 / r^2 counts weight(u); photons spread evenly
// over the disc have u uniform in [0, 1], so the mean weight is the integral over u from 0
// to 1.
//
// Invariant: weight / normalisation has mean 1, except for the lecture's Gaussian, whose
// published factor leaves 0.531.
// @source Jensen 2001, ch. 7; the Gaussian's factor: Garcia et al., TVCG 2014
#include "filter.h"

#include <stdbool.h>

#define GAUSSIAN_BETA 1.953
#define GAUSSIAN_ALPHA_LECTURE 0.918

// Standard errors by which an estimate may drift by chance.
#define DRIFT 3.0

static pm_status check_kind(pm_filter_kind kind)
{
    if (kind < PM_FILTER_NONE || kind >= PM_FILTER_COUNT) {
        return PM_FAIL(PM_EINPUT, "no filter has the number %d", (int)kind);
    }
    return PM_OK;
}

/// Mean over the disc of 1 - (1 - exp(-beta u / 2)) / (1 - exp(-beta)).
static double gaussian_mean(void)
{
    double half = GAUSSIAN_BETA / 2.0;
    double mean_drop = 1.0 + expm1(-half) / half; // integral of 1 - exp(-half u)
    return 1.0 + mean_drop / expm1(-GAUSSIAN_BETA);
}

static double gaussian(pm_filter_constants constants, double u)
{
    double alpha =
        constants == PM_CONSTANTS_LECTURE ? GAUSSIAN_ALPHA_LECTURE : 1.0 / gaussian_mean();
    return alpha * (1.0 - expm1(-GAUSSIAN_BETA / 2.0 * u) / expm1(-GAUSSIAN_BETA));
}

static double weight_of(pm_filter_kind kind, pm_filter_constants constants, double u)
{
    switch (kind) {
    case PM_FILTER_CONE:
        return 1.0 - sqrt(u) / PM_CONE_C;
    case PM_FILTER_GAUSSIAN:
        return gaussian(constants, u);
    case PM_FILTER_EPANECHNIKOV:
        return 2.0 * (1.0 - u);
    default:
        return 1.0;
    }
}

pm_status pm_filter_weight(pm_filter_kind kind, pm_filter_constants constants, double u,
                           double *weight)
{
    PM_TRY(check_kind(kind));
    if (!(u >= 0.0)) {
        return PM_FAIL(PM_EINPUT, "a filter takes u = d^2 / r^2 >= 0, got %g", u);
    }
    *weight = u > 1.0 ? 0.0 : weight_of(kind, constants, u);
    return PM_OK;
}

pm_status pm_filter_normalisation(pm_filter_kind kind, pm_filter_constants constants,
                                  double *normalisation)
{
    PM_TRY(check_kind(kind));
    (void)constants; // both Gaussians claim mean 1; the others have no choice
    *normalisation = kind == PM_FILTER_CONE ? 1.0 - 2.0 / (3.0 * PM_CONE_C) : 1.0;
    return PM_OK;
}

static pm_status check_sorted(const double *distance2, const double *power, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        double before = i == 0 ? 0.0 : distance2[i - 1];
        if (!(distance2[i] >= before)) {
            return PM_FAIL(PM_EINPUT,
                           "distances must rise from 0 on; photon %u has %g after %g", i,
                           distance2[i], before);
        }
        if (!(power[i] >= 0.0)) {
            return PM_FAIL(PM_EINPUT, "a photon's power must be >= 0, photon %u has %g", i,
                           power[i]);
        }
    }
    return PM_OK;
}

/// A disc that grows: of `count` photons the last only sets its size, d^2.
typedef struct {
    uint32_t count;
    double power, power2; // sums over the others of power and of its square
    double distance2;
} disc;

static void grow(disc *d, const double *distance2, const double *power)
{
    double joins = d->count > 0 ? power[d->count - 1] : 0.0;
    d->power += joins;
    d->power2 += joins * joins;
    d->distance2 = distance2[d->count];
    d->count++;
}

/// Whether the density of `whole` differs from that of its inner half by more than chance: the
/// relative standard error of a sum of n powers is root(sum of squares) / sum.
static bool has_drifted(const disc *half, const disc *whole)
{
    double inner = half->power * whole->distance2; // densities, both times the two areas
    double outer = whole->power * half->distance2;
    return fabs(inner - outer) * whole->power > DRIFT * sqrt(whole->power2) * inner;
}

static uint32_t keep(const double *distance2, const double *power, uint32_t count,
                     uint32_t least)
{
    disc half = {0};
    disc whole = {0};
    while (whole.count < count) {
        grow(&whole, distance2, power);
        if (half.count < whole.count / 2) {
            grow(&half, distance2, power);
        }
        bool comparable = half.count >= least && half.count > 1 && half.distance2 > 0.0;
        if (comparable && has_drifted(&half, &whole)) {
            return half.count;
        }
    }
    return count;
}

pm_status pm_filter_differential(const double *distance2, const double *power, uint32_t count,
                                 uint32_t least, uint32_t *kept)
{
    PM_TRY(check_sorted(distance2, power, count));
    *kept = count <= least ? count : keep(distance2, power, count, least);
    return PM_OK;
}

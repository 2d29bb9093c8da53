// Lab 6. Kernels: how much a photon counts by its distance, and what the weights must be
// divided by. u = d^2 / r^2 in [0, 1] throughout, r the radius of the estimate.
#ifndef PM_FILTER_H
#define PM_FILTER_H

#include "photon.h"
#include "status.h"

typedef enum {
    PM_FILTER_NONE, // constant
    PM_FILTER_CONE, // 1 - sqrt(u) / c, c = PM_CONE_C
    PM_FILTER_GAUSSIAN,
    PM_FILTER_EPANECHNIKOV,
    PM_FILTER_COUNT,
} pm_filter_kind;

#define PM_CONE_C 1.1

/// Which constants the Gaussian takes: ones with mean weight 1, or the lecture's 0.918.
typedef enum {
    PM_CONSTANTS_UNBIASED,
    PM_CONSTANTS_LECTURE,
} pm_filter_constants;

/// Weight of a photon at `u`; never negative. 0 for u > 1.
/// @param weight  [out]
pm_status pm_filter_weight(pm_filter_kind kind, pm_filter_constants constants, double u,
                           double *weight);

/// What a sum of weighted powers is divided by, besides the area: the mean weight over the disc
/// that the constants claim (so the lecture's Gaussian claims 1 and is wrong).
/// @param normalisation  [out]
pm_status pm_filter_normalisation(pm_filter_kind kind, pm_filter_constants constants,
                                  double *normalisation);

/// Differential checking: how many of `count` photons to keep, sorted by distance, so that the
/// estimate stays on one side of an edge. Grows the disc photon by photon; when its estimate
/// has drifted from that of its inner half by three standard errors, the inner half is kept.
///
/// On a flat field it keeps 95 of 100 photons and doubles the noise: an edge is seen only as
/// clearly as k photons can show it, so it pays for k of some hundreds.
///
/// @param kept  [out] between min(least, count) and count
/// @source Jensen 2001, ch. 7, for the idea
pm_status pm_filter_differential(const double *distance2, const double *power, uint32_t count,
                                 uint32_t least, uint32_t *kept);

#endif

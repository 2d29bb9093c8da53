// Whether photons fill their disc evenly. Where a disc hangs over an edge, or lies in a groove
// or on a pipe narrower than itself, part of it holds no surface, and what its photons say is
// too little.
//
// The five lowest moments of their positions tell: the mean, the mean square and the two ways
// to be oblong. Each is 0 on average for an even spread, with a known variance, and none goes
// with another, so that the sum of their squares over these variances is chi-square with five
// degrees of freedom; unevenness is that sum over k.
#ifndef PM_FILL_H
#define PM_FILL_H

#include "estimate.h"

/// The unevenness of the photons that an estimate found, in the plane of the point; 0 for none.
///
/// A straight edge through the point gives 0.72, one at 0.55 of the radius 0.15, a strip as
/// wide as the radius 0.46.
/// @param nearest  the `found->found` entries that the estimate left in its scratch
double pm_fill_unevenness(const pm_photon_map *map, const pm_neighbour *nearest,
                          const pm_estimate *found, const pm_estimate_point *point);

/// Whether that is a fault: above 0.09, and above what chance does to so few photons (one even
/// disc in twenty is taken for uneven).
bool pm_fill_is_uneven(double unevenness, uint32_t found);

#endif

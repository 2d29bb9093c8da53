// Whether a disc hangs over an edge: then the photons found in it lie to one side, and what
// they say is too little.
//
// Lean is the distance from the point to the mean of their positions, over the radius. k
// photons spread evenly about the point have a lean of about 1 / sqrt(k); where a straight edge
// cuts the disc at a times its radius, the lean is
// (2/3) (1 - a^2)^(3/2) / (pi - acos a + a sqrt(1 - a^2)): 0.42 at the edge, 0.15 at a = 0.55.
#ifndef PM_LEAN_H
#define PM_LEAN_H

#include "estimate.h"

/// The lean of the photons that an estimate found, in the plane of the point; 0 for none.
/// @param nearest  the `found->found` entries that the estimate left in its scratch
double pm_lean_of(const pm_photon_map *map, const pm_neighbour *nearest,
                  const pm_estimate *found, const pm_estimate_point *point);

/// Whether that is an edge: above 0.15, and above what chance does to so few photons.
bool pm_lean_is_edge(double lean, uint32_t found);

#endif

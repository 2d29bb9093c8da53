// How far the first pass of a progressive picture looks for photons, taken from the photons
// that it has.
#ifndef PM_FIRST_RADIUS_H
#define PM_FIRST_RADIUS_H

#include "photon.h"
#include "status.h"

/// The mean distance [m] of the k-th nearest photon, over a fixed sample of the photons of
/// `map` and the side of the surface that each came to. Where there are fewer than k, the last
/// one stands for it.
///
/// @param map     balanced
/// @param k       >= 1; the photon that is asked at is none of them
/// @param skip    photons with one of these flag bits are neither asked at nor counted
/// @param radius  [out] 0 where no two photons lie apart
/// @return PM_EINPUT when the map is not balanced or k is not in range; PM_ENOMEM
pm_status pm_first_radius(const pm_photon_map *map, uint32_t k, uint16_t skip, double *radius);

#endif

// The photons of one estimate, nearest first, with what each of them counts under every kernel.
#ifndef PM_WEIGHED_H
#define PM_WEIGHED_H

#include "estimate.h"

#define PM_WEIGHED_HEADER "x,y,z,r,g,b,distance,none,cone,gaussian,epanechnikov"

typedef struct {
    uint32_t photons; // in the file
    double radius;    // [m] of the disc in its plane; 0 without photons
} pm_weighed;

/// Photons in reach of a point, sorted by distance: a stage's own search.
/// @param nearest  [out] room for settings->k
pm_status pm_weighed_search(const pm_photon_map *map, const pm_estimate_settings *settings,
                            const pm_estimate_point *point, pm_neighbour *nearest,
                            uint32_t *found);

/// Writes PM_WEIGHED_HEADER and a row a photon: place [m] in the scene file's coordinates,
/// power [W], distance [m] as the search measures it, and under each kernel with its right
/// constants how much it counts against the plain average. That is 0 for a photon that only
/// sets the radius. Power times weight, summed, over pi radius^2 is the irradiance.
/// @param center   that scene coordinates are counted from
/// @param scratch  room for settings->k
/// @param out      [out]
pm_status pm_weighed_write(const char *path, const pm_photon_map *map,
                           const pm_estimate_settings *settings, const pm_estimate_point *point,
                           pm_vec3 center, pm_neighbour *scratch, pm_weighed *out);

#endif

// Sums over the photons of a map.
#ifndef PM_MAP_POWER_H
#define PM_MAP_POWER_H

#include "photon.h"

/// What there is to tell of a map, or of many together.
typedef struct {
    uint64_t emitted, stored;
    uint64_t refused, clamped, vanished; // as in pm_photon_map
    uint64_t bytes;                      // held for photons; of many maps: the most
    pm_spectrum power;                   // [W]
} pm_map_sum;

/// Total power of the map [W], summed in index order in double.
pm_spectrum pm_map_power(const pm_photon_map *map);

pm_map_sum pm_map_sum_of(const pm_photon_map *map);

/// Adds `part` to `sum`.
void pm_map_sum_add(pm_map_sum *sum, const pm_map_sum *part);

#endif

// Sums over the photons of a map.
#ifndef PM_MAP_POWER_H
#define PM_MAP_POWER_H

#include "photon.h"

/// Total power of the map [W], summed in index order in double.
pm_spectrum pm_map_power(const pm_photon_map *map);

#endif

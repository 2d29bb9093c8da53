// Double, because floats stop adding up at some 1e7 photons.
#include "map_power.h"

#include "store.h"

pm_spectrum pm_map_power(const pm_photon_map *map)
{
    pm_spectrum sum = pm_gray(0.0);
    for (uint32_t i = 0; i < map->count; i++) {
        sum = pm_spectrum_add(sum, pm_store_power(map, i));
    }
    return sum;
}

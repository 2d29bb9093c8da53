// Double, because floats stop adding up at some 1e7 photons.
#include "map_power.h"

#include "photon_map.h"
#include "store.h"

pm_spectrum pm_map_power(const pm_photon_map *map)
{
    pm_spectrum sum = pm_gray(0.0);
    for (uint32_t i = 0; i < map->count; i++) {
        sum = pm_spectrum_add(sum, pm_store_power(map, i));
    }
    return sum;
}

pm_map_sum pm_map_sum_of(const pm_photon_map *map)
{
    return (pm_map_sum){
        .emitted = map->emitted,
        .stored = map->count,
        .refused = map->refused,
        .clamped = map->clamped,
        .vanished = map->vanished,
        .bytes = pm_photon_map_bytes(map),
        .power = pm_map_power(map),
    };
}

void pm_map_sum_add(pm_map_sum *sum, const pm_map_sum *part)
{
    sum->emitted += part->emitted;
    sum->stored += part->stored;
    sum->refused += part->refused;
    sum->clamped += part->clamped;
    sum->vanished += part->vanished;
    sum->bytes = part->bytes > sum->bytes ? part->bytes : sum->bytes;
    sum->power = pm_spectrum_add(sum->power, part->power);
}

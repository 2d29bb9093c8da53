// Handling whole maps, around the stage that fills them.
#ifndef PM_PHOTON_MAP_H
#define PM_PHOTON_MAP_H

#include "photon.h"
#include "status.h"

/// Room for at least `capacity` photons, keeping those there are. PM_ELIMIT above PM_MAP_MAX.
pm_status pm_photon_map_reserve(pm_photon_map *map, uint64_t capacity);

/// The capacity to reserve for `needed` photons: a quarter more than now at least, so that a
/// map that grows photon by photon is copied a bounded number of times and is never more than a
/// quarter empty. Above PM_MAP_MAX only when `needed` is.
uint64_t pm_photon_map_growth(const pm_photon_map *map, uint64_t needed);

/// Appends all photons and counters of `part` to `map`.
/// @return PM_EINPUT when the maps differ in kind or packing, or one of them is scaled;
///         PM_ELIMIT, PM_ENOMEM; `map` is unchanged then
pm_status pm_photon_map_append(pm_photon_map *map, const pm_photon_map *part);

/// Gives back the room beyond `count`.
void pm_photon_map_trim(pm_photon_map *map);

/// The tight box around the photons; a map without photons has the origin.
/// @param low, high  [out]
void pm_photon_map_box(const pm_photon_map *map, pm_vec3 *low, pm_vec3 *high);

/// Bytes held for photons.
uint64_t pm_photon_map_bytes(const pm_photon_map *map);

/// Frees the photons; the map is empty and may be used again.
void pm_photon_map_free(pm_photon_map *map);

#endif

// Maps as containers. Invariant: photons[] has room for `capacity`, exact[] too when the map is
// unpacked, and both hold `count` entries in the same order.
#include "photon_map.h"

#include <stdlib.h>
#include <string.h>

static pm_status resize(void **array, uint64_t entries, size_t size)
{
    if (entries > SIZE_MAX / size) {
        return PM_FAIL(PM_ENOMEM, "no room for %llu photons", (unsigned long long)entries);
    }
    void *moved = realloc(*array, (size_t)entries * size);
    if (moved == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %llu photons", (unsigned long long)entries);
    }
    *array = moved;
    return PM_OK;
}

pm_status pm_photon_map_reserve(pm_photon_map *map, uint64_t capacity)
{
    if (capacity > PM_MAP_MAX) {
        return PM_FAIL(PM_ELIMIT, "a map holds at most %u photons, asked for %llu", PM_MAP_MAX,
                       (unsigned long long)capacity);
    }
    if (capacity <= map->capacity) {
        return PM_OK;
    }
    void *photons = map->photons;
    PM_TRY(resize(&photons, capacity, sizeof *map->photons));
    map->photons = photons;
    if (map->unpacked) {
        void *exact = map->exact;
        PM_TRY(resize(&exact, capacity, sizeof *map->exact));
        map->exact = exact;
    }
    map->capacity = (uint32_t)capacity;
    return PM_OK;
}

uint64_t pm_photon_map_growth(const pm_photon_map *map, uint64_t needed)
{
    uint64_t quarter = (uint64_t)map->capacity + map->capacity / 4;
    uint64_t wanted = quarter > needed ? quarter : needed;
    return wanted > PM_MAP_MAX && needed <= PM_MAP_MAX ? PM_MAP_MAX : wanted;
}

static pm_status check_append(const pm_photon_map *map, const pm_photon_map *part)
{
    if (map->unpacked != part->unpacked || map->kind != part->kind) {
        return PM_FAIL(PM_EINPUT, "%s", "appended maps must be of one kind and one packing");
    }
    if (map->scaled || part->scaled) {
        return PM_FAIL(PM_EINPUT, "%s", "append before scaling: one division is for all");
    }
    return PM_OK;
}

pm_status pm_photon_map_append(pm_photon_map *map, const pm_photon_map *part)
{
    PM_TRY(check_append(map, part));
    uint64_t needed = (uint64_t)map->count + part->count;
    if (needed > map->capacity) {
        PM_TRY(pm_photon_map_reserve(map, pm_photon_map_growth(map, needed)));
    }
    if (part->count > 0) {
        memcpy(map->photons + map->count, part->photons, part->count * sizeof *map->photons);
        map->balanced = false;
    }
    if (part->count > 0 && map->unpacked) {
        memcpy(map->exact + map->count, part->exact, part->count * sizeof *map->exact);
    }
    map->count = (uint32_t)needed;
    map->emitted += part->emitted;
    map->refused += part->refused;
    map->clamped += part->clamped;
    map->vanished += part->vanished;
    return PM_OK;
}

/// Shrinks an array; where the allocator cannot, the old one stays as it is.
static void *shrink(void *array, size_t bytes)
{
    void *moved = realloc(array, bytes);
    return moved != NULL ? moved : array;
}

void pm_photon_map_trim(pm_photon_map *map)
{
    if (map->count == map->capacity) {
        return;
    }
    if (map->count == 0) {
        free(map->photons);
        free(map->exact);
        map->photons = NULL;
        map->exact = NULL;
    } else {
        map->photons = shrink(map->photons, map->count * sizeof *map->photons);
    }
    if (map->exact != NULL) {
        map->exact = shrink(map->exact, map->count * sizeof *map->exact);
    }
    map->capacity = map->count;
}

void pm_photon_map_box(const pm_photon_map *map, pm_vec3 *low, pm_vec3 *high)
{
    *low = *high = pm_vec(0.0, 0.0, 0.0);
    for (uint32_t i = 0; i < map->count; i++) {
        const float *at = map->photons[i].position;
        pm_vec3 point = pm_vec((double)at[0], (double)at[1], (double)at[2]);
        *low = i == 0 ? point : pm_vec_min(*low, point);
        *high = i == 0 ? point : pm_vec_max(*high, point);
    }
}

uint64_t pm_photon_map_bytes(const pm_photon_map *map)
{
    size_t each = sizeof *map->photons + (map->unpacked ? sizeof *map->exact : 0);
    return (uint64_t)map->capacity * each;
}

void pm_photon_map_free(pm_photon_map *map)
{
    free(map->photons);
    free(map->exact);
    *map = (pm_photon_map){.kind = map->kind, .unpacked = map->unpacked};
}

// Maps as containers. Invariant: photons[] has room for `capacity`, exact[] too when the map is
// unpacked, and both hold `count` entries in the same order.
//
// The coarse normal is octahedral: the sphere is folded onto the square |x|, |y| <= 1 and that
// onto a 63 x 63 lattice, whose middle and rims are lattice lines, so that the axes are exact.
// @source Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//         JCGT 3(2), 2014
#include "photon_map.h"

#include "store.h"

#include <stdlib.h>
#include <string.h>

#define LATTICE 31      // lattice coordinates run from -31 to 31
#define NO_NORMAL 4095u // the lattice ends at 62 * 64 + 62

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

pm_spectrum pm_photon_map_power(const pm_photon_map *map)
{
    pm_spectrum sum = pm_gray(0.0);
    for (uint32_t i = 0; i < map->count; i++) {
        sum = pm_spectrum_add(sum, pm_store_power(map, i));
    }
    return sum;
}

/// The direction, not of unit length, of a lattice point; the lower half of the sphere lies in
/// the square's corners, outside |x| + |y| = 31.
static pm_vec3 unfold(int x, int y)
{
    int z = LATTICE - abs(x) - abs(y);
    if (z >= 0) {
        return pm_vec(x, y, z);
    }
    int folded_x = (LATTICE - abs(y)) * (x < 0 ? -1 : 1);
    int folded_y = (LATTICE - abs(x)) * (y < 0 ? -1 : 1);
    return pm_vec(folded_x, folded_y, z);
}

/// Where `normal` lies in the square, in lattice steps.
static void fold(pm_vec3 normal, double *x, double *y)
{
    double sum = fabs(normal.x) + fabs(normal.y) + fabs(normal.z);
    double upper_x = normal.x / sum;
    double upper_y = normal.y / sum;
    bool lower = normal.z < 0.0;
    *x = LATTICE * (lower ? copysign(1.0 - fabs(upper_y), upper_x) : upper_x);
    *y = LATTICE * (lower ? copysign(1.0 - fabs(upper_x), upper_y) : upper_y);
}

uint16_t pm_normal_encode(pm_vec3 normal)
{
    if (normal.x == 0.0 && normal.y == 0.0 && normal.z == 0.0) {
        return NO_NORMAL;
    }
    double x;
    double y;
    fold(normal, &x, &y);

    // Rounding each coordinate is not nearest on the sphere: try the cell's four corners.
    int best_x = 0;
    int best_y = 0;
    double best = -2.0;
    for (int corner = 0; corner < 4; corner++) {
        int corner_x = (int)fmin(floor(x) + (corner & 1), LATTICE);
        int corner_y = (int)fmin(floor(y) + (corner >> 1), LATTICE);
        double cosine = pm_vec_dot(pm_vec_normalize(unfold(corner_x, corner_y)), normal);
        if (cosine > best) {
            best = cosine;
            best_x = corner_x;
            best_y = corner_y;
        }
    }
    return (uint16_t)((best_x + LATTICE) * 64 + best_y + LATTICE);
}

pm_vec3 pm_normal_decode(uint16_t code)
{
    if (code == NO_NORMAL) {
        return pm_vec(0.0, 0.0, 0.0);
    }
    return pm_vec_normalize(unfold(code / 64 - LATTICE, code % 64 - LATTICE));
}

bool pm_normal_within(uint16_t code, pm_vec3 direction, double least)
{
    if (code == NO_NORMAL) {
        return true;
    }
    pm_vec3 unscaled = unfold(code / 64 - LATTICE, code % 64 - LATTICE);
    double along = pm_vec_dot(unscaled, direction);
    // Most are clear without the root: lattice points are 31 / sqrt(3) to 31 long.
    bool clear = along >= 0.0 && least <= 0.0;
    return clear || along >= least * pm_vec_length(unscaled);
}

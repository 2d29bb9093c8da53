// The exact values come from the file; the packed ones from its bytes, as every map is read.
#include "packing.h"

#include "photon_file.h"
#include "photon_map.h"
#include "store.h"

#include <math.h>
#include <stdlib.h>

// A cell of directions is 180/256 by 360/256 degrees at the equator: its corners are 0.786 from
// its middle. A power byte is off by half of one at most, and the strongest channel is 128 or
// more.
#define ANGLE_MOST 0.8
#define POWER_MOST 0.004
#define POWER_STEP 0.001 // that the ends of its axis are whole numbers of

static bool grow(void **array, uint64_t count, size_t size)
{
    void *moved = realloc(*array, count * size);
    if (moved != NULL) {
        *array = moved;
    }
    return moved != NULL;
}

static pm_status make_room(pm_packing *packing, uint64_t count)
{
    void *array[] = {packing->exact, packing->packed, packing->angle, packing->power};
    bool grown = count <= PM_MAP_MAX && grow(&array[0], count, sizeof *packing->exact) &&
                 grow(&array[1], count, sizeof *packing->packed) &&
                 grow(&array[2], count, sizeof *packing->angle) &&
                 grow(&array[3], count, 3 * sizeof *packing->power);
    packing->exact = array[0];
    packing->packed = array[1];
    packing->angle = array[2];
    packing->power = array[3];
    return grown ? PM_OK
                 : PM_FAIL(PM_ENOMEM, "no memory to compare %llu photons",
                           (unsigned long long)count);
}

static void store(float to[3], pm_vec3 v)
{
    to[0] = (float)v.x;
    to[1] = (float)v.y;
    to[2] = (float)v.z;
}

static void compare(pm_packing *packing, const pm_photon_view *exact,
                    const pm_photon_view *packed)
{
    uint32_t i = packing->count++;
    store(packing->exact[i], exact->direction);
    store(packing->packed[i], packed->direction);
    double angle = pm_packing_loss_angle(exact->direction, packed->direction);
    packing->angle[i] = (float)(angle * (180.0 / PM_PI));
    double strongest = fmax(pm_spectrum_max(exact->power), pm_spectrum_max(packed->power));
    for (int c = 0; c < 3; c++) {
        double error = packed->power.c[c] - exact->power.c[c];
        packing->power[3 * (size_t)i + (size_t)c] =
            strongest > 0.0 ? (float)(error / strongest) : 0.0F;
    }
}

static bool is_finite(const pm_photon_view *photon)
{
    return isfinite(pm_vec_reach(photon->direction)) && pm_spectrum_is_finite(photon->power);
}

static pm_status add_map(pm_packing *packing, const char *path, const pm_photon_map *map)
{
    if (!map->unpacked || map->count == 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s: %s; write it with `storage --packing off -o FILE.ply`", path,
                              map->count == 0 ? "has no photons to compare"
                                              : "holds packed photons without the exact ones");
    }
    PM_TRY(make_room(packing, (uint64_t)packing->count + map->count));
    pm_photon_map bytes = pm_packing_loss_bytes(map);
    for (uint32_t i = 0; i < map->count; i++) {
        pm_photon_view exact = pm_store_unpack(map, i);
        pm_photon_view packed = pm_store_unpack(&bytes, i);
        if (!is_finite(&exact)) {
            return pm_status_fail(
                PM_EINPUT, "%s: photon %u has an exact value that is not finite", path, i);
        }
        compare(packing, &exact, &packed);
    }
    pm_packing_loss_add(&packing->loss, map);
    return PM_OK;
}

pm_status pm_packing_read(pm_packing *packing, const char *path)
{
    pm_photon_map map = {0};
    pm_photon_file_info info = {0};
    PM_TRY(pm_photon_file_read(path, &map, &info, NULL));
    pm_status status = add_map(packing, path, &map);
    pm_photon_map_free(&map);
    return status;
}

static pm_packing_histogram count(const float *values, size_t total, double low, double high)
{
    pm_packing_histogram h = {.low = low, .high = high};
    for (size_t i = 0; i < total; i++) {
        double at = ((double)values[i] - low) / (high - low) * PM_PACKING_BINS;
        h.share[(int)fmin(at, PM_PACKING_BINS - 1)] += 1.0 / (double)total;
    }
    return h;
}

static double largest(const float *values, size_t total, double at_least)
{
    double most = at_least;
    for (size_t i = 0; i < total; i++) {
        most = fmax(most, fabs((double)values[i]));
    }
    return most;
}

pm_packing_histogram pm_packing_angles(const pm_packing *packing)
{
    double most = largest(packing->angle, packing->count, ANGLE_MOST);
    return count(packing->angle, packing->count, 0.0, most);
}

pm_packing_histogram pm_packing_powers(const pm_packing *packing)
{
    size_t total = 3 * (size_t)packing->count;
    double most = ceil(largest(packing->power, total, POWER_MOST) / POWER_STEP) * POWER_STEP;
    return count(packing->power, total, -most, most);
}

void pm_packing_free(pm_packing *packing)
{
    free(packing->exact);
    free(packing->packed);
    free(packing->angle);
    free(packing->power);
    *packing = (pm_packing){0};
}

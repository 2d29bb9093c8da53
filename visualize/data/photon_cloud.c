// Powers of photons differ by orders of magnitude, and a few odd ones would leave all others
// dark: so the brightness of a picture is set by the 99th percentile, not by the maximum.
#include "photon_cloud.h"

#include "store.h"

#include <stdlib.h>

#define FULL_SHARE 0.99

// A percentile of so many photons, taken at even steps, is good enough for a brightness.
#define SAMPLES 4096

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

static double find_full_power(const pm_photon_cloud *cloud)
{
    double sample[SAMPLES] = {0};
    uint32_t count = SAMPLES;
    if (cloud->count < count) {
        count = cloud->count;
    }
    for (uint32_t i = 0; i < count; i++) {
        const float *power = cloud->power[(uint64_t)i * cloud->count / count];
        sample[i] =
            pm_spectrum_max(pm_rgb((double)power[0], (double)power[1], (double)power[2]));
    }
    qsort(sample, count, sizeof sample[0], compare);
    return count > 0 ? sample[(uint32_t)(FULL_SHARE * (count - 1))] : 0.0;
}

static void fill(const pm_photon_map *map, pm_photon_cloud *cloud)
{
    for (uint32_t i = 0; i < cloud->count; i++) {
        uint32_t from = (uint32_t)((uint64_t)i * map->count / cloud->count);
        pm_photon_view photon = pm_store_unpack(map, from);
        for (int axis = 0; axis < 3; axis++) {
            cloud->position[i][axis] = map->photons[from].position[axis];
            cloud->power[i][axis] = (float)photon.power.c[axis];
        }
    }
}

pm_status pm_photon_cloud_make(const pm_photon_map *map, uint32_t most, pm_photon_cloud *cloud)
{
    static const char *const names[] = {"global", "caustic", "volume"};
    pm_photon_cloud made = {.count = map->count < most ? map->count : most,
                            .stored = map->count,
                            .emitted = map->emitted,
                            .name = names[map->kind]};
    size_t room = made.count > 0 ? made.count : 1;
    made.position = malloc(room * sizeof *made.position);
    made.power = malloc(room * sizeof *made.power);
    if (made.position == NULL || made.power == NULL) {
        pm_photon_cloud_free(&made);
        return PM_FAIL(PM_ENOMEM, "no memory to draw %u photons", made.count);
    }
    fill(map, &made);
    made.full_power = find_full_power(&made);
    *cloud = made;
    return PM_OK;
}

void pm_photon_cloud_free(pm_photon_cloud *cloud)
{
    free(cloud->position);
    free(cloud->power);
    *cloud = (pm_photon_cloud){0};
}

// Powers of photons differ by orders of magnitude, and a few odd ones would leave all others
// dark: so the brightness of a picture is set by the 99th percentile, not by the maximum.
#include "photon_cloud.h"

#include "map_make.h"
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

void pm_photon_cloud_measure(pm_photon_cloud *cloud)
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
    cloud->full_power = count > 0 ? sample[(uint32_t)(FULL_SHARE * (count - 1))] : 0.0;
}

pm_photon_cloud pm_photon_cloud_of(pm_map_kind map)
{
    return (pm_photon_cloud){.map = (int)map, .name = pm_map_name(map)};
}

static bool grow(void **array, uint32_t room, size_t size)
{
    void *moved = realloc(*array, (room > 0 ? room : 1) * size);
    if (moved != NULL) {
        *array = moved;
    }
    return moved != NULL;
}

pm_status pm_photon_cloud_reserve(pm_photon_cloud *cloud, uint32_t room, bool marked)
{
    void *array[] = {cloud->position, cloud->power, cloud->direction, cloud->bounce,
                     cloud->light};
    const size_t size[] = {sizeof *cloud->position, sizeof *cloud->power,
                           sizeof *cloud->direction, sizeof *cloud->bounce,
                           sizeof *cloud->light};
    bool grown = true;
    for (int i = 0; i < (marked ? 5 : 3); i++) {
        grown = grown && grow(&array[i], room, size[i]);
    }
    cloud->position = array[0];
    cloud->power = array[1];
    cloud->direction = array[2];
    cloud->bounce = array[3];
    cloud->light = array[4];
    return grown ? PM_OK : PM_FAIL(PM_ENOMEM, "no memory to draw %u photons", room);
}

/// Which of `stored` photons the cloud's i-th is.
static uint32_t source_of(const pm_photon_cloud *cloud, uint32_t i)
{
    return (uint32_t)((uint64_t)i * cloud->stored / cloud->count);
}

static void fill(const pm_photon_map *map, pm_photon_cloud *cloud)
{
    for (uint32_t i = 0; i < cloud->count; i++) {
        uint32_t from = source_of(cloud, i);
        pm_photon_view photon = pm_store_unpack(map, from);
        const double way[3] = {photon.direction.x, photon.direction.y, photon.direction.z};
        for (int axis = 0; axis < 3; axis++) {
            cloud->position[i][axis] = map->photons[from].position[axis];
            cloud->power[i][axis] = (float)photon.power.c[axis];
            cloud->direction[i][axis] = (float)way[axis];
        }
    }
}

pm_status pm_photon_cloud_make(const pm_photon_map *map, uint32_t most, pm_photon_cloud *cloud)
{
    pm_photon_cloud made = pm_photon_cloud_of(map->kind);
    made.count = map->count < most ? map->count : most;
    made.stored = map->count;
    made.emitted = map->emitted;
    pm_status status = pm_photon_cloud_reserve(&made, made.count, false);
    if (status != PM_OK) {
        pm_photon_cloud_free(&made);
        return status;
    }
    fill(map, &made);
    pm_photon_cloud_measure(&made);
    *cloud = made;
    return PM_OK;
}

/// The cloud's photons out of a column of all; NULL without a column.
static pm_status pick(const pm_photon_cloud *cloud, const uint32_t *column, uint32_t **picked)
{
    if (column == NULL) {
        return PM_OK;
    }
    uint32_t *made = malloc((cloud->count > 0 ? cloud->count : 1) * sizeof *made);
    if (made == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory to draw %u photons", cloud->count);
    }
    for (uint32_t i = 0; i < cloud->count; i++) {
        made[i] = column[source_of(cloud, i)];
    }
    *picked = made;
    return PM_OK;
}

pm_status pm_photon_cloud_mark(pm_photon_cloud *cloud, const pm_photon_columns *columns)
{
    PM_TRY(pick(cloud, columns->bounce, &cloud->bounce));
    return pick(cloud, columns->light, &cloud->light);
}

void pm_photon_cloud_free(pm_photon_cloud *cloud)
{
    free(cloud->position);
    free(cloud->power);
    free(cloud->direction);
    free(cloud->bounce);
    free(cloud->light);
    *cloud = (pm_photon_cloud){0};
}

// The rule which photon sets the radius is the estimate's (estimate.h): with k found, or
// without a reach, the farthest does, and counts for nothing.
#include "weighed.h"

#include "file.h"
#include "kernels.h"
#include "photon_map.h"
#include "store.h"

#include <math.h>
#include <stdlib.h>

static int by_distance(const void *a, const void *b)
{
    const pm_neighbour *first = a;
    const pm_neighbour *second = b;
    if (first->distance2 != second->distance2) {
        return first->distance2 < second->distance2 ? -1 : 1;
    }
    return (first->index > second->index) - (first->index < second->index);
}

pm_status pm_weighed_search(const pm_photon_map *map, const pm_estimate_settings *settings,
                            const pm_estimate_point *point, pm_neighbour *nearest,
                            uint32_t *found)
{
    pm_estimate_query query = {*point, settings->shape, settings->flatness, settings->skip,
                               settings->only};
    pm_search search = {.at = point->at,
                        .k = settings->k,
                        .radius2 = settings->radius * settings->radius,
                        .accept = pm_estimate_accept,
                        .context = &query};
    PM_TRY(pm_balance_nearest(map, &search, nearest, found, NULL));
    qsort(nearest, *found, sizeof *nearest, by_distance);
    return PM_OK;
}

/// The photons that count, and the squared distance that the kernels end at.
static uint32_t counted(const pm_estimate_settings *settings, const pm_neighbour *nearest,
                        uint32_t found, double *radius2)
{
    bool by_reach = found < settings->k && isfinite(settings->radius);
    *radius2 = by_reach || found == 0 ? settings->radius * settings->radius
                                      : nearest[found - 1].distance2;
    return by_reach || found == 0 ? found : found - 1;
}

static pm_status write_weights(FILE *out, double distance, bool counts)
{
    for (int row = 0; row < PM_FILTER_COUNT; row++) {
        double weight = 0.0;
        if (counts) {
            PM_TRY(pm_kernels_weight(row, distance, &weight));
        }
        fprintf(out, ",%.9g", weight);
    }
    fputc('\n', out);
    return PM_OK;
}

static pm_status write_photons(FILE *out, const pm_photon_map *map,
                               const pm_estimate_settings *settings, pm_vec3 center,
                               const pm_neighbour *nearest, uint32_t found)
{
    double radius2;
    uint32_t counting = counted(settings, nearest, found, &radius2);
    fputs(PM_WEIGHED_HEADER "\n", out);
    for (uint32_t i = 0; i < found; i++) {
        const float *at = map->photons[nearest[i].index].position;
        pm_spectrum power = pm_store_power(map, nearest[i].index);
        fprintf(out, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g", (double)at[0] + center.x,
                (double)at[1] + center.y, (double)at[2] + center.z, power.c[0], power.c[1],
                power.c[2], sqrt(nearest[i].distance2));
        double distance = radius2 > 0.0 ? sqrt(nearest[i].distance2 / radius2) : 0.0;
        PM_TRY(write_weights(out, distance, i < counting));
    }
    return PM_OK;
}

pm_status pm_weighed_write(const char *path, const pm_photon_map *map,
                           const pm_estimate_settings *settings, const pm_estimate_point *point,
                           pm_vec3 center, pm_neighbour *scratch, pm_weighed *out)
{
    pm_estimate estimate;
    uint32_t found;
    PM_TRY(pm_estimate_irradiance(map, settings, point, scratch, &estimate));
    PM_TRY(pm_weighed_search(map, settings, point, scratch, &found));
    pm_file file;
    PM_TRY(pm_file_begin(path, &file));
    pm_status status = write_photons(file.stream, map, settings, center, scratch, found);
    if (status != PM_OK) {
        pm_file_abandon(&file);
        return status;
    }
    PM_TRY(pm_file_commit(&file));
    *out = (pm_weighed){found, estimate.radius};
    return PM_OK;
}

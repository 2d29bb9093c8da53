// The sample is every so many-th photon: in a balanced map they lie all over it, dense where it
// is dense. Distances are those of balls, since a photon's coarse normal would tilt a disc.
#include "first_radius.h"

#include "coarse_normal.h"
#include "estimate.h"

#include <stdlib.h>

#define SAMPLE 256u

/// A search that may be repeated from photon to photon.
typedef struct {
    const pm_photon_map *map;
    uint32_t k; // with the photon that is asked at
    uint16_t skip;
    pm_neighbour *scratch;
} asking;

static pm_status distance_at(const asking *who, uint32_t index, double *distance)
{
    const pm_photon *photon = &who->map->photons[index];
    pm_vec3 at = pm_vec((double)photon->position[0], (double)photon->position[1],
                        (double)photon->position[2]);
    pm_vec3 normal = pm_normal_decode(photon->flags >> PM_PHOTON_NORMAL_SHIFT);
    pm_estimate_query query = {{at, normal}, PM_GATHER_SPHERE, 1.0, who->skip, 0};
    pm_search search = {
        .at = at,
        .k = who->k,
        .radius2 = HUGE_VAL,
        .accept = pm_estimate_accept,
        .context = &query,
    };
    uint32_t found;
    PM_TRY(pm_balance_nearest(who->map, &search, who->scratch, &found, NULL));
    double farthest2 = 0.0;
    for (uint32_t i = 0; i < found; i++) {
        farthest2 = pm_most(farthest2, who->scratch[i].distance2);
    }
    *distance = sqrt(farthest2);
    return PM_OK;
}

/// The first photon of a part of the map that counts, or `end`.
static uint32_t find_counting(const asking *who, uint32_t begin, uint32_t end)
{
    while (begin < end && (who->map->photons[begin].flags & who->skip) != 0) {
        begin++;
    }
    return begin;
}

static pm_status mean_distance(const asking *who, double *mean)
{
    uint64_t count = who->map->count;
    uint32_t parts = count < SAMPLE ? (uint32_t)count : SAMPLE;
    uint32_t asked = 0;
    double sum = 0.0;
    for (uint32_t part = 0; part < parts; part++) {
        uint32_t end = (uint32_t)(count * (part + 1) / parts);
        uint32_t index = find_counting(who, (uint32_t)(count * part / parts), end);
        if (index < end) {
            double distance;
            PM_TRY(distance_at(who, index, &distance));
            sum += distance;
            asked++;
        }
    }
    *mean = asked > 0 ? sum / asked : 0.0;
    return PM_OK;
}

pm_status pm_first_radius(const pm_photon_map *map, uint32_t k, uint16_t skip, double *radius)
{
    if (k == 0 || k > PM_MAP_MAX) {
        return PM_FAIL(PM_EINPUT, "k must be from 1 to %u, got %u", PM_MAP_MAX, k);
    }
    uint32_t most = k < map->count ? k + 1 : map->count;
    if (most < 2) {
        *radius = 0.0;
        return PM_OK;
    }
    asking who = {map, most, skip, calloc(most, sizeof *who.scratch)};
    if (who.scratch == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %u neighbours", most);
    }
    pm_status status = mean_distance(&who, radius);
    free(who.scratch);
    return status;
}

// Along each axis of the plane the mean of k evenly spread positions has the standard deviation
// r / (2 sqrt k).
#include "lean.h"

#define EDGE 0.15
#define SIGMAS 2.5 // more than that is not taken for chance

double pm_lean_of(const pm_photon_map *map, const pm_neighbour *nearest,
                  const pm_estimate *found, const pm_estimate_point *point)
{
    if (found->found == 0) {
        return 0.0;
    }
    pm_vec3 sum = pm_vec(0.0, 0.0, 0.0);
    for (uint32_t i = 0; i < found->found; i++) {
        const float *at = map->photons[nearest[i].index].position;
        pm_vec3 position = pm_vec((double)at[0], (double)at[1], (double)at[2]);
        sum = pm_vec_add(sum, pm_vec_sub(position, point->at));
    }
    sum = pm_vec_along(sum, point->normal, -pm_vec_dot(sum, point->normal));
    return pm_vec_length(sum) / (found->found * found->radius);
}

bool pm_lean_is_edge(double lean, uint32_t found)
{
    return lean > EDGE && lean > SIGMAS * 0.5 / sqrt((double)found);
}

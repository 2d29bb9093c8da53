// Nothing is known of shadows yet: rays decide.
#include "shadow.h"

#include "photon_map.h"

#include <stdlib.h>

pm_status pm_shadow_make(const pm_intersector *world, uint32_t seed, uint64_t count,
                         pm_shadow_maps *maps)
{
    (void)world;
    (void)seed;
    (void)count;
    *maps = (pm_shadow_maps){0};
    return PM_OK;
}

void pm_shadow_free(pm_shadow_maps *maps)
{
    for (int i = 0; i < maps->light_count; i++) {
        pm_photon_map_free(&maps->map[i]);
    }
    free(maps->map);
    *maps = (pm_shadow_maps){0};
}

pm_shadow_answer pm_shadow_ask(const pm_shadow_maps *maps, int light,
                               const pm_estimate_point *point, pm_neighbour *scratch)
{
    (void)maps;
    (void)light;
    (void)point;
    (void)scratch;
    return PM_SHADOW_UNSURE;
}

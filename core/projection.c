// No light is aimed yet.
#include "projection.h"

#include <stdlib.h>
#include <string.h>

pm_status pm_projection_make(const pm_scene *scene, pm_map_kind kind, pm_projections *out)
{
    (void)scene;
    (void)kind;
    *out = (pm_projections){.sent = 1.0, .why = "photons are sent everywhere"};
    return PM_OK;
}

void pm_projection_free(pm_projections *projections)
{
    free(projections->light);
    free(projections->storage);
    *projections = (pm_projections){0};
}

uint64_t pm_projection_saved(const pm_projections *projections, uint64_t emitted)
{
    double all = projections->sent > 0.0 ? (double)emitted / projections->sent : 0.0;
    return all > (double)emitted ? (uint64_t)(all - (double)emitted) : 0;
}

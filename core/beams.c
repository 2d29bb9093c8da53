// Stub: filled in by its owner.
#include "beams.h"

#include <stdlib.h>

pm_status pm_beams_make(const pm_photon_map *map, double radius, uint32_t k, pm_beams *out)
{
    (void)radius;
    (void)k;
    *out = (pm_beams){.map = map};
    return PM_OK;
}

void pm_beams_free(pm_beams *beams)
{
    free(beams->radius);
    free(beams->box);
    *beams = (pm_beams){0};
}

pm_beam pm_beams_query(const pm_beams *beams, const pm_medium *medium, const pm_ray *along,
                       uint16_t skip)
{
    (void)beams;
    (void)medium;
    (void)along;
    (void)skip;
    return (pm_beam){0};
}

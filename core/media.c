// Stub: filled in by its owner.
#include "media.h"

pm_status pm_media_seen(pm_gather *gather, const pm_stretch *along, pm_spectrum *radiance)
{
    (void)gather;
    (void)along;
    *radiance = pm_gray(0.0);
    return PM_OK;
}

pm_status pm_media_gathered(pm_gather *gather, const pm_stretch *along, pm_rng *rng,
                            pm_spectrum *radiance)
{
    (void)rng;
    return pm_media_seen(gather, along, radiance);
}

pm_status pm_media_march(const pm_photon_map *map, const pm_estimate_settings *settings,
                         const pm_medium *medium, const pm_ray *along, double step, pm_rng *rng,
                         pm_neighbour *scratch, pm_spectrum *radiance)
{
    (void)map;
    (void)settings;
    (void)medium;
    (void)along;
    (void)step;
    (void)rng;
    (void)scratch;
    *radiance = pm_gray(0.0);
    return PM_OK;
}

double pm_media_step(const pm_photon_map *map, const pm_medium *medium)
{
    (void)map;
    return 0.5 / medium->sigma_t;
}

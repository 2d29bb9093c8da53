// Lab programs ask for a map by itself, so none is left out here because a picture would not
// need it; that is the plan's business (render_maps.c).
#include "map_make.h"

#include "balance.h"
#include "photon_map.h"

#include <stddef.h>

pm_status pm_map_aim(const pm_options *options, const pm_scene *scene, pm_map_kind kind,
                     pm_projections *out)
{
    if (options->everywhere) {
        *out = (pm_projections){.sent = 1.0,
                                .why = "--projection off: photons are sent everywhere"};
        return PM_OK;
    }
    return pm_projection_make(scene, kind, out);
}

pm_pass_settings pm_map_settings(const pm_options *options, pm_map_kind kind, uint32_t pass)
{
    return (pm_pass_settings){
        .seed = options->seed,
        .pass = pass,
        .count = options->photons[kind],
        .rule = options->roulette,
        .max_bounces = options->max_bounces,
        .unpacked = options->unpacked,
    };
}

pm_status pm_map_make(const pm_options *options, const pm_intersector *world, pm_map_kind kind,
                      uint32_t pass, pm_photon_map *map)
{
    pm_pass_settings settings = pm_map_settings(options, kind, pass);
    pm_projections aim;
    PM_TRY(pm_map_aim(options, world->scene, kind, &aim));
    settings.projections = pm_projection_of(&aim);
    pm_photon_map made;
    pm_status status = pm_photon_pass(world, kind, &settings, &made, NULL);
    pm_projection_free(&aim);
    PM_TRY(status);
    status = pm_balance_build(&made);
    if (status != PM_OK) {
        pm_photon_map_free(&made);
        return status;
    }
    *map = made;
    return PM_OK;
}

const char *pm_map_name(pm_map_kind kind)
{
    static const char *const names[PM_MAP_COUNT] = {"global", "caustic", "volume"};
    return names[kind];
}

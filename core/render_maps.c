// The first half of a picture: the maps that its plan asks for.
#include "render.h"

#include "balance.h"
#include "clock.h"
#include "photon_map.h"

#define GIVE_UP_AFTER 100 // photons emitted for one that was to be stored

pm_render_settings pm_render_defaults(void)
{
    return (pm_render_settings){
        .seed = 1,
        .photons = {200000, 200000, 100000},
        .light = {.estimate = pm_estimate_defaults(),
                  .rays = 64,
                  .light_samples = 16,
                  .spp = 4},
        .only = PM_NONE,
    };
}

static pm_status trace_map(const pm_intersector *world, const pm_render_settings *settings,
                           pm_map_kind kind, pm_render_maps *maps)
{
    uint64_t most = settings->stored * GIVE_UP_AFTER;
    pm_pass_settings pass = {
        .seed = settings->seed,
        .count = settings->stored == 0 ? settings->photons[kind] : most,
        .stored = settings->stored,
        .rule = settings->roulette,
        .max_bounces = settings->max_bounces,
        .unpacked = settings->unpacked,
    };
    PM_TRY(pm_photon_pass(world, kind, &pass, &maps->map[kind], &maps->pass[kind]));
    maps->has[kind] = true;
    return PM_OK;
}

static pm_status balance_map(pm_render_maps *maps, pm_map_kind kind)
{
    if (maps->map[kind].balanced) {
        return PM_OK;
    }
    double start = pm_seconds_now();
    PM_TRY(pm_balance_build(&maps->map[kind]));
    maps->balance_seconds[kind] = pm_seconds_now() - start;
    return PM_OK;
}

/// Whether a layer that is wanted asks the map of `kind`; dots show every map.
static bool asked_for(const pm_render_settings *settings, pm_map_kind kind)
{
    static const int layer[PM_MAP_COUNT] = {
        [PM_MAP_GLOBAL] = PM_LAYER_INDIRECT,
        [PM_MAP_CAUSTIC] = PM_LAYER_CAUSTIC,
        [PM_MAP_VOLUME] = PM_LAYER_VOLUME,
    };
    int only = settings->only;
    return settings->view_photons || only == PM_NONE || only == PM_LAYER_SPECULAR ||
           only == layer[kind];
}

/// The plan says what a map that is off by choice leaves out of the picture.
static void name_what_is_missing(pm_plan *plan, pm_map_kind kind)
{
    if (kind == PM_MAP_GLOBAL) {
        pm_plan_miss(plan, PM_PLAN_INDIRECT,
                     "no global map by choice: all indirect light is missing");
    } else if (kind == PM_MAP_CAUSTIC) {
        pm_plan_miss(plan, PM_PLAN_CAUSTIC, "no caustic map by choice: paths LS+D are missing");
    }
}

pm_status pm_render_make_maps(const pm_intersector *world, const pm_render_settings *settings,
                              pm_render_maps *maps)
{
    maps->plan = pm_plan_scene(world->scene);
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        bool needed = pm_plan_needs_map(&maps->plan, kind) && asked_for(settings, kind);
        if (needed && !maps->has[kind] && settings->photons[kind] == 0) {
            name_what_is_missing(&maps->plan, kind);
        } else if (needed && !maps->has[kind]) {
            PM_TRY(trace_map(world, settings, kind, maps));
        }
        if (maps->has[kind]) {
            PM_TRY(balance_map(maps, kind));
        }
    }
    return PM_OK;
}

void pm_render_maps_free(pm_render_maps *maps)
{
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        pm_photon_map_free(&maps->map[kind]);
        pm_pass_report_free(&maps->pass[kind]);
    }
    *maps = (pm_render_maps){0};
}

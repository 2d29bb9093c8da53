// The first half of a picture: the maps that its plan asks for, and what is made from them.
#include "render.h"

#include "balance.h"
#include "clock.h"
#include "irradiance.h"
#include "lookup.h"
#include "photon_map.h"

#include <string.h>

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
        .pass = settings->pass,
        .count = settings->stored == 0 ? maps->photons[kind] : most,
        .stored = settings->stored,
        .rule = settings->roulette,
        .max_bounces = settings->max_bounces,
        .unpacked = settings->unpacked,
        .projections = pm_projection_of(&maps->aim[kind]),
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

static pm_status make_shadows(const pm_intersector *world, const pm_render_settings *settings,
                              pm_render_maps *maps)
{
    if (maps->shadow_photons == 0) {
        return PM_OK;
    }
    double start = pm_seconds_now();
    pm_shadow_run run = {settings->seed, settings->pass, maps->shadow_photons};
    PM_TRY(pm_shadow_make(world, &run, &maps->shadows));
    maps->shadow_seconds = pm_seconds_now() - start;
    return PM_OK;
}

static pm_status make_irradiance(const pm_intersector *world,
                                 const pm_render_settings *settings, pm_render_maps *maps)
{
    if (!pm_render_precomputes(settings, maps)) {
        return PM_OK;
    }
    double start = pm_seconds_now();
    const pm_photon_map *global = &maps->map[PM_MAP_GLOBAL];
    pm_estimate_settings asked =
        pm_lookup_settings(&settings->light.estimate, settings->reach[PM_MAP_GLOBAL], global);
    PM_TRY(pm_irradiance_make(world, global, &asked, PM_IRRADIANCE_SPACING, &maps->irradiance));
    maps->irradiance_seconds = pm_seconds_now() - start;
    return PM_OK;
}

/// The reach that all lookups of the volume map share, if there is one; else by neighbours.
static pm_status make_beams(const pm_intersector *world, const pm_render_settings *settings,
                            pm_render_maps *maps)
{
    if (!maps->has[PM_MAP_VOLUME] || settings->light.media != PM_MEDIA_BEAMS ||
        settings->view_photons) {
        return PM_OK;
    }
    double start = pm_seconds_now();
    const pm_photon_map *volume = &maps->map[PM_MAP_VOLUME];
    pm_estimate_settings asked =
        pm_lookup_settings(&settings->light.estimate, settings->reach[PM_MAP_VOLUME], volume);
    PM_TRY(pm_beams_make(world, volume, asked.radius, asked.k, PM_PHOTON_FIRST, &maps->beams));
    maps->beams_seconds = pm_seconds_now() - start;
    return PM_OK;
}

pm_status pm_render_trace_maps(const pm_intersector *world, const pm_render_settings *settings,
                               pm_render_maps *maps)
{
    if (!maps->planned) {
        PM_TRY(pm_render_plan(world->scene, settings, maps));
        maps->planned = true;
    }
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (maps->photons[kind] > 0) {
            PM_TRY(trace_map(world, settings, kind, maps));
        }
        if (maps->has[kind]) {
            PM_TRY(balance_map(maps, kind));
        }
    }
    return PM_OK;
}

pm_status pm_render_ready_maps(const pm_intersector *world, const pm_render_settings *settings,
                               pm_render_maps *maps)
{
    PM_TRY(make_shadows(world, settings, maps));
    PM_TRY(make_beams(world, settings, maps));
    return make_irradiance(world, settings, maps);
}

pm_status pm_render_make_maps(const pm_intersector *world, const pm_render_settings *settings,
                              pm_render_maps *maps)
{
    PM_TRY(pm_render_trace_maps(world, settings, maps));
    return pm_render_ready_maps(world, settings, maps);
}

static void free_traced(pm_render_maps *maps)
{
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        pm_photon_map_free(&maps->map[kind]);
        pm_pass_report_free(&maps->pass[kind]);
    }
    pm_photon_map_free(&maps->irradiance);
    pm_shadow_free(&maps->shadows);
    pm_beams_free(&maps->beams);
}

void pm_render_maps_free(pm_render_maps *maps)
{
    free_traced(maps);
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        pm_projection_free(&maps->aim[kind]);
    }
    *maps = (pm_render_maps){0};
}

void pm_render_maps_renew(pm_render_maps *maps)
{
    free_traced(maps);
    pm_render_maps fresh = {
        .planned = maps->planned,
        .plan = maps->plan,
        .shadow_photons = maps->shadow_photons,
    };
    memcpy(fresh.photons, maps->photons, sizeof fresh.photons);
    memcpy(fresh.aim, maps->aim, sizeof fresh.aim);
    *maps = fresh;
}

// What a picture's settings make of the plan: which maps are traced, with how many photons,
// aimed where.
#include "render.h"

#include <stdio.h>
#include <string.h>

bool pm_render_shows(const pm_render_settings *settings, pm_layer layer)
{
    int only = settings->only;
    return settings->view_photons || only == PM_NONE || only == PM_LAYER_SPECULAR ||
           only == (int)layer;
}

/// Whether a part exists in the scene and is shown.
static bool lives(const pm_plan *plan, const pm_render_settings *settings, pm_plan_part part,
                  pm_layer layer)
{
    return plan->item[part].needed && pm_render_shows(settings, layer);
}

/// Whether the picture asks the volume map: where a medium is seen, or runs along gather rays.
static bool asks_volume(const pm_plan *plan, const pm_render_settings *settings)
{
    bool gathers =
        settings->light.rays > 0 && lives(plan, settings, PM_PLAN_INDIRECT, PM_LAYER_INDIRECT);
    return lives(plan, settings, PM_PLAN_VOLUME, PM_LAYER_VOLUME) ||
           (gathers && plan->item[PM_PLAN_VOLUME].needed);
}

/// Whether the picture asks the map of `kind`. Gather rays find caustics in the global map.
static bool asks(const pm_plan *plan, const pm_render_settings *settings, pm_map_kind kind)
{
    bool caustic = lives(plan, settings, PM_PLAN_CAUSTIC, PM_LAYER_CAUSTIC);
    bool indirect = lives(plan, settings, PM_PLAN_INDIRECT, PM_LAYER_INDIRECT);
    bool from_global = settings->light.caustics_global;
    switch (kind) {
    case PM_MAP_GLOBAL:
        return indirect || (caustic && from_global);
    case PM_MAP_CAUSTIC:
        return caustic && !from_global;
    default:
        return asks_volume(plan, settings);
    }
}

/// The plan says what a map that is off by choice leaves out of the picture.
static void name_what_is_missing(pm_plan *plan, const pm_render_settings *settings,
                                 pm_map_kind kind)
{
    if (kind == PM_MAP_CAUSTIC) {
        pm_plan_miss(plan, PM_PLAN_CAUSTIC, "no caustic map by choice: paths LS+D are missing");
        return;
    }
    if (kind == PM_MAP_VOLUME) {
        pm_plan_miss(
            plan, PM_PLAN_VOLUME,
            "no volume map by choice: paths L{S|D|V}+V, all that media scatter but LV, "
            "straight from lights, are missing, in indirect light too");
        return;
    }
    if (plan->item[PM_PLAN_INDIRECT].needed) {
        char what[160];
        snprintf(what, sizeof what,
                 "no global map by choice: paths %s, all indirect light, are missing",
                 pm_plan_paths(plan, PM_PLAN_INDIRECT));
        pm_plan_miss(plan, PM_PLAN_INDIRECT, what);
    }
    if (plan->item[PM_PLAN_CAUSTIC].needed && settings->light.caustics_global) {
        pm_plan_miss(plan, PM_PLAN_CAUSTIC,
                     "no global map by choice, and --caustics global: paths LS+D are missing");
    }
}

/// How many photons each map gets; a map that would get none by choice is noted.
static pm_status deal_out(const pm_render_settings *settings, pm_render_maps *maps)
{
    bool traced[PM_MAP_COUNT];
    bool any = false;
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        traced[kind] = !maps->has[kind] && asks(&maps->plan, settings, kind);
        any = any || traced[kind];
    }
    if (settings->total > 0 && any) {
        return pm_plan_split(settings->total, traced, maps->photons);
    }
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        maps->photons[kind] = traced[kind] ? settings->photons[kind] : 0;
        if (traced[kind] && maps->photons[kind] == 0) {
            name_what_is_missing(&maps->plan, settings, kind);
        }
    }
    return PM_OK;
}

/// Where projection maps are off by choice the plan still says what they would be worth.
static pm_status aim(const pm_scene *scene, const pm_render_settings *settings,
                     pm_render_maps *maps)
{
    const pm_projections *aims[PM_MAP_COUNT] = {0};
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        if (maps->photons[kind] > 0) {
            PM_TRY(pm_projection_make(scene, kind, &maps->aim[kind]));
            aims[kind] = &maps->aim[kind];
        }
    }
    pm_plan_aim(&maps->plan, aims);
    pm_plan_item *item = &maps->plan.item[PM_PLAN_PROJECTION];
    if (settings->everywhere && item->needed) {
        char worth[sizeof item->why];
        memcpy(worth, item->why, sizeof worth);
        snprintf(item->why, sizeof item->why, "off by choice; on, %.360s", worth);
    }
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT && settings->everywhere; kind++) {
        pm_projection_free(&maps->aim[kind]);
    }
    return PM_OK;
}

/// As many shadow photons as the global map gets, or would get.
static uint64_t count_shadows(const pm_render_settings *settings, const pm_render_maps *maps)
{
    bool asked = settings->direct_photons && !settings->view_photons &&
                 lives(&maps->plan, settings, PM_PLAN_DIRECT, PM_LAYER_DIRECT);
    if (!asked) {
        return 0;
    }
    const uint64_t counts[] = {maps->photons[PM_MAP_GLOBAL], settings->total,
                               settings->photons[PM_MAP_GLOBAL]};
    for (int i = 0; i < 3; i++) {
        if (counts[i] > 0) {
            return counts[i];
        }
    }
    return pm_render_defaults().photons[PM_MAP_GLOBAL];
}

bool pm_render_precomputes(const pm_render_settings *settings, const pm_render_maps *maps)
{
    bool global = maps->has[PM_MAP_GLOBAL] || maps->photons[PM_MAP_GLOBAL] > 0;
    return settings->precompute && !settings->view_photons && settings->light.rays > 0 &&
           global && lives(&maps->plan, settings, PM_PLAN_INDIRECT, PM_LAYER_INDIRECT);
}

pm_status pm_render_plan(const pm_scene *scene, const pm_render_settings *settings,
                         pm_render_maps *maps)
{
    maps->plan = pm_plan_scene(scene);
    PM_TRY(deal_out(settings, maps));
    PM_TRY(aim(scene, settings, maps));
    maps->shadow_photons = count_shadows(settings, maps);
    return PM_OK;
}

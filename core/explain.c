// Every part says its paths and its cost where it is needed; a user's choices come after, then
// what is never offered.
#include "explain.h"

#include "choice.h"
#include "map_make.h"
#include "report.h"
#include "wrap.h"

#define INDENT 16

static const char no_shadow_maps[] =
    "shadow rays are exact wherever they end, for a light of any shape; a shadow map would be "
    "one more picture of the scene for each light, with a resolution and a depth bias of its "
    "own to choose and to measure";

static void print_below(const char *line, FILE *stream)
{
    fprintf(stream, "%*s", INDENT, "");
    pm_wrap_print(line, INDENT, stream);
}

/// Which map serves a part, with how many photons.
static void describe_map(const pm_render_settings *settings, const pm_render_maps *maps,
                         pm_map_kind kind, char *text, size_t room)
{
    if (maps->photons[kind] > 0 && settings->stored > 0) {
        snprintf(text, room, "%s map, until %llu photons are stored", pm_map_name(kind),
                 (unsigned long long)settings->stored);
    } else if (maps->photons[kind] > 0) {
        snprintf(text, room, "%s map, %llu photons", pm_map_name(kind),
                 (unsigned long long)maps->photons[kind]);
    } else {
        snprintf(text, room, "%s map, %s", pm_map_name(kind),
                 maps->has[kind] ? "from a file" : "not traced");
    }
}

/// Rays of a pixel: each of its samples shoots as many, and at least one.
static uint32_t rays_shot(uint32_t asked, uint32_t spp)
{
    return (asked + spp - 1) / spp * spp;
}

static void describe_volume(const pm_render_settings *settings, const pm_render_maps *maps,
                            char *text, size_t room)
{
    char map[64];
    describe_map(settings, maps, PM_MAP_VOLUME, map, sizeof map);
    snprintf(text, room,
             "LV by points along each ray that passes a medium, %u a pixel for each light; the "
             "rest from the %s, asked by %s",
             rays_shot(settings->light.light_samples, settings->light.spp), map,
             settings->light.media == PM_MEDIA_MARCH ? "marching" : "beams");
}

static void describe_cost(const pm_render_settings *settings, const pm_render_maps *maps,
                          pm_plan_part part, char *text, size_t room)
{
    const pm_gather_settings *light = &settings->light;
    bool own = !light->caustics_global;
    char map[64];
    describe_map(settings, maps,
                 part == PM_PLAN_CAUSTIC && own ? PM_MAP_CAUSTIC : PM_MAP_GLOBAL, map,
                 sizeof map);
    if (part == PM_PLAN_DIRECT) {
        snprintf(text, room,
                 "%u shadow rays a pixel to each area light and the sky, %u to others; no map",
                 rays_shot(light->light_samples, light->spp), light->spp);
    } else if (part == PM_PLAN_SPECULAR) {
        snprintf(text, room, "eye rays go on through mirrors and glass; no map");
    } else if (part == PM_PLAN_CAUSTIC) {
        snprintf(text, room, "%s", map);
    } else if (part == PM_PLAN_VOLUME) {
        describe_volume(settings, maps, text, room);
    } else if (light->rays > 0) {
        snprintf(text, room, "%s, and %u gather rays a pixel", map,
                 rays_shot(light->rays, light->spp));
    } else {
        snprintf(text, room, "%s, seen directly", map);
    }
}

static void print_part(const pm_render_settings *settings, const pm_render_maps *maps,
                       pm_plan_part part, FILE *stream)
{
    const pm_plan_item *item = &maps->plan.item[part];
    fprintf(stream, "%-10s  %-3s ", pm_plan_name(part), item->needed ? "yes" : "no");
    pm_wrap_print(item->why, INDENT, stream);
    const char *paths = pm_plan_paths(&maps->plan, part);
    if (item->needed && paths[0] != '\0') {
        char cost[192];
        char line[256];
        describe_cost(settings, maps, part, cost, sizeof cost);
        snprintf(line, sizeof line, "paths %s: %s", paths, cost);
        print_below(line, stream);
    }
}

static void print_choices(const pm_render_settings *settings, const pm_render_maps *maps,
                          FILE *stream)
{
    pm_choice choices[PM_CHOICES_MAX];
    int count = pm_choice_list(settings, maps, choices);
    if (count > 0) {
        fputs("\nby choice\n", stream);
    }
    for (int i = 0; i < count; i++) {
        char line[320];
        snprintf(line, sizeof line, "%.31s: %.255s", choices[i].option, choices[i].effect);
        print_below(line, stream);
    }
}

static void print_split(const pm_render_settings *settings, FILE *stream)
{
    if (settings->total > 0) {
        char line[256];
        snprintf(line, sizeof line,
                 "--photons %llu: split among the maps that are traced, global to caustic to "
                 "volume as 2 : 2 : 1; aimed maps get no fewer, so that aiming makes them "
                 "better",
                 (unsigned long long)settings->total);
        print_below(line, stream);
    }
}

void pm_explain_print(const pm_render_settings *settings, const pm_render_maps *maps,
                      FILE *stream)
{
    for (pm_plan_part part = 0; part < PM_PLAN_COUNT; part++) {
        print_part(settings, maps, part, stream);
    }
    print_split(settings, stream);
    print_choices(settings, maps, stream);
    fputs("\nnot offered\n", stream);
    char line[320];
    snprintf(line, sizeof line, "shadow maps: %s", no_shadow_maps);
    print_below(line, stream);
    fputs("\nPaths are spelled from the light L on: S mirrored or refracted, D scattered "
          "diffusely,\nV scattered in a medium; {S|D} either, + once or more, * any number.\n",
          stream);
}

json_t *pm_explain_choices(const pm_render_settings *settings, const pm_render_maps *maps)
{
    pm_choice choices[PM_CHOICES_MAX];
    int count = pm_choice_list(settings, maps, choices);
    json_t *array = json_array();
    for (int i = 0; i < count; i++) {
        json_t *entry = json_pack("{s:s,s:s,s:b,s:b}", "option", choices[i].option, "effect",
                                  choices[i].effect, "missing", choices[i].missing, "idle",
                                  choices[i].idle);
        array = pm_report_append(array, entry);
    }
    return array;
}

json_t *pm_explain_json(const pm_render_settings *settings, const pm_render_maps *maps)
{
    json_t *object = pm_report_add(json_object(), "plan", pm_report_plan(&maps->plan));
    object = pm_report_add(object, "photons", pm_report_photons(maps->photons));
    object = pm_report_add(object, "choices", pm_explain_choices(settings, maps));
    json_t *missing = json_pack("[{s:s,s:s}]", "what", "shadow maps", "why", no_shadow_maps);
    return pm_report_add(object, "not_offered", missing);
}

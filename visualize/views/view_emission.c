// view emission: photons leaving the lights. How many arrows a light has shows its share of the
// power, since all lights are thinned alike.
#include "draw_rays.h"
#include "light_pick.h"
#include "ray_file.h"
#include "view.h"
#include "view_kinds.h"

#include <stdio.h>

#define DOTS 20000
#define ARROWS 160
#define ARROW 0.3 // scene radii
#define NEARLY 1e-3

enum { LINE_MAX_CHARS = 96, LIGHTS_LISTED = PM_LIGHT_COLOURS };

/// "1,234 photons, 64.5 W", and of how much when that is not all that the light has.
static void describe(const pm_light *light, const pm_ray_sum *sum, char *text)
{
    char count[PM_VIEW_GROUPED_MAX];
    double carried = pm_spectrum_mean(sum->power);
    double full = pm_spectrum_mean(light->flux);
    int used =
        snprintf(text, LINE_MAX_CHARS, "%s photon%s, %.4g W",
                 pm_view_grouped(sum->count, count), sum->count == 1 ? "" : "s", carried);
    if (fabs(carried - full) > NEARLY * full) {
        snprintf(text + used, (size_t)(LINE_MAX_CHARS - used), " of %.4g", full);
    }
}

/// Two lines of the legend a light: its colour and name, what its photons are and carry.
static pm_status add_legend(const pm_view *view, const pm_ray_choice *choice, int only)
{
    const pm_scene *scene = &view->scene;
    char text[LIGHTS_LISTED + 1][LINE_MAX_CHARS];
    pm_legend_entry entries[2 * LIGHTS_LISTED + 1];
    int used = 0;
    int lines = 0;
    int unlisted = 0;
    for (int i = 0; i < scene->light_count; i++) {
        if (only != PM_NONE && i != only) {
            continue;
        }
        if (used == LIGHTS_LISTED) {
            unlisted++;
            continue;
        }
        describe(&scene->lights[i], &choice->light[i], text[used]);
        entries[lines++] =
            (pm_legend_entry){PM_SWATCH_DOT, pm_light_colour(i), scene->lights[i].id};
        entries[lines++] = (pm_legend_entry){.swatch = PM_SWATCH_NONE, .text = text[used++]};
    }
    if (unlisted > 0) {
        snprintf(text[used], LINE_MAX_CHARS, "and %d more", unlisted);
        entries[lines++] = (pm_legend_entry){.swatch = PM_SWATCH_DOT,
                                             .colour = pm_light_colour(PM_LIGHT_COLOURS),
                                             .text = text[used]};
    }
    return pm_figure_legend(view->figure, used == 1 ? "the light" : "lights", entries, lines);
}

static uint64_t count_past(const pm_ray_choice *choice, const pm_scene *scene, int only)
{
    uint64_t past = 0;
    for (int i = 0; i < scene->light_count; i++) {
        past += only == PM_NONE || i == only ? choice->light[i].past : 0;
    }
    return past;
}

static void write_note(pm_view *view, const pm_ray_set *rays, const pm_ray_choice *choice,
                       int only)
{
    char all[PM_VIEW_GROUPED_MAX];
    char few[PM_VIEW_GROUPED_MAX];
    uint64_t past = count_past(choice, &view->scene, only);
    uint64_t sent = only == PM_NONE ? rays->count : choice->light[only].count;
    pm_view_note(
        view, "a dot where a photon starts, an arrow the way it goes; the more power a light "
              "has, the more photons\n");
    pm_view_note(view, "%s photon%s leave%s", pm_view_grouped(sent, all), sent == 1 ? "" : "s",
                 sent == 1 ? "s" : "");
    if (choice->count < sent - past) {
        pm_view_note(view, ", %s drawn", pm_view_grouped(choice->count, few));
    }
    if (choice->arrows < choice->count) {
        pm_view_note(view, ", %s with an arrow", pm_view_grouped(choice->arrows, few));
    }
    if (past > 0) {
        pm_view_note(view, "; %s from outside go%s past the scene", pm_view_grouped(past, few),
                     past == 1 ? "es" : "");
    }
}

static void add_facts(pm_view *view, const pm_ray_choice *choice)
{
    json_t *lights = json_array();
    for (int i = 0; i < view->scene.light_count; i++) {
        const pm_ray_sum *sum = &choice->light[i];
        json_array_append_new(
            lights, json_pack("{s:s,s:I,s:I,s:[f,f,f]}", "id", view->scene.lights[i].id,
                              "photons", (json_int_t)sum->count, "past", (json_int_t)sum->past,
                              "power", sum->power.c[0], sum->power.c[1], sum->power.c[2]));
    }
    pm_view_fact(view, "lights", lights);
    pm_view_fact(view, "arrows", json_integer((json_int_t)choice->arrows));
}

static pm_status draw_choice(pm_view *view, const pm_ray_set *rays, int only)
{
    pm_ray_choice choice;
    PM_TRY(pm_ray_pick(rays, &view->scene, only, DOTS, ARROWS, &choice));
    view->drawn = choice.count;
    double dot_size = choice.count > 500 ? 3.0 : 5.0;
    pm_status status =
        pm_draw_rays(view->figure, &choice, dot_size, ARROW * view->scene.radius);
    if (status == PM_OK) {
        status = add_legend(view, &choice, only);
    }
    write_note(view, rays, &choice, only);
    add_facts(view, &choice);
    pm_ray_pick_free(&choice);
    return status;
}

static pm_status draw(pm_view *view)
{
    int only = PM_NONE;
    pm_ray_set rays;
    PM_TRY(pm_light_pick(&view->scene, view->options->light, &only));
    PM_TRY(pm_ray_file_read(view->files[0], &view->scene, &rays));
    pm_status status = draw_choice(view, &rays, only);
    pm_ray_file_free(&rays);
    return status;
}

const pm_view_kind pm_view_emission = {
    .name = "emission",
    .files = "RAYS.csv (emission --dump)",
    .shows = "photons leaving the lights",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_IN_SCENE,
    .options = "light",
    .title = "Emission: photons leave the lights",
    .draw = draw,
};

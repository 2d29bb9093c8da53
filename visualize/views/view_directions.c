// view directions: which way photons leave, held against the way they should. On top the unit
// sphere in the colour of the density that is due, with a dot a photon; below the same density
// over the angle, with what was counted.
#include "light_pick.h"
#include "view_directions_panel.h"
#include "view_kinds.h"

#include <stdio.h>
#include <stdlib.h>

#define SHOWN_MOST 4
#define NEARLY 1e-3 // shares that are the same but for the digits of a file

typedef struct {
    pm_ray_set rays;
    pm_direction_light light[SHOWN_MOST];
    int count, senders; // lights shown, and those that could be
} job;

/// How many photons and bands leave something to be seen on that many panels.
static const struct {
    uint64_t dots;
    int bands;
} room_for[SHOWN_MOST + 1] = {
    {0, 0}, {1500, PM_RAY_BANDS_MAX}, {900, 16}, {400, 10}, {400, 10}};

static void release(job *j)
{
    for (int i = 0; i < j->count; i++) {
        free(j->light[i].dots);
    }
    pm_ray_file_free(&j->rays);
}

// --- the data ----------------------------------------------------------------------------

/// Directions at even steps, so many that dots stay apart.
static pm_status take_dots(const pm_ray_set *rays, uint64_t dots, pm_direction_light *s)
{
    uint64_t most = s->tally.count < dots ? s->tally.count : dots;
    s->dots = calloc((size_t)most + 1, sizeof *s->dots);
    if (s->dots == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for directions");
    }
    uint64_t met = 0;
    for (uint64_t i = 0; i < rays->count && s->dot_count < most; i++) {
        const pm_ray_start *ray = &rays->rays[i];
        if (ray->light == (uint32_t)s->index && met++ == s->dot_count * s->tally.count / most) {
            pm_vec3 way = pm_light_law_local(&s->law, ray);
            bool stray = pm_ray_tally_is_stray(&s->law, way);
            s->dots[s->dot_count++] = (pm_direction_dot){way, ray->power, stray};
        }
    }
    return PM_OK;
}

static bool sends_any(const pm_ray_set *rays, int light)
{
    for (uint64_t i = 0; i < rays->count; i++) {
        if (rays->rays[i].light == (uint32_t)light) {
            return true;
        }
    }
    return false;
}

static pm_status choose_lights(const pm_view *view, job *j)
{
    int only = PM_NONE;
    PM_TRY(pm_light_pick(&view->scene, view->options->light, &only));
    PM_TRY(pm_ray_file_read(view->files[0], &view->scene, &j->rays));
    for (int i = 0; i < view->scene.light_count; i++) {
        if ((only != PM_NONE && i != only) || !sends_any(&j->rays, i)) {
            continue;
        }
        if (j->senders++ < SHOWN_MOST) {
            j->light[j->count++].index = i;
        }
    }
    if (j->count == 0) {
        return pm_status_fail(PM_EINPUT, "%s: holds no photon of the light \"%s\"",
                              view->files[0], view->options->light);
    }
    return PM_OK;
}

static pm_status count_directions(const pm_view *view, job *j)
{
    for (int i = 0; i < j->count; i++) {
        pm_direction_light *s = &j->light[i];
        s->law = pm_light_law_of(&view->scene, s->index);
        s->tally = pm_ray_tally_make(&j->rays, &s->law, s->index, room_for[j->count].bands);
        PM_TRY(take_dots(&j->rays, room_for[j->count].dots, s));
    }
    return PM_OK;
}

// --- the page ----------------------------------------------------------------------------

/// One light has a scale of its own; several share one, from nothing to the most of each.
static pm_status add_blocks(pm_view *view, const job *j)
{
    bool alone = j->count == 1;
    bool strays = false;
    bool law = false;
    for (int i = 0; i < j->count; i++) {
        strays |= j->light[i].tally.strays > 0;
        law |= !j->light[i].law.single;
    }
    double most = alone ? pm_light_law_density(&j->light[0].law, 0.0) : 1.0;
    pm_scale scale = {alone ? "density due [1/sr]"
                            : "density due, as part\nof the light's most",
                      0.0, most, false, pm_direction_colour};
    if (law) {
        PM_TRY(pm_figure_scale(view->figure, &scale));
    }
    const pm_legend_entry all[] = {
        {PM_SWATCH_FILL, pm_direction_dark(), "no photon is due here"},
        {PM_SWATCH_DOT, pm_colour_named(PM_COLOUR_WHITE), "a photon's direction"},
        {PM_SWATCH_DOT, pm_direction_stray(), "one where none is due"},
    };
    PM_TRY(pm_figure_legend(view->figure, "on the sphere", all, strays ? 3 : 2));
    const pm_legend_entry chart[] = {
        {PM_SWATCH_LINE, pm_colour_named(PM_COLOUR_ORANGE), "density due"},
        {PM_SWATCH_DOT, pm_colour_named(PM_COLOUR_WHITE), "photons counted"},
        {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_WHITE), "bars: one standard deviation"},
    };
    return law ? pm_figure_legend(view->figure, "in the chart", chart, 3) : PM_OK;
}

/// Photons that carry less than their light has were aimed; more is a mistake.
static void note_power(pm_view *view, const job *j)
{
    const pm_direction_light *odd = NULL;
    int count = 0;
    for (int i = 0; i < j->count; i++) {
        if (fabs(j->light[i].tally.sent - 1.0) > NEARLY) {
            odd = &j->light[i];
            count++;
        }
    }
    if (count == 1) {
        pm_view_note(view, "; %.3g %% of the power of %s is sent%s", 100.0 * odd->tally.sent,
                     odd->law.light->id, odd->tally.sent < 1.0 ? " (the rest is dark)" : "");
    } else if (count > 1) {
        pm_view_note(view, "; %d of these lights send less or more than their power", count);
    }
}

static void write_note(pm_view *view, const job *j)
{
    uint64_t photons = 0;
    uint64_t strays = 0;
    char text[PM_VIEW_GROUPED_MAX];
    pm_view_note(
        view, "%s",
        "photons must leave as densely as the light's law says: the sphere's colour, the line "
        "in the chart\n");
    for (int i = 0; i < j->count; i++) {
        photons += j->light[i].tally.count;
        strays += j->light[i].tally.strays;
        view->drawn += j->light[i].dot_count;
    }
    pm_view_note(view, "%s photon%s", pm_view_grouped(photons, text), photons == 1 ? "" : "s");
    if (view->drawn < photons) {
        pm_view_note(view, ", %s drawn", pm_view_grouped(view->drawn, text));
    }
    if (strays > 0) {
        pm_view_note(view, ", %s where none is due", pm_view_grouped(strays, text));
    }
    if (j->senders > j->count) {
        pm_view_note(view, "; %d of %d lights, --light picks", j->count, j->senders);
    }
    note_power(view, j);
}

static json_t *numbers(const double *values, int count)
{
    json_t *array = json_array();
    for (int i = 0; i < count; i++) {
        json_array_append_new(array, json_real(values[i]));
    }
    return array;
}

static void add_facts(pm_view *view, const job *j)
{
    json_t *lights = json_array();
    for (int i = 0; i < j->count; i++) {
        const pm_direction_light *s = &j->light[i];
        const pm_ray_tally *t = &s->tally;
        json_array_append_new(
            lights,
            json_pack("{s:s,s:I,s:I,s:f,s:o,s:o,s:o}", "id", s->law.light->id, "photons",
                      (json_int_t)t->count, "strays", (json_int_t)t->strays, "sent", t->sent,
                      "border", numbers(t->border, t->bands > 0 ? t->bands + 1 : 0), "density",
                      numbers(t->density, t->bands), "error", numbers(t->error, t->bands)));
    }
    pm_view_fact(view, "lights", lights);
}

/// One light fills the page, two stand side by side, more in two rows.
static void lay_out(const pm_figure *figure, int count, pm_rect *cells)
{
    pm_rect room = pm_figure_room(figure);
    if (count <= 2) {
        pm_figure_columns(figure, &room, count, cells);
        return;
    }
    pm_rect row = {room.x, room.y, room.width, room.height / 2};
    pm_figure_columns(figure, &row, 2, cells);
    row.y += row.height;
    pm_figure_columns(figure, &row, 2, cells + 2);
}

static pm_status draw_job(pm_view *view, job *j)
{
    pm_rect cells[SHOWN_MOST];
    PM_TRY(choose_lights(view, j));
    PM_TRY(count_directions(view, j));
    lay_out(view->figure, j->count, cells);
    for (int i = 0; i < j->count; i++) {
        PM_TRY(pm_draw_direction_light(view, &j->light[i], i, j->count > 2, &cells[i]));
    }
    write_note(view, j);
    add_facts(view, j);
    return add_blocks(view, j);
}

static pm_status draw(pm_view *view)
{
    job j = {0};
    pm_status status = draw_job(view, &j);
    release(&j);
    return status;
}

const pm_view_kind pm_view_directions = {
    .name = "directions",
    .files = "RAYS.csv (emission --dump)",
    .shows = "the ways that photons leave, and should",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_FOR_SCENE,
    .options = "light",
    .title = "Directions: which way photons leave the lights",
    .draw = draw,
};

// view weights: the photons of one estimate under each kernel, looked at from straight above.
#include "draw_scene.h"
#include "draw_weights.h"
#include "kernel_look.h"
#include "view.h"
#include "view_kinds.h"
#include "weight_file.h"

#include <math.h>
#include <stdio.h>

#define ROWS 2
#define COLUMNS 2
#define AROUND 1.06        // half a panel, in radii
#define OVERVIEW_900 230.0 // height of the panel that shows where it is
#define EDGE_900 24.0
#define PIN 0.35 // length of the pin in the overview, in scene radii
#define GAP_900 10.0

/// Half the sides of the box around a disc.
static pm_vec3 half_box(pm_vec3 normal, double radius)
{
    return pm_vec(radius * sqrt(pm_most(0.0, 1.0 - normal.x * normal.x)),
                  radius * sqrt(pm_most(0.0, 1.0 - normal.y * normal.y)),
                  radius * sqrt(pm_most(0.0, 1.0 - normal.z * normal.z)));
}

/// The axis that a direction is nearest to.
static pm_vec3 snap(pm_vec3 v)
{
    double x = fabs(v.x);
    double y = fabs(v.y);
    double z = fabs(v.z);
    return x >= y && x >= z ? pm_vec(v.x < 0.0 ? -1.0 : 1.0, 0.0, 0.0)
           : y >= z         ? pm_vec(0.0, v.y < 0.0 ? -1.0 : 1.0, 0.0)
                            : pm_vec(0.0, 0.0, v.z < 0.0 ? -1.0 : 1.0);
}

/// Up in the panels: an axis, as near as can be to what is up in the scene's picture, so that
/// boxes are seen along their edges.
static pm_vec3 choose_up(const pm_scene *scene, pm_vec3 normal)
{
    pm_vec3 up = scene->has_camera ? scene->camera.up : pm_vec(0.0, 1.0, 0.0);
    pm_vec3 away = scene->has_camera ? scene->camera.forward : pm_vec(0.0, 0.0, -1.0);
    pm_vec3 chosen = fabs(pm_vec_dot(up, normal)) < 0.8 ? up : away;
    pm_vec3 flat = pm_vec_along(chosen, normal, -pm_vec_dot(chosen, normal));
    pm_vec3 axis = snap(flat);
    return fabs(pm_vec_dot(axis, normal)) < 0.9 ? axis : pm_frame_around(normal).s;
}

static pm_viewpoint look_down(const pm_scene *scene, const pm_weighed_set *set,
                              const pm_rect *where)
{
    pm_vec3 half = half_box(set->normal, AROUND * set->radius);
    return pm_viewpoint_box(pm_vec_sub(set->at, half), pm_vec_add(set->at, half),
                            pm_vec_negate(set->normal), choose_up(scene, set->normal),
                            where->width, where->height);
}

static void write_result(const pm_weighed_set *set, int kernel, char *text, size_t room)
{
    const pm_kernel_result *result = &set->result[kernel];
    const char *words = pm_kernel_look_of(pm_weight_file_kernel(kernel)).words;
    int used = snprintf(text, room, "%s: %.4g W/m\xC2\xB2", words, result->mean);
    if (set->samples > 1.0 && result->mean > 0.0) {
        snprintf(text + used, room - (size_t)used, ", noise %.1f %%",
                 100.0 * result->rms / result->mean);
    }
}

static pm_status draw_kernel(pm_view *view, const pm_weighed_set *set, int kernel,
                             const pm_rect *where)
{
    char heading[96];
    write_result(set, kernel, heading, sizeof heading);
    pm_viewpoint viewpoint = look_down(&view->scene, set, where);
    PM_TRY(pm_figure_panel(view->figure, where, &viewpoint));
    PM_TRY(pm_figure_caption(view->figure, where, heading));
    PM_TRY(pm_draw_scene(view->figure, &view->scene));
    PM_TRY(pm_draw_weights(view->figure, set, kernel));
    return kernel == 0 ? pm_draw_weights_keep(view->figure, set) : PM_OK;
}

static pm_status draw_kernels(pm_view *view, const pm_weighed_set *set)
{
    pm_rect room = pm_figure_room(view->figure);
    int gap = (int)pm_figure_pixels_of(view->figure, GAP_900);
    for (int row = 0; row < ROWS; row++) {
        pm_rect part = room;
        pm_rect cells[COLUMNS];
        part.height = (room.height - gap * (ROWS - 1)) / ROWS;
        part.y += row * (part.height + gap);
        pm_figure_columns(view->figure, &part, COLUMNS, cells);
        for (int column = 0; column < COLUMNS; column++) {
            PM_TRY(draw_kernel(view, set, row * COLUMNS + column, &cells[column]));
        }
    }
    return PM_OK;
}

/// At the foot of the right column.
static pm_status draw_overview(pm_view *view, const pm_weighed_set *set)
{
    int width;
    int height;
    pm_figure_size(view->figure, &width, &height);
    int edge = (int)pm_figure_pixels_of(view->figure, EDGE_900);
    int high = (int)pm_figure_pixels_of(view->figure, OVERVIEW_900);
    int left = (int)((1.0 - PM_VIEWPOINT_RIGHT) * width) + edge;
    pm_rect where = {left, height - edge - high, width - edge - left, high};
    PM_TRY(pm_view_wordless_panel(view, &where, NULL, "where it is"));
    return pm_draw_weights_place(view->figure, set, PIN * view->scene.radius);
}

static json_t *results_json(const pm_weighed_set *set)
{
    json_t *all = json_object();
    for (int kernel = 0; kernel < PM_WEIGHT_KERNELS; kernel++) {
        const pm_kernel_result *result = &set->result[kernel];
        json_object_set_new(all, pm_weight_file_kernel(kernel),
                            json_pack("{s:f,s:f}", "mean", result->mean, "rms", result->rms));
    }
    return all;
}

static void write_note(pm_view *view, const pm_weighed_set *set)
{
    char photons[PM_VIEW_GROUPED_MAX];
    pm_view_note(view,
                 "seen from straight above: the same %s photons, each as large and "
                 "bright as a kernel makes it count\n",
                 pm_view_grouped(set->count, photons));
    if (set->samples > 1.0) {
        char runs[PM_VIEW_GROUPED_MAX];
        pm_view_note(view,
                     "irradiance: mean of %s maps (the first is drawn); noise: how far one "
                     "map is off that, rms",
                     pm_view_grouped((uint64_t)set->samples, runs));
    } else {
        pm_view_note(view, "%s", "irradiance: their powers times weights over the disc's area");
    }
}

static pm_status draw_all(pm_view *view, const pm_weighed_set *set)
{
    view->drawn = set->count;
    write_note(view, set);
    pm_view_fact(view, "results", results_json(set));
    PM_TRY(draw_kernels(view, set));
    PM_TRY(pm_draw_weights_legend(view->figure, set));
    return draw_overview(view, set);
}

static pm_status draw(pm_view *view)
{
    pm_weighed_set set;
    PM_TRY(pm_weight_file_read(view->files[0], view->files[1], &view->scene, &set));
    pm_status status = draw_all(view, &set);
    pm_weight_file_free(&set);
    return status;
}

const pm_view_kind pm_view_weights = {
    .name = "weights",
    .files = "PHOTONS.csv REPORT.json (filtering --gathered --report)",
    .shows = "what each photon of an estimate counts",
    .files_least = 2,
    .files_most = 2,
    .scene = PM_VIEW_FOR_SCENE,
    .options = "",
    .title = "Kernels on the photons of one estimate",
    .draw = draw,
};

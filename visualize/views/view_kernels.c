// view kernels: how much a photon counts by its distance, and whether a kernel gives all of the
// light back.
#include "chart.h"
#include "kernel_file.h"
#include "kernel_look.h"
#include "view.h"
#include "view_kinds.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define LABEL_MAX 96
#define SAME 1e-6  // weights and means nearer than this are the same
#define UPPER 0.58 // of the page for the first chart

static double mean_of(const pm_kernel_curve *curve)
{
    return curve->inside[curve->count - 1];
}

/// Whether two curves lie on each other.
static bool is_same(const pm_kernel_curve *a, const pm_kernel_curve *b)
{
    bool same = a->count == b->count;
    for (int i = 0; same && i < a->count; i++) {
        same = fabs(a->weight[i] - b->weight[i]) <= SAME &&
               fabs(a->distance[i] - b->distance[i]) <= SAME;
    }
    return same;
}

/// A kernel with the lecture's constants is drawn where they make a difference.
static bool is_drawn(const pm_kernel_set *set, const pm_kernel_curve *curve)
{
    if (!pm_kernel_look_is_lecture(curve->name)) {
        return true;
    }
    const pm_kernel_curve *right =
        pm_kernel_file_find(set, pm_kernel_look_of(curve->name).name);
    return right == NULL || !is_same(curve, right);
}

static pm_status add_curve(pm_chart *chart, const pm_kernel_curve *curve, const double *values,
                           const char *label)
{
    pm_chart_look look =
        pm_kernel_look_is_lecture(curve->name) ? PM_CHART_DASHES : PM_CHART_LINE;
    return pm_chart_curve(chart, label, pm_kernel_look_of(curve->name).colour, look,
                          curve->distance, values, curve->count);
}

static pm_status draw_weights(pm_view *view, const pm_kernel_set *set, const pm_rect *where)
{
    pm_chart *chart = NULL;
    const pm_chart_axes axes = {.heading = "how much a photon counts",
                                .x_title = "distance / radius of the disc",
                                .y_title = "weight"};
    PM_TRY(pm_chart_open(view->figure, where, &axes, &chart));
    for (int i = 0; i < set->count; i++) {
        const pm_kernel_curve *curve = &set->curves[i];
        char label[LABEL_MAX];
        const char *lecture =
            pm_kernel_look_is_lecture(curve->name) ? ", the lecture's constant" : "";
        snprintf(label, sizeof label, "%s%s: mean %.3f", pm_kernel_look_of(curve->name).words,
                 lecture, mean_of(curve));
        if (is_drawn(set, curve)) {
            PM_TRY(add_curve(chart, curve, curve->weight, label));
            view->drawn++;
        }
    }
    return pm_chart_close(chart);
}

static pm_status draw_inside(pm_view *view, const pm_kernel_set *set, const pm_rect *where)
{
    pm_chart *chart = NULL;
    const pm_chart_axes axes = {.heading = "how much of the light is counted up to there, on a "
                                           "surface lit evenly",
                                .x_title = "distance / radius of the disc",
                                .y_title = "part of all"};
    PM_TRY(pm_chart_open(view->figure, where, &axes, &chart));
    for (int i = 0; i < set->count; i++) {
        if (is_drawn(set, &set->curves[i])) {
            PM_TRY(add_curve(chart, &set->curves[i], set->curves[i].inside, NULL));
        }
    }
    return pm_chart_close(chart);
}

/// Names the kernels that lose or make light, and says how much.
static void note_losses(pm_view *view, const pm_kernel_set *set)
{
    int wrong = 0;
    for (int i = 0; i < set->count; i++) {
        const pm_kernel_curve *curve = &set->curves[i];
        double off = mean_of(curve) - 1.0;
        if (!is_drawn(set, curve) || fabs(off) <= 1e-4) {
            continue;
        }
        pm_view_note(view, "%s%s%s %s %.1f %% of the light", wrong++ > 0 ? "; " : "",
                     pm_kernel_look_of(curve->name).words,
                     pm_kernel_look_is_lecture(curve->name) ? " with the lecture's constant"
                                                            : "",
                     off < 0.0 ? "loses" : "adds", 100.0 * fabs(off));
    }
    if (wrong == 0) {
        pm_view_note(view, "%s", "all of these do");
    }
}

static void add_facts(pm_view *view, const pm_kernel_set *set)
{
    json_t *means = json_object();
    for (int i = 0; i < set->count; i++) {
        json_object_set_new(means, set->curves[i].name, json_real(mean_of(&set->curves[i])));
    }
    pm_view_fact(view, "means", means);
}

static pm_status draw_charts(pm_view *view, const pm_kernel_set *set)
{
    pm_rect room = pm_figure_wide_room(view->figure);
    int gap = (int)pm_figure_pixels_of(view->figure, 20.0);
    pm_rect upper = room;
    pm_rect lower = room;
    upper.height = (int)(UPPER * room.height) - gap / 2;
    lower.y += upper.height + gap;
    lower.height -= upper.height + gap;
    pm_view_note(view,
                 "to keep all light, a kernel needs mean weight 1 over the disc (where the "
                 "outer rings are the larger ones)\n");
    note_losses(view, set);
    add_facts(view, set);
    PM_TRY(draw_weights(view, set, &upper));
    return draw_inside(view, set, &lower);
}

static pm_status draw(pm_view *view)
{
    pm_kernel_set set;
    PM_TRY(pm_kernel_file_read(view->files[0], &set));
    pm_status status = draw_charts(view, &set);
    pm_kernel_file_free(&set);
    return status;
}

const pm_view_kind pm_view_kernels = {
    .name = "kernels",
    .files = "KERNELS.csv (filtering --curves)",
    .shows = "how much a photon counts by its distance",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_NO_SCENE,
    .options = "",
    .title = "Kernels: near photons count more",
    .draw = draw,
};

// view search: what one query looks at, in order, until it has the k nearest photons.
#include "chart.h"
#include "draw_photons.h"
#include "draw_search.h"
#include "photon_map.h"
#include "view.h"
#include "view_backdrop.h"
#include "view_kinds.h"
#include "visit_table.h"

#include <math.h>
#include <stdlib.h>

#define PANELS_SHARE 0.6 // of the height
#define CLOSE_UP 1.8     // half the side of the close view, in radii of the last ball

typedef struct {
    pm_visit_set searches[PM_TREE_KINDS];
    const pm_photon_cloud *cloud; // NULL: no photon file was given
    pm_rect panel[2], chart;
} page;

static void lay_out(const pm_figure *figure, page *p)
{
    pm_rect room = pm_figure_room(figure);
    int gap = (int)pm_figure_pixels_of(figure, 14.0);
    pm_rect upper = room;
    upper.height = (int)(PANELS_SHARE * room.height);
    pm_figure_columns(figure, &upper, 2, p->panel);
    int top = upper.y + upper.height + gap;
    p->chart = (pm_rect){room.x, top, room.width, room.y + room.height - top};
}

/// Where the search ends: its last ball, or all it looked at while it is not limited.
static double last_radius(const pm_visit_set *search)
{
    double radius = search->visits[search->count - 1].radius;
    if (!isfinite(radius)) {
        radius = 0.0;
        for (uint64_t i = 0; i < search->count; i++) {
            radius = fmax(radius, search->visits[i].distance);
        }
    }
    return radius;
}

/// The axis along which the photons found vary least: across the surface that they lie on.
static int thin_axis(const pm_visit_set *search)
{
    double spread[3] = {0};
    for (uint64_t i = 0; i < search->count; i++) {
        pm_vec3 away = pm_vec_sub(search->visits[i].position, search->at);
        for (int axis = 0; axis < 3 && search->visits[i].found; axis++) {
            spread[axis] += pm_vec_axis(away, axis) * pm_vec_axis(away, axis);
        }
    }
    int thin = spread[0] < spread[1] ? 0 : 1;
    return spread[2] < spread[thin] ? 2 : thin;
}

/// Straight onto the surface around the point asked about, from the camera's side.
static pm_viewpoint close_viewpoint(const pm_view *view, const pm_visit_set *search,
                                    const pm_rect *where)
{
    static const pm_vec3 axes[3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    pm_viewpoint all = pm_viewpoint_fill(&view->scene, where->width, where->height);
    pm_vec3 forward = axes[thin_axis(search)];
    if (pm_vec_dot(forward, pm_vec_sub(search->at, all.position)) < 0.0) {
        forward = pm_vec_negate(forward);
    }
    bool level = fabs(pm_vec_dot(forward, all.up)) < 0.7;
    double half = fmax(CLOSE_UP * last_radius(search), 1e-6 * view->scene.radius);
    pm_vec3 side = pm_vec(half, half, half);
    return pm_viewpoint_box(pm_vec_sub(search->at, side), pm_vec_add(search->at, side), forward,
                            level ? all.up : all.forward, where->width, where->height);
}

static pm_status draw_overview(pm_view *view, const page *p)
{
    const pm_visit_set *search = &p->searches[PM_TREE_BALANCED];
    PM_TRY(pm_view_wordless_panel(view, &p->panel[0], NULL, "the whole scene"));
    if (p->cloud != NULL) {
        PM_TRY(pm_draw_photons(view->figure, p->cloud, 1.5, 0.45));
    }
    return pm_draw_search(view->figure, search, -1, 0.06 * view->scene.radius);
}

static pm_status draw_close(pm_view *view, const page *p)
{
    const pm_visit_set *search = &p->searches[PM_TREE_BALANCED];
    pm_viewpoint close = close_viewpoint(view, search, &p->panel[1]);
    PM_TRY(
        pm_view_wordless_panel(view, &p->panel[1], &close, "around the point, cells cut open"));
    if (p->cloud != NULL) {
        PM_TRY(pm_draw_photons(view->figure, p->cloud, 5.0, 0.4));
    }
    return pm_draw_search(view->figure, search, thin_axis(search), 0.12 * last_radius(search));
}

/// The radius after each visit, from where it is limited on.
static pm_status draw_radius(pm_chart *chart, const pm_visit_set *search, int kind)
{
    static const char *const labels[PM_TREE_KINDS] = {"balanced tree", "not balanced"};
    static const pm_colour_name colours[PM_TREE_KINDS] = {PM_COLOUR_SKY, PM_COLOUR_ORANGE};
    double *order = malloc(search->count * sizeof *order);
    double *radius = malloc(search->count * sizeof *radius);
    pm_status status = PM_OK;
    int count = 0;
    if (order == NULL || radius == NULL) {
        status =
            PM_FAIL(PM_ENOMEM, "no memory for %llu visits", (unsigned long long)search->count);
    } else {
        for (uint64_t i = 0; i < search->count; i++) {
            if (isfinite(search->visits[i].radius)) {
                order[count] = (double)(i + 1);
                radius[count++] = search->visits[i].radius;
            }
        }
    }
    if (count > 0) {
        status = pm_chart_curve(chart, labels[kind], pm_colour_named(colours[kind]),
                                PM_CHART_STEPS, order, radius, count);
    }
    free(order);
    free(radius);
    return status;
}

static pm_status draw_chart(pm_view *view, const page *p)
{
    const pm_chart_axes axes = {.x_title = "photons looked at so far",
                                .y_title = "radius of the ball [m]",
                                .y_log = true};
    pm_chart *chart = NULL;
    PM_TRY(pm_chart_open(view->figure, &p->chart, &axes, &chart));
    for (int kind = 0; kind < PM_TREE_KINDS; kind++) {
        PM_TRY(draw_radius(chart, &p->searches[kind], kind));
    }
    return pm_chart_close(chart);
}

static json_t *facts_of(const pm_visit_set *search)
{
    return json_pack("{s:I,s:I,s:I,s:I}", "visited", (json_int_t)search->count, "found",
                     (json_int_t)search->found, "k", (json_int_t)search->k, "photons",
                     (json_int_t)search->photons);
}

static void write_note(pm_view *view, const page *p)
{
    const pm_visit_set *search = &p->searches[PM_TREE_BALANCED];
    char visited[PM_VIEW_GROUPED_MAX];
    char other[PM_VIEW_GROUPED_MAX];
    char photons[PM_VIEW_GROUPED_MAX];
    char found[PM_VIEW_GROUPED_MAX];
    pm_view_note(
        view,
        "%s of %s photons looked at to find the %s nearest; %s in the tree that is not "
        "balanced\n"
        "first down to the point's own cell, then only where the ball still reaches",
        pm_view_grouped(search->count, visited), pm_view_grouped(search->photons, photons),
        pm_view_grouped(search->found, found),
        pm_view_grouped(p->searches[PM_TREE_UNBALANCED].count, other));
}

static pm_status draw_page(pm_view *view, page *p)
{
    lay_out(view->figure, p);
    write_note(view, p);
    view->drawn = p->searches[PM_TREE_BALANCED].count;
    pm_view_fact(view, "balanced", facts_of(&p->searches[PM_TREE_BALANCED]));
    pm_view_fact(view, "unbalanced", facts_of(&p->searches[PM_TREE_UNBALANCED]));
    PM_TRY(draw_overview(view, p));
    PM_TRY(draw_close(view, p));
    const pm_visit_set *search = &p->searches[PM_TREE_BALANCED];
    PM_TRY(pm_draw_search_legend(view->figure, search, p->cloud != NULL));
    PM_TRY(pm_draw_search_keep(view->figure, search));
    return draw_chart(view, p);
}

/// The photons must lie in the file where the search met them.
static pm_status check_map(const pm_view *view, const pm_visit_set *search,
                           const pm_photon_map *map)
{
    double slack = 1e-6 * (view->scene.radius + pm_vec_reach(view->scene.center));
    for (uint64_t i = 0; i < search->count; i++) {
        const pm_visited *visit = &search->visits[i];
        const float *at = map->photons[visit->photon].position;
        pm_vec3 there = pm_vec((double)at[0], (double)at[1], (double)at[2]);
        if (!(pm_vec_length(pm_vec_sub(there, visit->position)) <= slack)) {
            return pm_status_fail(PM_EINPUT,
                                  "%s: photon %llu lies elsewhere in %s; write both in one "
                                  "run of balancing",
                                  view->files[0], (unsigned long long)visit->photon,
                                  view->files[1]);
        }
    }
    return PM_OK;
}

static pm_status draw_tables(pm_view *view, page *p)
{
    PM_TRY(pm_visit_table_read(view->files[0], &view->scene, p->searches));
    if (view->file_count > 1) {
        const pm_visit_set *search = &p->searches[PM_TREE_BALANCED];
        pm_photon_map map = {0};
        PM_TRY(pm_view_backdrop_read(view, view->files[1], view->files[0], search->photons,
                                     &map, &p->cloud));
        pm_status status = check_map(view, search, &map);
        pm_photon_map_free(&map);
        PM_TRY(status);
    }
    return draw_page(view, p);
}

static pm_status draw(pm_view *view)
{
    page p = {0};
    pm_status status = draw_tables(view, &p);
    for (int kind = 0; kind < PM_TREE_KINDS; kind++) {
        pm_visit_table_free(&p.searches[kind]);
    }
    return status;
}

const pm_view_kind pm_view_search = {
    .name = "search",
    .files = "VISITS.csv [MAP.ply] (balancing --at --visits, -o)",
    .shows = "what a search looks at, in order",
    .files_least = 1,
    .files_most = 2,
    .scene = PM_VIEW_FOR_SCENE,
    .options = "",
    .title = "Search: how few photons are looked at",
    .draw = draw,
};

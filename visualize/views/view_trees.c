// view trees: the same photons in two trees, one balanced and one that grew as they came.
#include "chart.h"
#include "draw_photons.h"
#include "draw_tree.h"
#include "photon_map.h"
#include "tree_table.h"
#include "view.h"
#include "view_backdrop.h"
#include "view_kinds.h"

#include <stdio.h>
#include <stdlib.h>

#define PANELS_SHARE 0.56 // of the height

static const char *const headings[PM_TREE_KINDS] = {"balanced", "not balanced"};
static const char *const kept_names[PM_TREE_KINDS] = {"split plane, balanced",
                                                      "split plane, not balanced"};
static const pm_colour_name curve_colours[PM_TREE_KINDS] = {PM_COLOUR_SKY, PM_COLOUR_ORANGE};

typedef struct {
    pm_tree_table trees[PM_TREE_KINDS];
    const pm_photon_cloud *cloud; // NULL: no photon file was given
    pm_rect panel[PM_TREE_KINDS], chart;
} page;

static void lay_out(const pm_figure *figure, page *p)
{
    pm_rect room = pm_figure_room(figure);
    int line = (int)pm_figure_pixels_of(figure, 40.0);
    pm_rect upper = room;
    upper.height = (int)(PANELS_SHARE * room.height);
    pm_figure_columns(figure, &upper, PM_TREE_KINDS, p->panel);
    int top = upper.y + upper.height + line;
    p->chart = (pm_rect){room.x, top, room.width, room.y + room.height - top};
}

/// One tree in its panel, under its numbers.
static pm_status draw_one(pm_view *view, const page *p, int kind)
{
    char heading[128];
    uint64_t drawn = 0;
    const pm_rect *where = &p->panel[kind];
    const pm_tree_table *tree = &p->trees[kind];
    snprintf(heading, sizeof heading, "%s: height %llu, %.1f looked at", headings[kind],
             (unsigned long long)tree->height, tree->visited_mean);
    PM_TRY(pm_view_wordless_panel(view, where, NULL, heading));
    if (p->cloud != NULL) {
        PM_TRY(pm_draw_photons(view->figure, p->cloud, 1.5, 0.6));
    }
    PM_TRY(pm_draw_tree(view->figure, &tree->splits, (int)view->options->depth,
                        kept_names[kind], view->scene.center, &drawn));
    view->drawn += drawn;
    return PM_OK;
}

static pm_status draw_levels(pm_chart *chart, const pm_tree_table *tree, int kind)
{
    size_t count = tree->height + 1;
    double *depth = malloc(count * sizeof *depth);
    double *photons = malloc(count * sizeof *photons);
    pm_status status = PM_OK;
    if (depth == NULL || photons == NULL) {
        status = PM_FAIL(PM_ENOMEM, "no memory for %zu levels", count);
    } else {
        for (size_t i = 0; i < count; i++) {
            depth[i] = (double)i;
            photons[i] = (double)tree->level[i];
        }
        const char *label = kind == PM_TREE_BALANCED ? "balanced" : "not balanced";
        pm_colour colour = pm_colour_named(curve_colours[kind]);
        status =
            pm_chart_curve(chart, label, colour, PM_CHART_LINE, depth, photons, (int)count);
    }
    free(depth);
    free(photons);
    return status;
}

static pm_status draw_chart(pm_view *view, const page *p)
{
    const pm_chart_axes axes = {
        .x_title = "depth (0: the root)", .y_title = "photons there", .y_log = true};
    pm_chart *chart = NULL;
    PM_TRY(pm_chart_open(view->figure, &p->chart, &axes, &chart));
    for (int kind = 0; kind < PM_TREE_KINDS; kind++) {
        PM_TRY(draw_levels(chart, &p->trees[kind], kind));
    }
    return pm_chart_close(chart);
}

static json_t *facts_of(const pm_tree_table *tree)
{
    return json_pack("{s:I,s:I,s:f}", "photons", (json_int_t)tree->photons, "height",
                     (json_int_t)tree->height, "visited_mean", tree->visited_mean);
}

static pm_status draw_page(pm_view *view, page *p)
{
    const pm_tree_table *trees = p->trees;
    char photons[PM_VIEW_GROUPED_MAX];
    lay_out(view->figure, p);
    pm_view_note(
        view,
        "%s photons, twice: divided at medians, and inserted one by one in the order "
        "they were stored\n"
        "height: links from the root to the deepest photon; looked at: photons, in a mean "
        "search",
        pm_view_grouped(trees[0].photons, photons));
    pm_view_fact(view, "balanced", facts_of(&trees[PM_TREE_BALANCED]));
    pm_view_fact(view, "unbalanced", facts_of(&trees[PM_TREE_UNBALANCED]));
    for (int kind = 0; kind < PM_TREE_KINDS; kind++) {
        PM_TRY(draw_one(view, p, kind));
    }
    PM_TRY(pm_draw_tree_legend(view->figure, (int)view->options->depth));
    return draw_chart(view, p);
}

static pm_status draw_tables(pm_view *view, page *p)
{
    PM_TRY(pm_tree_table_read(view->files[0], &view->scene, p->trees));
    if (view->file_count > 1) {
        pm_photon_map map = {0};
        PM_TRY(pm_view_backdrop_read(view, view->files[1], view->files[0], p->trees[0].photons,
                                     &map, &p->cloud));
        pm_photon_map_free(&map);
    }
    return draw_page(view, p);
}

static pm_status draw(pm_view *view)
{
    page p = {0};
    pm_status status = draw_tables(view, &p);
    for (int kind = 0; kind < PM_TREE_KINDS; kind++) {
        pm_tree_table_free(&p.trees[kind]);
    }
    return status;
}

const pm_view_kind pm_view_trees = {
    .name = "trees",
    .files = "TREES.csv [MAP.ply] (balancing --dump, -o)",
    .shows = "the same photons balanced and not",
    .files_least = 1,
    .files_most = 2,
    .scene = PM_VIEW_FOR_SCENE,
    .options = "depth",
    .title = "Balanced or not: what the median is good for",
    .draw = draw,
};

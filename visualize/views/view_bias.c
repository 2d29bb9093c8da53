// view bias: what estimates make of edges and corners. Grids of one surface side by side, face
// on, as estimate over truth; under each its middle rows from the edge inwards.
#include "chart.h"
#include "draw_bias.h"
#include "grid_bias.h"
#include "grid_file.h"
#include "view.h"
#include "view_kinds.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILES_MOST 3
#define NAME_MAX_BYTES 40

static const double tallest = 0.46; // of a column, for a map
static const double reach_step = 0.25;
static const double reach_most = 1.0; // ratios end at 0
static const double farthest = 2.5;   // radii from the edge that a chart shows
static const double line_900 = 26.0;  // pixels from a line of text to the next
static const double size_900 = 17.0;

/// The grids of one picture.
typedef struct {
    pm_grid grid[FILES_MOST];
    pm_grid_bias bias[FILES_MOST];
    char name[FILES_MOST][NAME_MAX_BYTES];
    int count;
    double truth; // luminance [W/m^2]
    double reach; // of the scale, on both sides of 1
    double most;  // ratio of a point
} grids;

static void release(void *data)
{
    grids *all = data;
    for (int i = 0; i < all->count; i++) {
        pm_grid_file_free(&all->grid[i]);
        pm_grid_bias_free(&all->bias[i]);
    }
    free(all);
}

/// "results/small-k.csv" as "small k".
static void name_after(const char *path, char name[NAME_MAX_BYTES])
{
    const char *slash = strrchr(path, '/');
    snprintf(name, NAME_MAX_BYTES, "%s", slash != NULL ? slash + 1 : path);
    size_t length = strlen(name);
    if (length > 4 && strcmp(name + length - 4, ".csv") == 0) {
        name[length - 4] = '\0';
    }
    for (char *c = name; *c != '\0'; c++) {
        *c = *c == '-' || *c == '_' ? ' ' : *c;
    }
}

static pm_status find_truth(const pm_view *view, grids *all)
{
    const pm_grid *each[FILES_MOST];
    for (int i = 0; i < all->count; i++) {
        each[i] = &all->grid[i];
    }
    all->truth = view->options->truth;
    if (all->truth > 0.0) {
        return PM_OK;
    }
    PM_TRY(pm_grid_bias_truth(each, all->count, &all->truth));
    if (!(all->truth > 0.0)) {
        return pm_status_fail(
            PM_EINPUT,
            "%s: the middle of the grid is dark, so its median is no truth to "
            "compare with; give --true E [W/m^2]",
            view->files[0]);
    }
    return PM_OK;
}

/// A scale as far to both sides of 1 as the data needs, in steps.
static void choose_reach(grids *all)
{
    double off = 0.0;
    for (int g = 0; g < all->count; g++) {
        for (uint64_t n = 0; n < all->grid[g].columns * all->grid[g].rows; n++) {
            double ratio =
                pm_spectrum_luminance(all->grid[g].points[n].irradiance) / all->truth;
            all->most = fmax(all->most, ratio);
            off = fmax(off, fabs(ratio - 1.0));
        }
    }
    double steps = fmax(ceil(off / reach_step - 1e-9), 1.0);
    all->reach = fmin(steps * reach_step, reach_most);
}

static pm_status read_grids(pm_view *view, grids *all)
{
    for (int i = 0; i < view->file_count; i++) {
        PM_TRY(pm_grid_file_read(view->files[i], &view->scene, &all->grid[i]));
        name_after(view->files[i], all->name[i]);
        view->drawn += all->grid[i].columns * all->grid[i].rows;
        all->count++;
    }
    PM_TRY(find_truth(view, all));
    choose_reach(all);
    for (int i = 0; i < all->count; i++) {
        PM_TRY(pm_grid_bias_make(&all->grid[i], all->truth, &all->bias[i]));
    }
    return PM_OK;
}

// --- a map ----------------------------------------------------------------------------------

/// Of the grid's four directions the one that looks most like up to the scene's camera.
static pm_vec3 choose_up(const pm_scene *scene, const pm_grid *grid)
{
    pm_vec3 top = scene->has_camera ? scene->camera.up : pm_vec(0.0, 1.0, 0.0);
    pm_vec3 away = scene->has_camera ? scene->camera.forward : pm_vec(0.0, 0.0, -1.0);
    pm_vec3 like = pm_vec_along(away, top, 2.0);
    pm_vec3 first = grid->points[0].position;
    pm_vec3 i = pm_vec_normalize(pm_vec_sub(grid->points[1].position, first));
    pm_vec3 j = pm_vec_normalize(pm_vec_sub(grid->points[grid->columns].position, first));
    pm_vec3 up = fabs(pm_vec_dot(i, like)) > fabs(pm_vec_dot(j, like)) ? i : j;
    return pm_vec_dot(up, like) < 0.0 ? pm_vec_negate(up) : up;
}

static pm_status draw_map(pm_view *view, const grids *all, int g, const pm_rect *where)
{
    const pm_grid *grid = &all->grid[g];
    const pm_grid_point *p = grid->points;
    pm_vec3 half =
        pm_vec_scale(pm_vec_add(pm_vec_sub(p[1].position, p[0].position),
                                pm_vec_sub(p[grid->columns].position, p[0].position)),
                     0.5);
    pm_vec3 one = pm_vec_sub(p[0].position, half);
    pm_vec3 other = pm_vec_add(p[grid->columns * grid->rows - 1].position, half);
    pm_viewpoint viewpoint = pm_viewpoint_box(
        pm_vec_min(one, other), pm_vec_max(one, other), pm_vec_negate(p[0].normal),
        choose_up(&view->scene, grid), where->width, where->height);
    PM_TRY(pm_figure_panel(view->figure, where, &viewpoint));
    return pm_draw_bias(view->figure, grid, all->truth, all->reach, all->name[g]);
}

// --- a chart --------------------------------------------------------------------------------

static pm_colour disc_colour(void)
{
    return pm_colour_named(PM_COLOUR_SKY);
}

static pm_colour sphere_colour(void)
{
    return pm_colour_named(PM_COLOUR_ORANGE);
}

/// What a thin disc would find, and what a sphere would beside a wall that is as bright.
static pm_status draw_expected(pm_chart *chart)
{
    double x[101];
    double disc[101];
    double sphere[101];
    for (int i = 0; i <= 100; i++) {
        x[i] = farthest * i / 100.0;
        disc[i] = pm_grid_bias_disc(x[i]);
        sphere[i] = pm_grid_bias_sphere(x[i]);
    }
    PM_TRY(pm_chart_curve(chart, NULL, disc_colour(), PM_CHART_DASHES, x, disc, 101));
    return pm_chart_curve(chart, NULL, sphere_colour(), PM_CHART_DASHES, x, sphere, 101);
}

static pm_status draw_profile(pm_view *view, const grids *all, int g, const pm_rect *where)
{
    const pm_grid_bias *bias = &all->bias[g];
    pm_chart *chart = NULL;
    pm_chart_axes axes = {.x_title = "distance from the edge / r",
                          .x_high = farthest,
                          .y_high = 1.0 + all->reach};
    double *shown = malloc((size_t)(2 * bias->count + 1) * sizeof *shown);
    if (shown == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for a profile");
    }
    double *ratio = shown + bias->count;
    int count = 0;
    for (int i = 0; i < bias->count; i++) {
        if (bias->distance[i] <= farthest && bias->ratio[i] <= axes.y_high) {
            shown[count] = bias->distance[i];
            ratio[count++] = bias->ratio[i];
        }
    }
    pm_status status = pm_chart_open(view->figure, where, &axes, &chart);
    status = status == PM_OK ? draw_expected(chart) : status;
    status = status == PM_OK ? pm_chart_curve(chart, NULL, pm_colour_named(PM_COLOUR_YELLOW),
                                              PM_CHART_DOTS, shown, ratio, count)
                             : status;
    free(shown);
    return status == PM_OK ? pm_chart_close(chart) : status;
}

// --- the page -------------------------------------------------------------------------------

static json_t *facts_of(const grids *all)
{
    json_t *facts = json_array();
    for (int g = 0; g < all->count; g++) {
        const pm_grid_bias *b = &all->bias[g];
        json_array_append_new(facts, json_pack("{s:s,s:f,s:f,s:f,s:f,s:f,s:i,s:i}", "name",
                                               all->name[g], "middle", b->middle, "edge",
                                               b->edge, "corner", b->corner, "radius",
                                               b->radius, "found", b->found, "columns",
                                               b->count, "unreachable", b->unreachable));
    }
    return facts;
}

static pm_status draw_column(pm_view *view, const grids *all, int g, const pm_rect *cell)
{
    char text[96];
    const pm_grid_bias *bias = &all->bias[g];
    double line = pm_figure_pixels_of(view->figure, line_900);
    double size = pm_figure_pixels_of(view->figure, size_900);
    int side = cell->width < (int)(tallest * cell->height) ? cell->width
                                                           : (int)(tallest * cell->height);
    pm_rect map = {cell->x, cell->y, side, side};
    int under = map.y + map.height + (int)(2.6 * line);
    pm_rect chart = {cell->x, under, cell->width, cell->y + cell->height - under};
    PM_TRY(pm_figure_caption(view->figure, &map, all->name[g]));
    PM_TRY(draw_map(view, all, g, &map));
    snprintf(text, sizeof text, "edge %.2f, corner %.2f", bias->edge, bias->corner);
    PM_TRY(pm_figure_text(view->figure, text, map.x, map.y + map.height + 0.2 * line, size,
                          PM_TEXT_PLAIN));
    snprintf(text, sizeof text, "mean r %.3g m, %.0f photons", bias->radius, bias->found);
    PM_TRY(pm_figure_text(view->figure, text, map.x, map.y + map.height + 1.2 * line, size,
                          PM_TEXT_DIM));
    return draw_profile(view, all, g, &chart);
}

static pm_status draw_page(pm_view *view, const grids *all)
{
    const pm_legend_entry curves[] = {
        {PM_SWATCH_DOT, pm_colour_named(PM_COLOUR_YELLOW), "middle rows, both ends"},
        {PM_SWATCH_LINE, disc_colour(), "expected: thin disc"},
        {PM_SWATCH_LINE, sphere_colour(), "expected: sphere where"},
        {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_WHITE),
         "          a wall as bright meets it"}};
    pm_rect room = pm_figure_room(view->figure);
    pm_rect cells[FILES_MOST];
    pm_figure_columns(view->figure, &room, all->count, cells);
    PM_TRY(pm_draw_bias_scale(view->figure, all->reach, all->most > 1.0 + all->reach));
    PM_TRY(pm_figure_legend(view->figure, "charts: estimate / truth", curves, 4));
    for (int g = 0; g < all->count; g++) {
        PM_TRY(draw_column(view, all, g, &cells[g]));
    }
    return PM_OK;
}

static pm_status draw(pm_view *view)
{
    grids *all = calloc(1, sizeof *all);
    if (all == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for grids");
    }
    PM_TRY(pm_view_keep(view, all, release));
    PM_TRY(read_grids(view, all));
    pm_view_note(
        view, "irradiance on one surface, estimated and divided by %s %.4g W/m\xC2\xB2",
        view->options->truth > 0.0 ? "what it should be:" : "the median of the middle:",
        all->truth);
    pm_view_note(view,
                 "\nnear an edge a disc lies partly outside and finds too little; a sphere "
                 "takes the wall's photons, too");
    pm_view_fact(view, "truth", json_real(all->truth));
    pm_view_fact(view, "grids", facts_of(all));
    return draw_page(view, all);
}

const pm_view_kind pm_view_bias = {
    .name = "bias",
    .files = "GRID.csv ... (radiance --grid --dump)",
    .shows = "estimates over the truth at edges and in corners",
    .files_least = 1,
    .files_most = FILES_MOST,
    .scene = PM_VIEW_FOR_SCENE,
    .options = "true",
    .title = "Bias at edges and in corners",
    .draw = draw,
};

// view edge: what each kernel makes of the edge of a caustic, as heat maps and as a cut across.
#include "chart.h"
#include "draw_edge.h"
#include "edge_file.h"
#include "kernel_look.h"
#include "view.h"
#include "view_kinds.h"

#include <math.h>
#include <stdlib.h>

#define KERNELS 5 // that are shown: not those with the lecture's constants
#define COLUMNS 3
#define ROWS 2
#define MAPS_MOST 0.48 // of the room's height
#define GAP_900 16.0
#define CAPTION_900 36.0   // of pm_figure_columns()
#define OVERVIEW_900 230.0 // height of the panel that shows where it is
#define EDGE_900 24.0
#define SPAN 1e4       // of the scale, at most
#define LEAST_SPAN 1.1 // of it, at least

static const int shown[KERNELS] = {0, 1, 2, 3, 8};

typedef struct {
    pm_edge_grid grid, finer; // `finer` without points when there is no second file
    pm_edge_range range;
    uint64_t row;         // that is cut along
    double *x, *y, *zero; // of the chart, `grid.columns` each
} job;

// --- maps -----------------------------------------------------------------------------------

/// The ends of one kernel's values above 0, so far.
static void measure(const pm_edge_grid *grid, int kernel, pm_edge_range *range)
{
    for (uint64_t n = 0; n < grid->columns * grid->rows; n++) {
        double value = grid->points[n].irradiance[kernel];
        range->low = value > 0.0 ? fmin(range->low, value) : range->low;
        range->high = fmax(range->high, value);
        range->has_zero = range->has_zero || !(value > 0.0);
    }
}

static void measure_all(const job *j, int kernels, pm_edge_range *range)
{
    *range = (pm_edge_range){.low = HUGE_VAL};
    for (int n = 0; n < kernels; n++) {
        measure(&j->grid, shown[n], range);
    }
    if (j->finer.points != NULL) {
        measure(&j->finer, 0, range);
    }
}

/// One scale for all maps, from all but that of differential checking, whose few photons give a
/// few far outliers.
static pm_edge_range choose_range(const job *j)
{
    pm_edge_range range;
    pm_edge_range all;
    measure_all(j, KERNELS - 1, &range);
    measure_all(j, KERNELS, &all);
    if (range.high == 0.0) {
        return (pm_edge_range){0.1, 1.0, true, false, all.high > 1.0};
    }
    range.low = fmax(range.low, range.high / SPAN);
    if (range.high / range.low < LEAST_SPAN) {
        range.high *= sqrt(LEAST_SPAN);
        range.low /= sqrt(LEAST_SPAN);
    }
    range.has_zero = all.has_zero;
    range.below = all.low < range.low;
    range.above = all.high > range.high;
    return range;
}

static pm_vec3 corner(const pm_edge_grid *grid, bool right, bool top)
{
    uint64_t i = right ? grid->columns - 1 : 0;
    uint64_t j = top ? grid->rows - 1 : 0;
    return grid->points[j * grid->columns + i].position;
}

/// Face on, the rows running to the right.
static pm_viewpoint face(const pm_edge_grid *grid, const pm_rect *where)
{
    pm_vec3 low = corner(grid, false, false);
    pm_vec3 high = low;
    for (int c = 1; c < 4; c++) {
        pm_vec3 at = corner(grid, c & 1, c & 2);
        low = pm_vec(fmin(low.x, at.x), fmin(low.y, at.y), fmin(low.z, at.z));
        high = pm_vec(fmax(high.x, at.x), fmax(high.y, at.y), fmax(high.z, at.z));
    }
    pm_vec3 right = pm_vec_sub(corner(grid, true, false), corner(grid, false, false));
    pm_vec3 up = pm_vec_sub(corner(grid, false, true), corner(grid, false, false));
    pm_vec3 normal = pm_vec_normalize(pm_vec_cross(right, up));
    return pm_viewpoint_box(low, high, pm_vec_negate(normal), up, where->width, where->height);
}

static pm_status draw_map(pm_view *view, const job *j, const pm_edge_grid *grid, int kernel,
                          const char *heading, const pm_rect *where)
{
    pm_viewpoint viewpoint = face(grid, where);
    PM_TRY(pm_figure_panel(view->figure, where, &viewpoint));
    PM_TRY(pm_figure_caption(view->figure, where, heading));
    return pm_draw_edge(view->figure, grid, kernel, &j->range, j->row);
}

/// As tall as the grid needs, but within `most`.
static int map_height(const pm_edge_grid *grid, int width, int most)
{
    pm_vec3 along = pm_vec_sub(corner(grid, true, false), corner(grid, false, false));
    pm_vec3 up = pm_vec_sub(corner(grid, false, true), corner(grid, false, false));
    double tall = width * pm_vec_length(up) / pm_vec_length(along);
    return tall < most ? (int)tall : most;
}

/// Draws the maps in the upper part of `room`, and leaves in it what remains.
static pm_status draw_maps(pm_view *view, const job *j, pm_rect *room)
{
    int gap = (int)pm_figure_pixels_of(view->figure, GAP_900);
    int line = (int)pm_figure_pixels_of(view->figure, CAPTION_900);
    int most = (int)(MAPS_MOST * room->height / ROWS) - line - gap;
    bool finer = j->finer.points != NULL;
    for (int n = 0; n < KERNELS + (finer ? 1 : 0); n++) {
        pm_rect cells[COLUMNS];
        pm_figure_columns(view->figure, room, COLUMNS, cells);
        pm_rect where = cells[n % COLUMNS];
        where.height = map_height(&j->grid, where.width, most);
        bool last = n == KERNELS;
        const char *words = last ? "nearly true" // from the second file
                                 : pm_kernel_look_of(pm_edge_file_kernel(shown[n])).words;
        PM_TRY(
            draw_map(view, j, last ? &j->finer : &j->grid, last ? 0 : shown[n], words, &where));
        if (n == 0) {
            PM_TRY(pm_draw_edge_keep(view->figure, &j->grid));
        }
        if (n % COLUMNS == COLUMNS - 1 || n == KERNELS - (finer ? 0 : 1)) {
            int used = where.y + where.height + gap - room->y;
            room->y += used;
            room->height -= used;
        }
    }
    return PM_OK;
}

// --- the cut --------------------------------------------------------------------------------

static void take_row(const job *j, const pm_edge_grid *grid, int kernel)
{
    for (uint64_t i = 0; i < grid->columns; i++) {
        j->y[i] = grid->points[j->row * grid->columns + i].irradiance[kernel];
    }
}

static pm_status add_curves(pm_chart *chart, const job *j)
{
    int count = (int)j->grid.columns;
    if (j->finer.points != NULL) {
        take_row(j, &j->finer, 0);
        PM_TRY(pm_chart_band(chart, "nearly true", pm_colour_named(PM_COLOUR_GREY), j->x,
                             j->zero, j->y, count));
    }
    for (int n = 0; n < KERNELS; n++) {
        pm_kernel_look look = pm_kernel_look_of(pm_edge_file_kernel(shown[n]));
        take_row(j, &j->grid, shown[n]);
        PM_TRY(
            pm_chart_curve(chart, look.words, look.colour, PM_CHART_LINE, j->x, j->y, count));
    }
    return PM_OK;
}

static pm_status draw_cut(pm_view *view, const job *j, const pm_rect *where)
{
    pm_chart *chart = NULL;
    const pm_chart_axes axes = {.heading = "along the blue line",
                                .x_title = "from the left [m]",
                                .y_title = "irradiance [W/m\xC2\xB2]",
                                .x_high = j->x[j->grid.columns - 1]};
    PM_TRY(pm_chart_open(view->figure, where, &axes, &chart));
    PM_TRY(add_curves(chart, j));
    return pm_chart_close(chart);
}

static pm_status measure_row(job *j)
{
    size_t count = (size_t)j->grid.columns;
    j->row = j->grid.rows / 2;
    j->x = calloc(3 * count, sizeof *j->x);
    if (j->x == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %zu points", count);
    }
    j->y = j->x + count;
    j->zero = j->y + count;
    const pm_edge_point *row = j->grid.points + j->row * j->grid.columns;
    for (size_t i = 0; i < count; i++) {
        j->x[i] = pm_vec_length(pm_vec_sub(row[i].position, row[0].position));
    }
    return PM_OK;
}

// --- the picture ----------------------------------------------------------------------------

static pm_status draw_overview(pm_view *view, const job *j)
{
    int width;
    int height;
    pm_figure_size(view->figure, &width, &height);
    int edge = (int)pm_figure_pixels_of(view->figure, EDGE_900);
    int high = (int)pm_figure_pixels_of(view->figure, OVERVIEW_900);
    int left = (int)((1.0 - PM_VIEWPOINT_RIGHT) * width) + edge;
    pm_rect where = {left, height - edge - high, width - edge - left, high};
    PM_TRY(pm_view_wordless_panel(view, &where, NULL, "where it is"));
    return pm_draw_edge_place(view->figure, &j->grid);
}

static void write_note(pm_view *view, const job *j)
{
    double across = pm_vec_length(
        pm_vec_sub(corner(&j->grid, true, false), corner(&j->grid, false, false)));
    pm_view_note(
        view,
        "a disc that reaches over an edge smears it, less so where near photons count more; "
        "the photons are the same\n%llu x %llu points on %.3g m%s",
        (unsigned long long)j->grid.columns, (unsigned long long)j->grid.rows, across,
        j->finer.points != NULL ? "; nearly true: the second file, made without a kernel" : "");
}

static pm_status draw_all(pm_view *view, job *j)
{
    PM_TRY(pm_edge_file_read(view->files[0], &view->scene, &j->grid));
    if (view->file_count > 1) {
        PM_TRY(pm_edge_file_read_same(view->files[1], &view->scene, &j->grid, &j->finer));
    }
    PM_TRY(measure_row(j));
    j->range = choose_range(j);
    view->drawn = j->grid.columns * j->grid.rows;
    write_note(view, j);
    pm_rect room = pm_figure_room(view->figure);
    PM_TRY(draw_maps(view, j, &room));
    PM_TRY(draw_cut(view, j, &room));
    PM_TRY(pm_draw_edge_scale(view->figure, &j->range));
    return draw_overview(view, j);
}

static pm_status draw(pm_view *view)
{
    job j = {0};
    pm_status status = draw_all(view, &j);
    pm_edge_file_free(&j.grid);
    pm_edge_file_free(&j.finer);
    free(j.x);
    return status;
}

const pm_view_kind pm_view_edge = {
    .name = "edge",
    .files = "EDGE.csv [FINER.csv] (filtering --on --grid --dump)",
    .shows = "what each kernel makes of a caustic's edge",
    .files_least = 1,
    .files_most = 2,
    .scene = PM_VIEW_FOR_SCENE,
    .options = "",
    .title = "A caustic's edge under each kernel",
    .draw = draw,
};

// view packing: what a photon's two bytes of direction and four of power round away.
#include "chart.h"
#include "draw_packing.h"
#include "packing.h"
#include "packing_sphere.h"
#include "view.h"
#include "view_kinds.h"

#include <stdio.h>
#include <stdlib.h>

#define PATCHES 2
#define CHARTS 2
#define FILES_MOST 3

/// All that stands on the page; drawn without a copy.
typedef struct {
    pm_packing packing;
    pm_sphere_choice whole;
    pm_sphere_patch patch[PATCHES]; // at the equator, at a pole
} page;

static void release_page(void *data)
{
    page *p = data;
    pm_packing_free(&p->packing);
    free(p);
}

static pm_status read_page(const pm_view *view, page *p)
{
    pm_packing *packing = &p->packing;
    for (int i = 0; i < view->file_count; i++) {
        PM_TRY(pm_packing_read(packing, view->files[i]));
    }
    pm_sphere_choose(packing->exact, packing->packed, packing->count, &p->whole);
    pm_sphere_equator(packing->exact, packing->packed, packing->count, &p->patch[0]);
    pm_sphere_pole(packing->exact, packing->packed, packing->count, &p->patch[1]);
    return PM_OK;
}

// --- the sphere -----------------------------------------------------------------------------

static pm_status draw_spheres(pm_view *view, const page *p, const pm_rect *row)
{
    bool north = p->patch[1].theta < 1.0;
    const char *const captions[] = {"all directions", "4 degrees at the equator",
                                    north ? "4 degrees around the pole +z"
                                          : "4 degrees around the pole -z"};
    pm_rect cell[1 + PATCHES];
    pm_figure_columns(view->figure, row, 1 + PATCHES, cell);
    PM_TRY(pm_draw_sphere(view->figure, &cell[0], &p->whole, p->patch, PATCHES));
    for (int i = 0; i < PATCHES; i++) {
        PM_TRY(pm_draw_patch(view->figure, &cell[1 + i], &p->patch[i]));
    }
    for (int i = 0; i < 1 + PATCHES; i++) {
        PM_TRY(pm_figure_caption(view->figure, &cell[i], captions[i]));
    }
    return PM_OK;
}

// --- the charts -----------------------------------------------------------------------------

/// Shares in percent over `unit` times the histogram's values.
static pm_status draw_bars(pm_chart *chart, const pm_packing_histogram *h, double unit,
                           pm_colour colour)
{
    double x[PM_PACKING_BINS];
    double height[PM_PACKING_BINS];
    double width = unit * (h->high - h->low) / PM_PACKING_BINS;
    for (int i = 0; i < PM_PACKING_BINS; i++) {
        x[i] = unit * h->low + width * (i + 0.5);
        height[i] = 100.0 * h->share[i];
    }
    return pm_chart_bars(chart, NULL, colour, x, height, PM_PACKING_BINS, width);
}

static double highest(const pm_packing_histogram *h)
{
    double most = 0.0;
    for (int i = 0; i < PM_PACKING_BINS; i++) {
        most = h->share[i] > most ? h->share[i] : most;
    }
    return 100.0 * most;
}

/// An upright line with words at its top.
static pm_status draw_mark(pm_chart *chart, double x, double top, const char *text)
{
    const double at[2] = {x, x};
    const double height[2] = {0.0, top};
    PM_TRY(pm_chart_curve(chart, NULL, pm_colour_named(PM_COLOUR_WHITE), PM_CHART_DASHES, at,
                          height, 2));
    return pm_chart_word(chart, x, top, text);
}

static pm_status draw_angles(pm_view *view, const pm_packing *packing, const pm_rect *where)
{
    pm_packing_histogram h = pm_packing_angles(packing);
    double top = 1.25 * highest(&h);
    double mean = pm_packing_loss_mean_degrees(&packing->loss);
    char text[64];
    pm_chart *chart = NULL;
    const pm_chart_axes axes = {.heading = "direction: angle from exact to packed",
                                .x_title = "angle [degrees]",
                                .y_title = "photons [%]",
                                .x_low = h.low,
                                .x_high = h.high,
                                .y_high = top};
    PM_TRY(pm_chart_open(view->figure, where, &axes, &chart));
    PM_TRY(draw_bars(chart, &h, 1.0, pm_colour_named(PM_COLOUR_SKY)));
    snprintf(text, sizeof text, "mean %.3f", mean);
    PM_TRY(draw_mark(chart, mean, 0.92 * top, text));
    return pm_chart_close(chart);
}

static pm_status draw_powers(pm_view *view, const pm_packing *packing, const pm_rect *where)
{
    pm_packing_histogram h = pm_packing_powers(packing);
    pm_chart *chart = NULL;
    const pm_chart_axes axes = {.heading = "power: error of each channel",
                                .x_title = "of the photon's strongest channel [%]",
                                .y_title = "channels [%]",
                                .x_low = 100.0 * h.low,
                                .x_high = 100.0 * h.high,
                                .y_high = 1.25 * highest(&h)};
    PM_TRY(pm_chart_open(view->figure, where, &axes, &chart));
    PM_TRY(draw_bars(chart, &h, 100.0, pm_colour_named(PM_COLOUR_GREEN)));
    return pm_chart_close(chart);
}

static pm_status draw_charts(pm_view *view, const page *p, const pm_rect *row)
{
    int gap = (int)pm_figure_pixels_of(view->figure, 24.0);
    int width = (row->width - gap) / CHARTS;
    const pm_rect left = {row->x, row->y, width, row->height};
    const pm_rect right = {row->x + width + gap, row->y, width, row->height};
    PM_TRY(draw_angles(view, &p->packing, &left));
    return draw_powers(view, &p->packing, &right);
}

// --- the page -------------------------------------------------------------------------------

static void write_note(pm_view *view, const pm_packing_loss *loss)
{
    char count[PM_VIEW_GROUPED_MAX];
    pm_view_note(
        view,
        "two bytes name one of 256 x 256 cells, and the direction becomes the middle of "
        "its cell: cells crowd at the poles\n"
        "%s photons: direction off by %.3f degrees in the mean, %.3f at most; power by "
        "%.3g %% rms",
        pm_view_grouped(loss->count, count), pm_packing_loss_mean_degrees(loss),
        pm_packing_loss_max_degrees(loss), 100.0 * pm_packing_loss_rms(loss));
}

static pm_status draw_page(pm_view *view, page *p)
{
    pm_packing *packing = &p->packing;
    pm_rect top = pm_figure_wide_room(view->figure);
    pm_rect bottom = pm_figure_room(view->figure);
    int gap = (int)pm_figure_pixels_of(view->figure, 16.0);
    top.height = top.height * 53 / 100;
    bottom.height -= top.height + gap;
    bottom.y += top.height + gap;
    PM_TRY(draw_spheres(view, p, &top));
    PM_TRY(draw_charts(view, p, &bottom));
    PM_TRY(pm_draw_packing_legend(view->figure, &bottom));
    return pm_draw_packing_keep(view->figure, packing->exact, packing->packed, packing->angle,
                                packing->power, packing->count);
}

static pm_status draw(pm_view *view)
{
    page *p = calloc(1, sizeof *p);
    if (p == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for directions");
    }
    PM_TRY(pm_view_keep(view, p, release_page));
    PM_TRY(read_page(view, p));
    view->drawn = p->packing.count;
    pm_view_fact(view, "packing", pm_packing_loss_json(&p->packing.loss));
    write_note(view, &p->packing.loss);
    return draw_page(view, p);
}

const pm_view_kind pm_view_packing = {
    .name = "packing",
    .files = "MAP.ply ... (storage --packing off -o)",
    .shows = "what 20 bytes a photon round away",
    .files_least = 1,
    .files_most = FILES_MOST,
    .scene = PM_VIEW_NO_SCENE,
    .options = "",
    .title = "Packing: a direction in two bytes, a power in four",
    .draw = draw,
};

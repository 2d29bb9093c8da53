// view effort: how far each pixel had to reach for its photons, and how many it got. A small
// radius means detail and noise, a large one blur; both are means over the pixel's estimates in
// the global map, its own or those of its gather rays.
#include "chart.h"
#include "exposure.h"
#include "view.h"
#include "view_kinds.h"
#include "view_plates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BINS 32

static const double alike = 1e-6;           // of a value: means of equal floats
static const double logarithmic_from = 8.0; // ratio of largest to smallest
static const pm_colour without = {84, 88, 98};

/// One of the two maps.
typedef struct {
    const float *value;
    const char *what; // for --json
    const char *caption;
    const char *heading; // of its scale, with the unit
    const char *chart;   // its heading
    const char *axis;
    pm_colour (*colour)(double position);
    double low, high, mean; // over the pixels with an estimate
    bool logarithmic;
} heat;

typedef struct {
    pm_image image;
    heat map[2];
    const float *radius; // [m]; 0 where there is no estimate
    uint64_t count;      // pixels with one
} effort;

static size_t pixels_of(const effort *e)
{
    return (size_t)e->image.width * (size_t)e->image.height;
}

static pm_status find_channel(const char *path, const pm_image *image, const char *name,
                              const float **plane)
{
    *plane = pm_image_plane(image, name);
    for (size_t i = 0; *plane != NULL && i < (size_t)image->width * (size_t)image->height;
         i++) {
        if ((*plane)[i] < 0.0F) {
            return pm_status_fail(PM_EINPUT, "%s: pixel %zu,%zu of channel %s is %g, not >= 0",
                                  path, i % (size_t)image->width, i / (size_t)image->width,
                                  name, (double)(*plane)[i]);
        }
    }
    return *plane != NULL
               ? PM_OK
               : pm_status_fail(PM_EINPUT, "%s: has no channel %s; take a picture by render",
                                path, name);
}

/// Ends and mean over the pixels that have an estimate.
static void measure(const effort *e, heat *map)
{
    double sum = 0.0;
    map->low = HUGE_VAL;
    for (size_t i = 0; i < pixels_of(e); i++) {
        if (e->radius[i] > 0.0F) {
            double value = (double)map->value[i];
            map->low = fmin(map->low, value);
            map->high = fmax(map->high, value);
            sum += value;
        }
    }
    map->mean = sum / (double)e->count;
    map->high = map->high - map->low > alike * map->high ? map->high : map->low;
    map->logarithmic = map->low > 0.0 && map->high > logarithmic_from * map->low;
}

static pm_status read_effort(const pm_view *view, effort *e)
{
    const char *path = view->files[0];
    e->map[0] = (heat){.what = "radius",
                       .caption = "how far it reached: the radius",
                       .heading = "radius of an\nestimate [m]",
                       .chart = "pixels by their radius",
                       .axis = "radius [m]",
                       .colour = pm_colour_viridis};
    e->map[1] = (heat){.what = "count",
                       .caption = "how many photons it found: k",
                       .heading = "photons of an\nestimate",
                       .chart = "pixels by their photons",
                       .axis = "photons",
                       .colour = pm_colour_inferno};
    PM_TRY(pm_view_read_picture(path, &e->image));
    PM_TRY(find_channel(path, &e->image, "gather.radius", &e->map[0].value));
    PM_TRY(find_channel(path, &e->image, "gather.count", &e->map[1].value));
    e->radius = e->map[0].value;
    for (size_t i = 0; i < pixels_of(e); i++) {
        e->count += e->radius[i] > 0.0F;
    }
    if (e->count == 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s: no pixel looked into the global map, so there is nothing to "
                              "show; render with --global-photons above 0",
                              path);
    }
    measure(e, &e->map[0]);
    measure(e, &e->map[1]);
    return PM_OK;
}

static double position(const heat *map, double value)
{
    if (map->high <= map->low) {
        return 1.0;
    }
    return map->logarithmic ? log(value / map->low) / log(map->high / map->low)
                            : (value - map->low) / (map->high - map->low);
}

static void paint(const effort *e, const heat *map, pm_plate *plate)
{
    for (size_t i = 0; i < pixels_of(e); i++) {
        pm_colour c =
            e->radius[i] > 0.0F ? map->colour(position(map, (double)map->value[i])) : without;
        const uint8_t rgb[3] = {c.r, c.g, c.b};
        memcpy(plate->pixels + 3 * i, rgb, sizeof rgb);
    }
}

/// Where everything stands: the maps side by side, below them the picture and the chart.
typedef struct {
    pm_rect map[2], picture, chart;
    int map_zoom, picture_zoom;
} places;

static pm_rect put(int x, int y, const pm_image *image, int zoom)
{
    return (pm_rect){x, y, pm_plate_length(image->width, zoom),
                     pm_plate_length(image->height, zoom)};
}

static places lay_out(const pm_figure *figure, const pm_image *image)
{
    places at;
    pm_rect room = pm_figure_room(figure);
    int line = (int)pm_figure_pixels_of(figure, 36.0);
    int gap = (int)pm_figure_pixels_of(figure, 24.0);
    int least = (int)pm_figure_pixels_of(figure, 200.0); // of what stands below
    at.map_zoom = pm_plate_fit(image->width, image->height, (room.width - gap) / 2,
                               room.height - 2 * line - gap - least);
    at.map[0] = put(room.x, room.y + line, image, at.map_zoom);
    at.map[1] = at.map[0];
    at.map[1].x += (room.width + gap) / 2;
    int top = at.map[0].y + at.map[0].height + gap + line;
    int rest = room.y + room.height - top;
    at.picture_zoom = pm_plate_fit(image->width, image->height, room.width / 3, rest);
    at.picture = put(room.x, top, image, at.picture_zoom);
    int left = room.x + at.picture.width + gap;
    at.chart = (pm_rect){left, top - line + gap / 5, room.x + room.width - left, rest + line};
    return at;
}

static pm_status draw_picture(pm_view *view, const effort *e, const places *at)
{
    double exposure;
    pm_plate plate;
    PM_TRY(pm_exposure_of(&e->image, &exposure));
    PM_TRY(pm_plate_of(view->files[0], &e->image, exposure + view->options->exposure, &plate));
    PM_TRY(pm_view_lay_plate(view, "the picture", &plate, at->picture_zoom, at->picture.x,
                             at->picture.y));
    return pm_figure_caption(view->figure, &at->picture, "the picture");
}

/// A scale, or where all pixels have the same value a single colour.
static pm_status explain(pm_figure *figure, const heat *map)
{
    char text[64];
    if (map->high > map->low) {
        pm_scale scale = {map->heading, map->low, map->high, map->logarithmic, map->colour};
        return pm_figure_scale(figure, &scale);
    }
    snprintf(text, sizeof text, "%.4g everywhere", map->low);
    const pm_legend_entry entry = {PM_SWATCH_FILL, map->colour(1.0), text};
    return pm_figure_legend(figure, map->heading, &entry, 1);
}

static pm_status draw_map(pm_view *view, const effort *e, int which, const places *at)
{
    const heat *map = &e->map[which];
    pm_plate plate;
    PM_TRY(pm_plate_make(e->image.width, e->image.height, &plate));
    paint(e, map, &plate);
    PM_TRY(pm_view_lay_plate(view, map->what, &plate, at->map_zoom, at->map[which].x,
                             at->map[which].y));
    PM_TRY(pm_figure_caption(view->figure, &at->map[which], map->caption));
    return explain(view->figure, map);
}

/// How many pixels have which value, in equal steps of the scale.
static void sort_into_bins(const effort *e, const heat *map, double edge[BINS + 1],
                           double pixels[BINS + 1])
{
    for (int b = 0; b <= BINS; b++) {
        double t = (double)b / BINS;
        edge[b] = map->logarithmic ? map->low * pow(map->high / map->low, t)
                                   : map->low + (map->high - map->low) * t;
        pixels[b] = 0.0;
    }
    for (size_t i = 0; i < pixels_of(e); i++) {
        if (e->radius[i] > 0.0F) {
            int bin = (int)(BINS * position(map, (double)map->value[i]));
            pixels[bin < BINS ? bin : BINS - 1] += 1.0;
        }
    }
    pixels[BINS] = pixels[BINS - 1]; // the last step's right end
}

/// Of the radii, or where all are alike of the photons.
static pm_status draw_chart(pm_view *view, const effort *e, const places *at)
{
    double edge[BINS + 1];
    double pixels[BINS + 1];
    pm_chart *chart;
    const heat *map = &e->map[e->map[0].high > e->map[0].low ? 0 : 1];
    if (map->high <= map->low) {
        return PM_OK;
    }
    sort_into_bins(e, map, edge, pixels);
    const pm_chart_axes axes = {.heading = map->chart,
                                .x_title = map->axis,
                                .y_title = "pixels",
                                .x_log = map->logarithmic,
                                .x_low = map->low,
                                .x_high = map->high};
    PM_TRY(pm_chart_open(view->figure, &at->chart, &axes, &chart));
    PM_TRY(pm_chart_curve(chart, NULL, pm_colour_named(PM_COLOUR_SKY), PM_CHART_STEPS, edge,
                          pixels, BINS + 1));
    return pm_chart_close(chart);
}

static void write_note(pm_view *view, const effort *e)
{
    char some[PM_VIEW_GROUPED_MAX];
    char all[PM_VIEW_GROUPED_MAX];
    const heat *radius = &e->map[0];
    const heat *count = &e->map[1];
    pm_view_note(
        view,
        "Means over a pixel's look-ups in the global map: where photons lie far apart, the "
        "radius is large and blurs.\n");
    pm_view_note(view,
                 "%s of %s pixels have an estimate: radius %.3g to %.3g m, mean %.3g m; "
                 "photons %.4g to %.4g, mean %.4g.",
                 pm_view_grouped(e->count, some), pm_view_grouped(pixels_of(e), all),
                 radius->low, radius->high, radius->mean, count->low, count->high, count->mean);
}

static void tell(pm_view *view, const effort *e)
{
    for (int m = 0; m < 2; m++) {
        const heat *map = &e->map[m];
        pm_view_fact(
            view, map->what,
            json_pack("{s:f,s:f,s:f}", "low", map->low, "high", map->high, "mean", map->mean));
    }
    pm_view_fact(view, "pixels", json_integer((json_int_t)e->count));
}

static pm_status draw_effort(pm_view *view, effort *e)
{
    PM_TRY(read_effort(view, e));
    PM_TRY(pm_view_open_page(view));
    places at = lay_out(view->figure, &e->image);
    const pm_legend_entry grey = {PM_SWATCH_FILL, without, "no estimate there"};
    PM_TRY(draw_map(view, e, 0, &at));
    PM_TRY(draw_map(view, e, 1, &at));
    PM_TRY(pm_figure_legend(view->figure, "not on the scales", &grey, 1));
    PM_TRY(draw_picture(view, e, &at));
    PM_TRY(draw_chart(view, e, &at));
    view->drawn = e->count;
    write_note(view, e);
    tell(view, e);
    return pm_view_finish(view);
}

static pm_status make(pm_view *view)
{
    effort e = {0};
    pm_status status = draw_effort(view, &e);
    pm_image_free(&e.image);
    return status;
}

const pm_view_kind pm_view_effort = {
    .name = "effort",
    .files = "PICTURE.exr (render -o)",
    .shows = "how far pixels reached for photons, and for how many",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_NO_SCENE,
    .options = "exposure",
    .title = "The effort behind each pixel: its radius and its photons",
    .make = make,
};

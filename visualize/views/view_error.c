// view error: where a picture is too bright and where too dark. Every number is core/compare's,
// the same as `compare` prints; only the colours are made here.
#include "compare.h"
#include "exposure.h"
#include "spectrum.h"
#include "view.h"
#include "view_kinds.h"
#include "view_plates.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double coloured_share = 0.99; // of the pixels within the scale's ends
static const pm_colour left_out = {84, 88, 98};

typedef struct {
    pm_image image[2]; // the picture and the reference
    pm_compare_pair pair;
    pm_compare_part whole;
    double *error;   // signed, relative to the reference's mean; pixels that count
    double full;     // at the scale's ends
    uint64_t beyond; // pixels that lie outside of them
} errors;

/// Where the three pictures stand.
typedef struct {
    pm_rect small[2], large;
    int small_zoom, large_zoom;
} places;

static size_t pixels_of(const errors *e)
{
    return (size_t)e->image[0].width * (size_t)e->image[0].height;
}

static double luminance_at(const pm_image *image, size_t i)
{
    return pm_spectrum_luminance(pm_rgb((double)pm_image_plane(image, "R")[i],
                                        (double)pm_image_plane(image, "G")[i],
                                        (double)pm_image_plane(image, "B")[i]));
}

static int compare_sizes(const void *a, const void *b)
{
    double x = fabs(*(const double *)a);
    double y = fabs(*(const double *)b);
    return (x > y) - (x < y);
}

/// The next of 1, 2, 5 times a power of ten.
static double round_up(double value)
{
    double decade = pow(10.0, floor(log10(value)));
    const double steps[] = {1.0, 2.0, 5.0};
    for (int i = 0; i < 3; i++) {
        if (value <= steps[i] * decade * (1.0 + 1e-12)) {
            return steps[i] * decade;
        }
    }
    return 10.0 * decade;
}

/// Ends between which nearly all errors lie.
static pm_status choose_ends(errors *e)
{
    double *sorted = malloc(e->pair.count * sizeof *sorted);
    if (sorted == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %zu pixels", pixels_of(e));
    }
    size_t count = 0;
    for (size_t i = 0; i < pixels_of(e); i++) {
        if (e->pair.counted[i]) {
            sorted[count++] = e->error[i];
        }
    }
    qsort(sorted, count, sizeof *sorted, compare_sizes);
    double most = fabs(sorted[(size_t)(coloured_share * (double)(count - 1))]);
    most = most > 0.0 ? most : fabs(sorted[count - 1]);
    e->full = most > 0.0 ? round_up(most) : 0.01; // of equal pictures: any
    for (size_t i = 0; i < count; i++) {
        e->beyond += fabs(sorted[i]) > e->full;
    }
    free(sorted);
    return PM_OK;
}

static pm_status find_errors(errors *e)
{
    e->error = calloc(pixels_of(e), sizeof *e->error);
    if (e->error == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %zu pixels", pixels_of(e));
    }
    for (size_t i = 0; i < pixels_of(e); i++) {
        double off = luminance_at(&e->image[0], i) - luminance_at(&e->image[1], i);
        e->error[i] = off / e->whole.mean_b;
    }
    return choose_ends(e);
}

static pm_status read_errors(const pm_view *view, errors *e)
{
    const char *const names[2] = {view->files[0], view->files[1]};
    for (int i = 0; i < 2; i++) {
        PM_TRY(pm_view_read_picture(names[i], &e->image[i]));
    }
    PM_TRY(pm_compare_pair_make(&e->image[0], &e->image[1], names, true, &e->pair));
    PM_TRY(pm_compare_measure(&e->pair, "", &e->whole));
    if (!(e->whole.mean_b > 0.0)) {
        return pm_status_fail(PM_EINPUT,
                              "%s: the reference is black where it counts (mean %g), so no "
                              "relative error exists",
                              names[1], e->whole.mean_b);
    }
    return find_errors(e);
}

static pm_rect put(int x, int y, const pm_image *image, int zoom)
{
    return (pm_rect){x, y, pm_plate_length(image->width, zoom),
                     pm_plate_length(image->height, zoom)};
}

/// Picture over reference, and the error beside them, as large as what is left.
static places lay_out(const pm_figure *figure, const pm_image *image)
{
    places at;
    pm_rect room = pm_figure_room(figure);
    int line = (int)pm_figure_pixels_of(figure, 36.0);
    int gap = (int)pm_figure_pixels_of(figure, 24.0);
    at.small_zoom = pm_plate_fit(image->width, image->height, room.width / 3,
                                 (room.height - 2 * line - gap) / 2);
    at.small[0] = put(room.x, room.y + line, image, at.small_zoom);
    at.small[1] = at.small[0];
    at.small[1].y += at.small[0].height + gap + line;
    int left = room.x + at.small[0].width + gap;
    at.large_zoom = pm_plate_fit(image->width, image->height, room.x + room.width - left,
                                 room.height - line);
    at.large = put(left, room.y + line, image, at.large_zoom);
    return at;
}

static pm_status draw_pictures(pm_view *view, const errors *e, const places *at)
{
    static const char *const what[2] = {"the picture", "the reference"};
    double exposure;
    PM_TRY(pm_exposure_of(&e->image[1], &exposure));
    exposure += view->options->exposure;
    pm_view_fact(view, "exposure", json_real(exposure));
    for (int i = 0; i < 2; i++) {
        pm_plate plate;
        PM_TRY(pm_plate_of(view->files[i], &e->image[i], exposure, &plate));
        PM_TRY(pm_view_lay_plate(view, what[i], &plate, at->small_zoom, at->small[i].x,
                                 at->small[i].y));
        PM_TRY(pm_figure_caption(view->figure, &at->small[i], what[i]));
    }
    return PM_OK;
}

static void paint(const errors *e, pm_plate *plate)
{
    for (size_t i = 0; i < pixels_of(e); i++) {
        pm_colour c = e->pair.counted[i]
                          ? pm_colour_diverging(0.5 + 0.5 * e->error[i] / e->full)
                          : left_out;
        const uint8_t rgb[3] = {c.r, c.g, c.b};
        memcpy(plate->pixels + 3 * i, rgb, sizeof rgb);
    }
}

static pm_status draw_error(pm_view *view, const errors *e, const places *at)
{
    pm_plate plate;
    PM_TRY(pm_plate_make(e->image[0].width, e->image[0].height, &plate));
    paint(e, &plate);
    PM_TRY(pm_view_lay_plate(view, "error", &plate, at->large_zoom, at->large.x, at->large.y));
    return pm_figure_caption(view->figure, &at->large,
                             "error: blue too dark, orange too bright");
}

/// Which layer is how wrong: a heading and a line a layer.
static pm_status list_layers(pm_view *view, const errors *e)
{
    char text[PM_LAYER_COUNT][64];
    pm_legend_entry entries[PM_LAYER_COUNT];
    int count = 0;
    for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
        pm_compare_part part;
        const char *name = pm_layer_name(layer);
        if (!pm_compare_has(&e->pair, name)) {
            continue;
        }
        PM_TRY(pm_compare_measure(&e->pair, name, &part));
        if (part.mean_b > 0.0) {
            snprintf(text[count], sizeof text[count], "%s: %.3g", name, part.rel_rmse);
            entries[count] =
                (pm_legend_entry){PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_GREY), text[count]};
            count++;
        }
    }
    return count > 0
               ? pm_figure_legend(view->figure, "rel_rmse of each layer,\nby its own mean",
                                  entries, count)
               : PM_OK;
}

static pm_status explain(pm_view *view, const errors *e)
{
    char beyond[64];
    char number[PM_VIEW_GROUPED_MAX];
    pm_scale scale = {"error of luminance over\nthe reference's mean", -e->full, e->full, false,
                      pm_colour_diverging};
    snprintf(beyond, sizeof beyond, "%s pixels are further off",
             pm_view_grouped(e->beyond, number));
    const pm_legend_entry entries[] = {
        {PM_SWATCH_NONE, left_out, beyond},
        {PM_SWATCH_FILL, left_out, "lamps, frame"},
    };
    PM_TRY(pm_figure_scale(view->figure, &scale));
    PM_TRY(pm_figure_legend(view->figure, "not on the scale", entries, 2));
    return list_layers(view, e);
}

static void write_note(pm_view *view, const errors *e)
{
    char some[PM_VIEW_GROUPED_MAX];
    char rest[PM_VIEW_GROUPED_MAX];
    const pm_compare_part *w = &e->whole;
    pm_view_note(view,
                 "rel_rmse %.5g (rel_mse %.5g).  Mean of the picture over the reference's: red "
                 "%.4f, green %.4f, blue %.4f.\n",
                 w->rel_rmse, w->rel_mse, w->mean_ratio[0], w->mean_ratio[1], w->mean_ratio[2]);
    pm_view_note(
        view, "%s pixels compared, %s left out.%s", pm_view_grouped(e->pair.count, some),
        pm_view_grouped(pixels_of(e) - e->pair.count, rest),
        w->halves ? "  The reference's own noise is taken out of these numbers, not of "
                    "the colours."
                  : "");
}

static json_t *number_or_null(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static void tell(pm_view *view, const errors *e)
{
    json_t *ratio = json_array();
    for (int c = 0; c < 3; c++) {
        json_array_append_new(ratio, number_or_null(e->whole.mean_ratio[c]));
    }
    pm_view_fact(view, "rel_mse", json_real(e->whole.rel_mse));
    pm_view_fact(view, "rel_rmse", json_real(e->whole.rel_rmse));
    pm_view_fact(view, "mean_ratio", ratio);
    pm_view_fact(view, "pixels", json_integer((json_int_t)e->pair.count));
    pm_view_fact(view, "beyond", json_integer((json_int_t)e->beyond));
}

static pm_status draw_errors(pm_view *view, errors *e)
{
    PM_TRY(read_errors(view, e));
    PM_TRY(pm_view_open_page(view));
    places at = lay_out(view->figure, &e->image[0]);
    PM_TRY(draw_pictures(view, e, &at));
    PM_TRY(draw_error(view, e, &at));
    PM_TRY(explain(view, e));
    view->drawn = e->pair.count;
    write_note(view, e);
    tell(view, e);
    return pm_view_finish(view);
}

static pm_status make(pm_view *view)
{
    errors e = {0};
    pm_status status = draw_errors(view, &e);
    free(e.error);
    pm_compare_pair_free(&e.pair);
    pm_image_free(&e.image[0]);
    pm_image_free(&e.image[1]);
    return status;
}

const pm_view_kind pm_view_error = {
    .name = "error",
    .files = "PICTURE.exr REFERENCE.exr (render -o, reference -o)",
    .shows = "where a picture is wrong, and how much",
    .files_least = 2,
    .files_most = 2,
    .scene = PM_VIEW_NO_SCENE,
    .options = "exposure",
    .title = "Where the picture is wrong",
    .make = make,
};

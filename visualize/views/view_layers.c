// view layers: a picture as the sum that it is. All parts are shown at one exposure, so that a
// dim layer looks dim; what is black everywhere is named and takes no room.
#include "exposure.h"
#include "layer.h"
#include "spectrum.h"
#include "view.h"
#include "view_kinds.h"
#include "view_plates.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TERMS_MOST (1 + PM_LAYER_COUNT)

static const double sums_agree = 1e-4; // of the picture's mean

// In the order in which a renderer adds them, of lengths in a figure 900 pixels high.
static const double sign_size = 36.0;
static const double sign_room = 28.0; // beside a picture
static const double name_size = 19.0;
static const double word_size = 16.0;
static const double words_below = 104.0;
static const double row_gap = 16.0;

/// The picture or one of its layers.
typedef struct {
    const char *name;   // "" before the layers: the picture
    const char *prefix; // of its channels: "" or the layer's name
    const char *words;
    double mean; // luminance [W/(m^2 sr)]
    bool black;
} term;

typedef struct {
    pm_image image;
    term all[TERMS_MOST]; // the picture first
    double exposure;
} sum;

/// Where terms stand: pixels from the figure's top left.
typedef struct {
    int x, y;        // of the first picture
    int pitch, drop; // from one column to the next, from one row to the next
    int columns;
    int width, height; // of a picture, zoomed
    int zoom;
} strip;

static const term terms[TERMS_MOST] = {
    {.name = "the picture", .prefix = "", .words = "all light that reaches\nthe eye"},
    {.name = "direct", .prefix = "direct", .words = "light, then a wall,\nthen the eye"},
    {.name = "specular", .prefix = "specular", .words = "what mirrors and glass\nshow the eye"},
    {.name = "caustic", .prefix = "caustic", .words = "light, glass or mirror,\nthen a wall"},
    {.name = "indirect",
     .prefix = "indirect",
     .words = "light, wall after wall,\nthen the eye"},
    {.name = "volume", .prefix = "volume", .words = "light that fog turns\ntowards the eye"},
    {.name = "emission", .prefix = "emission", .words = "the lamps themselves,\nand the sky"},
};

static const float *channel_of(const pm_image *image, const char *prefix, int c)
{
    char name[PM_IMAGE_NAME_ROOM];
    snprintf(name, sizeof name, "%s%s%c", prefix, prefix[0] != '\0' ? "." : "", "RGB"[c]);
    return pm_image_plane(image, name);
}

static size_t pixels_of(const pm_image *image)
{
    return (size_t)image->width * (size_t)image->height;
}

static pm_spectrum mean_of(const pm_image *image, const char *prefix)
{
    pm_spectrum mean = pm_gray(0.0);
    for (int c = 0; c < 3; c++) {
        const float *plane = channel_of(image, prefix, c);
        for (size_t i = 0; i < pixels_of(image); i++) {
            mean.c[c] += (double)plane[i];
        }
    }
    return pm_spectrum_scale(mean, 1.0 / (double)pixels_of(image));
}

static bool is_black(const pm_image *image, const char *prefix)
{
    for (int c = 0; c < 3; c++) {
        const float *plane = channel_of(image, prefix, c);
        for (size_t i = 0; i < pixels_of(image); i++) {
            if (plane[i] != 0.0F) {
                return false;
            }
        }
    }
    return true;
}

static pm_status check_layers(const char *path, const pm_image *image)
{
    for (int t = 1; t < TERMS_MOST; t++) {
        for (int c = 0; c < 3; c++) {
            if (channel_of(image, terms[t].prefix, c) == NULL) {
                return pm_status_fail(
                    PM_EINPUT,
                    "%s: has no channel %s.%c; take a picture with layers, as render and "
                    "reference write",
                    path, terms[t].prefix, "RGB"[c]);
            }
        }
    }
    return PM_OK;
}

/// Means of all terms; the layers' must add up to the picture's.
static pm_status measure(const char *path, sum *s)
{
    pm_spectrum rest = mean_of(&s->image, "");
    double whole = pm_spectrum_luminance(rest);
    for (int t = 0; t < TERMS_MOST; t++) {
        pm_spectrum mean = mean_of(&s->image, terms[t].prefix);
        s->all[t] = terms[t];
        s->all[t].mean = pm_spectrum_luminance(mean);
        s->all[t].black = is_black(&s->image, terms[t].prefix);
        rest = t > 0 ? pm_spectrum_sub(rest, mean) : rest;
    }
    double off = fabs(pm_spectrum_luminance(rest));
    if (off > sums_agree * fabs(whole)) {
        return pm_status_fail(PM_EINPUT,
                              "%s: its layers have a mean of %.5g in all and the picture one "
                              "of %.5g, but must add up to it; render it anew (--view full)",
                              path, whole - pm_spectrum_luminance(rest), whole);
    }
    return PM_OK;
}

/// `count` pictures in `rows` rows, as large as fits.
static strip lay_rows(const pm_figure *figure, const pm_image *image, int count, int rows)
{
    pm_rect room = pm_figure_wide_room(figure);
    int sign = (int)pm_figure_pixels_of(figure, sign_room);
    int below = (int)pm_figure_pixels_of(figure, words_below);
    int gap = (int)pm_figure_pixels_of(figure, row_gap);
    int indent = rows > 1 ? sign : 0;
    strip s = {.columns = (count + rows - 1) / rows};
    int pitch = (room.width - indent + sign) / s.columns;
    s.zoom = pm_plate_fit(image->width, image->height, pitch - sign,
                          (room.height + gap) / rows - below - gap);
    s.width = pm_plate_length(image->width, s.zoom);
    s.height = pm_plate_length(image->height, s.zoom);
    s.pitch = pitch < s.width + 4 * sign ? pitch : s.width + 4 * sign;
    s.drop = s.height + below + gap;
    s.x = room.x + indent;
    s.y = room.y + (room.height + gap - rows * s.drop) / 2;
    return s;
}

/// The largest pictures that fit; of equal ones those in the fewest rows.
static strip lay_out(const pm_figure *figure, const pm_image *image, int count)
{
    strip best = lay_rows(figure, image, count, 1);
    for (int rows = 2; rows <= count; rows++) {
        strip s = lay_rows(figure, image, count, rows);
        best = s.width > best.width ? s : best;
    }
    return best;
}

/// R G B of one term as an image of its own.
static pm_status cut_out(const pm_image *image, const char *prefix, pm_image *out)
{
    static const char *const names[3] = {"R", "G", "B"};
    PM_TRY(pm_image_make(image->width, image->height, names, 3, out));
    for (int c = 0; c < 3; c++) {
        memcpy(out->plane[c], channel_of(image, prefix, c), pixels_of(image) * sizeof(float));
    }
    return PM_OK;
}

static pm_status make_plate(const pm_view *view, const sum *s, const term *t, pm_plate *plate)
{
    pm_image part;
    PM_TRY(cut_out(&s->image, t->prefix, &part));
    pm_status status = pm_plate_of(view->files[0], &part, s->exposure, plate);
    pm_image_free(&part);
    return status;
}

static pm_status write_words(pm_view *view, const sum *s, const term *t, int x, int y)
{
    pm_figure *figure = view->figure;
    char numbers[64];
    double whole = s->all[0].mean;
    double share = whole > 0.0 ? 100.0 * t->mean / whole : 0.0;
    double line = pm_figure_pixels_of(figure, 27.0);
    double small = pm_figure_pixels_of(figure, word_size);
    if (t == &s->all[0]) {
        snprintf(numbers, sizeof numbers, "mean %.3g", t->mean);
    } else {
        snprintf(numbers, sizeof numbers, "mean %.3g:  %.*f %%", t->mean, share < 1.0 ? 2 : 1,
                 share);
    }
    PM_TRY(pm_figure_text(figure, t->name, x, y, pm_figure_pixels_of(figure, name_size),
                          PM_TEXT_STRONG));
    PM_TRY(pm_figure_text(figure, numbers, x, y + line, small, PM_TEXT_PLAIN));
    return pm_figure_text(figure, t->words, x, y + 1.9 * line, small, PM_TEXT_DIM);
}

/// The plus before a picture, in the middle between it and what stands before it.
static pm_status write_sign(pm_figure *figure, const strip *at, int number, int x, int y)
{
    double size = pm_figure_pixels_of(figure, sign_size);
    bool first = number % at->columns == 0;
    double gap = first ? pm_figure_pixels_of(figure, sign_room) : at->pitch - at->width;
    return pm_figure_text(figure, number == 1 ? "=" : "+", x - 0.5 * gap - 0.3 * size,
                          y + 0.5 * at->height - 0.5 * size, size, PM_TEXT_STRONG);
}

static pm_status draw_term(pm_view *view, const sum *s, const strip *at, const term *t,
                           int number)
{
    int x = at->x + number % at->columns * at->pitch;
    int y = at->y + number / at->columns * at->drop;
    pm_plate plate;
    PM_TRY(make_plate(view, s, t, &plate));
    PM_TRY(pm_view_lay_plate(view, t->name, &plate, at->zoom, x, y));
    double words = pm_figure_pixels_of(view->figure, 8.0);
    PM_TRY(write_words(view, s, t, x, y + at->height + (int)words));
    return number > 0 ? write_sign(view->figure, at, number, x, y) : PM_OK;
}

static int count_shown(const sum *s)
{
    int count = 1;
    for (int t = 1; t < TERMS_MOST; t++) {
        count += !s->all[t].black;
    }
    return count;
}

static void write_note(pm_view *view, const sum *s, const strip *at)
{
    char zoom[16];
    const char *before = "Black everywhere, so not shown: ";
    pm_view_note(view,
                 "Every light path is in one layer, and the layers add up to the picture.  "
                 "%dx%d pixels, shown %s, %+.1f stops.\n",
                 s->image.width, s->image.height,
                 pm_plate_zoom_text(at->zoom, zoom, sizeof zoom), s->exposure);
    pm_view_note(view, "Means of luminance [W/(m^2 sr)], and their shares.  ");
    for (int t = 1; t < TERMS_MOST; t++) {
        if (s->all[t].black) {
            pm_view_note(view, "%s%s", before, s->all[t].name);
            before = ", ";
        }
    }
    pm_view_note(view, "%s", before[0] == ',' ? "." : "");
}

static void tell(pm_view *view, const sum *s)
{
    json_t *layers = json_array();
    for (int t = 0; t < TERMS_MOST; t++) {
        json_array_append_new(layers, json_pack("{s:s,s:f,s:b}", "name", s->all[t].name, "mean",
                                                s->all[t].mean, "black", s->all[t].black));
    }
    pm_view_fact(view, "layers", layers);
    pm_view_fact(view, "exposure", json_real(s->exposure));
}

static pm_status read_sum(const pm_view *view, sum *s)
{
    const char *path = view->files[0];
    PM_TRY(pm_view_read_picture(path, &s->image));
    PM_TRY(check_layers(path, &s->image));
    PM_TRY(measure(path, s));
    PM_TRY(pm_exposure_of(&s->image, &s->exposure));
    s->exposure += view->options->exposure;
    return PM_OK;
}

static pm_status draw_sum(pm_view *view, sum *s)
{
    PM_TRY(read_sum(view, s));
    PM_TRY(pm_view_open_page(view));
    strip at = lay_out(view->figure, &s->image, count_shown(s));
    int number = 0;
    for (int t = 0; t < TERMS_MOST; t++) {
        if (t == 0 || !s->all[t].black) {
            PM_TRY(draw_term(view, s, &at, &s->all[t], number++));
        }
    }
    view->drawn = (uint64_t)number;
    write_note(view, s, &at);
    tell(view, s);
    return pm_view_finish(view);
}

static pm_status make(pm_view *view)
{
    sum s = {0};
    pm_status status = draw_sum(view, &s);
    pm_image_free(&s.image);
    return status;
}

const pm_view_kind pm_view_layers = {
    .name = "layers",
    .files = "PICTURE.exr (render -o)",
    .shows = "a picture as the sum of its layers",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_NO_SCENE,
    .options = "exposure",
    .title = "A picture is the sum of its layers",
    .make = make,
};

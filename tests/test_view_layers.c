// `view layers` on pictures made here: where each layer stands --json says, and its pixels are
// compared with the sRGB curve worked out here.
#include "command.h"
#include "exr.h"
#include "layer.h"
#include "seen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 12, CHANNELS = 3 * (PM_LAYER_COUNT + 1) };

static const char *const channel_name[CHANNELS] = {
    "R",          "G",          "B",          "emission.R", "emission.G", "emission.B",
    "specular.R", "specular.G", "specular.B", "volume.R",   "volume.G",   "volume.B",
    "direct.R",   "direct.G",   "direct.B",   "caustic.R",  "caustic.G",  "caustic.B",
    "indirect.R", "indirect.G", "indirect.B"};

/// Even layers of these radiances, in the order of pm_layer, and what they add up to.
static pm_image make_picture(int side, const double layer[PM_LAYER_COUNT][3])
{
    pm_image image;
    CHECK_OK(pm_image_make(side, side, channel_name, CHANNELS, &image));
    for (int l = 0; l < PM_LAYER_COUNT; l++) {
        for (int c = 0; c < 3; c++) {
            for (int i = 0; i < side * side; i++) {
                image.plane[3 * (l + 1) + c][i] = (float)layer[l][c];
                image.plane[c][i] += (float)layer[l][c];
            }
        }
    }
    return image;
}

static const char *write_picture(const char *name, pm_image *image)
{
    const char *path = pm_command_path(name);
    CHECK_OK(pm_exr_write(path, image));
    pm_image_free(image);
    return path;
}

static const double lit[PM_LAYER_COUNT][3] = {
    [PM_LAYER_DIRECT] = {0.2, 0.1, 0.05},
    [PM_LAYER_CAUSTIC] = {0.02, 0.04, 0.0},
    [PM_LAYER_INDIRECT] = {0.1, 0.1, 0.1},
};

static pm_seen look(const char *path, const char *option)
{
    char line[256];
    snprintf(line, sizeof line, "view layers {S} --size 640x480 %s",
             option != NULL ? option : "");
    return pm_seen_look(line, path, NULL);
}

static double encode(double linear)
{
    double l = fmin(linear, 1.0);
    return 255.0 * (l <= 0.0031308 ? 12.92 * l : 1.055 * pow(l, 1.0 / 2.4) - 0.055);
}

static const json_t *find_shown(const pm_seen *s, const char *what)
{
    size_t i;
    json_t *one;
    json_array_foreach(pm_seen_member(s, "pictures"), i, one)
    {
        if (strcmp(json_string_value(json_object_get(one, "what")), what) == 0) {
            return one;
        }
    }
    return NULL;
}

static int part(const json_t *shown, const char *key, size_t axis)
{
    return (int)json_integer_value(json_array_get(json_object_get(shown, key), axis));
}

/// Every corner of the layer's picture, and its middle, is this light.
static void check_shown(const pm_seen *s, const char *what, const double light[3], double gain)
{
    const json_t *shown = find_shown(s, what);
    CHECK_THAT(shown != NULL, "%s is not shown", what);
    int last = part(shown, "size", 0) - 1;
    CHECK(last + 1 == SIDE * (int)json_integer_value(json_object_get(shown, "zoom")));
    const int places[5][2] = {{0, 0}, {last, 0}, {0, last}, {last, last}, {last / 2, last / 2}};
    for (int i = 0; i < 5; i++) {
        CHECK_COLOUR(pm_seen_at(s, part(shown, "at", 0) + places[i][0],
                                part(shown, "at", 1) + places[i][1]),
                     encode(gain * light[0]), encode(gain * light[1]), encode(gain * light[2]),
                     0.51);
    }
}

static void layers_share_an_exposure(void)
{
    pm_image image = make_picture(SIDE, lit);
    const double whole[3] = {0.32, 0.24, 0.15};
    pm_seen s = look(write_picture("a.exr", &image), NULL);
    double stops = pm_seen_number(&s, "exposure");
    CHECK_NEAR(stops, 1.0, 0.0); // 0.32 x 2 is below 0.9, half a stop more is not
    check_shown(&s, "the picture", whole, exp2(stops));
    check_shown(&s, "direct", lit[PM_LAYER_DIRECT], exp2(stops));
    check_shown(&s, "caustic", lit[PM_LAYER_CAUSTIC], exp2(stops));
    check_shown(&s, "indirect", lit[PM_LAYER_INDIRECT], exp2(stops));
    CHECK(strcmp(pm_seen_text(&s, "layers.1.name"), "direct") == 0);
    CHECK_NEAR(pm_seen_number(&s, "layers.1.mean"), 0.2126 * 0.2 + 0.7152 * 0.1 + 0.0722 * 0.05,
               1e-7);
    CHECK_CONTAINS(pm_seen_text(&s, "note"),
                   "Black everywhere, so not shown: specular, volume, emission.");
    CHECK(find_shown(&s, "volume") == NULL && pm_seen_number(&s, "drawn") == 4.0);
    pm_seen_free(&s);
}

static bool overlap(const json_t *a, const json_t *b)
{
    return abs(part(a, "at", 0) - part(b, "at", 0)) < part(a, "size", 0) &&
           abs(part(a, "at", 1) - part(b, "at", 1)) < part(a, "size", 1);
}

static void check_clear(const pm_seen *s, const json_t *pictures)
{
    for (size_t i = 0; i < json_array_size(pictures); i++) {
        const json_t *one = json_array_get(pictures, i);
        CHECK(part(one, "at", 0) >= 0 && part(one, "at", 1) >= 60);
        CHECK(part(one, "at", 0) + part(one, "size", 0) <= s->width);
        CHECK(part(one, "at", 1) + part(one, "size", 1) <= s->height);
        for (size_t j = 0; j < i; j++) {
            CHECK_THAT(!overlap(one, json_array_get(pictures, j)), "%zu and %zu overlap", i, j);
        }
    }
}

// Each layer has light; the volume only in one pixel, which is enough.
static void seven_pictures_stand_clear(void)
{
    const double all[PM_LAYER_COUNT][3] = {
        [PM_LAYER_EMISSION] = {0.1, 0.1, 0.1}, [PM_LAYER_SPECULAR] = {0.1, 0.1, 0.1},
        [PM_LAYER_DIRECT] = {0.1, 0.1, 0.1},   [PM_LAYER_CAUSTIC] = {0.1, 0.1, 0.1},
        [PM_LAYER_INDIRECT] = {0.1, 0.1, 0.1},
    };
    pm_image image = make_picture(SIDE, all);
    pm_image_plane(&image, "volume.B")[SIDE * SIDE - 1] = 1e-6F;
    pm_seen s = look(write_picture("a.exr", &image), "--exposure=-1.5");
    CHECK_NEAR(pm_seen_number(&s, "exposure"), -1.0, 0.0); // 0.5 of the picture's own
    check_shown(&s, "direct", all[PM_LAYER_DIRECT], 0.5);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "-1.0 stops");
    CHECK(json_array_size(pm_seen_member(&s, "pictures")) == 7);
    check_clear(&s, pm_seen_member(&s, "pictures"));
    pm_seen_free(&s);
}

// Bright and dim columns: seen from afar, the mean of their light, not of their bytes.
static void large_pictures_are_meant_in_linear_light(void)
{
    const double none[PM_LAYER_COUNT][3] = {{0.0}};
    int side = 320;
    pm_image image = make_picture(side, none);
    for (int c = 0; c < 3; c++) {
        for (int i = 0; i < side * side; i++) {
            image.plane[c][i] = image.plane[3 * (PM_LAYER_DIRECT + 1) + c][i] =
                i % 2 == 0 ? 1.0F : 0.1F;
        }
    }
    pm_seen s = look(write_picture("a.exr", &image), "--exposure=0.5");
    const json_t *shown = find_shown(&s, "the picture");
    CHECK((int)json_integer_value(json_object_get(shown, "zoom")) == -2);
    CHECK(part(shown, "size", 0) == 160);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "320x320 pixels, shown 1/2, +0.0 stops");
    CHECK_COLOUR(pm_seen_at(&s, part(shown, "at", 0) + 9, part(shown, "at", 1) + 9),
                 encode(0.55), encode(0.55), encode(0.55), 1.0);
    pm_seen_free(&s);
}

static void check_refused(const char *path, const char *words)
{
    int files = pm_command_count_files();
    pm_test_ran ran = pm_command_run("view layers {S} -o {O}", path, pm_command_path("o.png"));
    pm_command_check_refusal("view layers", &ran, words);
    CHECK(pm_command_count_files() == files);
    pm_test_ran_free(&ran);
}

static void what_is_no_sum_is_refused(void)
{
    pm_image image = make_picture(SIDE, lit);
    pm_image_plane(&image, "G")[5] += 0.5F;
    check_refused(write_picture("sum.exr", &image),
                  "sum.exr: its layers have a mean of 0.25051 in all and the picture one of "
                  "0.25299");
    image = make_picture(SIDE, lit);
    pm_image_plane(&image, "caustic.B")[SIDE + 2] = NAN;
    check_refused(write_picture("nan.exr", &image),
                  "nan.exr: pixel 2,1 of channel caustic.B is ");
    CHECK_OK(pm_image_make(SIDE, SIDE, channel_name, 18, &image));
    check_refused(write_picture("five.exr", &image),
                  "five.exr: has no channel indirect.R; take");
    check_refused(pm_command_path("none.exr"), "none.exr: cannot be read");
    check_refused(pm_command_write("text.exr", "no picture\n"), "text.exr: ");
}

PM_TESTS({"view_layers.1",
          "layers are shown in sRGB at the picture's exposure; black ones are only named",
          layers_share_an_exposure},
         {"view_layers.2",
          "the picture and six layers stand clear of each other, and --exposure adds",
          seven_pictures_stand_clear},
         {"view_layers.3", "pixels that become one are meant in linear light",
          large_pictures_are_meant_in_linear_light},
         {"view_layers.4",
          "layers that do not add up, a NaN, a missing layer or file are refused",
          what_is_no_sum_is_refused})

// `view error` on pictures made here, whose error is known at each pixel; its numbers are those
// that `compare` prints.
#include "command.h"
#include "exr.h"
#include "seen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 24 };

#define NEAR 12.0 // a bar's steps, and its half covered ends

static const uint8_t grey[3] = {84, 88, 98};
static const char *const names[10] = {"R",       "G",       "B",       "mask.emitter",
                                      "half1.R", "half1.G", "half1.B", "half2.R",
                                      "half2.G", "half2.B"};

/// Grey light of radiance `level`, with the first `channels` of the names.
static pm_image make_even(double level, int channels)
{
    pm_image image;
    CHECK_OK(pm_image_make(SIDE, SIDE, names, channels, &image));
    for (int c = 0; c < channels; c++) {
        for (int i = 0; i < SIDE * SIDE && c != 3; i++) {
            image.plane[c][i] = (float)level;
        }
    }
    return image;
}

static void set(pm_image *image, int x, int y, double level)
{
    for (int c = 0; c < 3; c++) {
        image->plane[c][y * SIDE + x] = (float)level;
    }
}

static const char *write_picture(const char *name, pm_image *image)
{
    const char *path = pm_command_path(name);
    CHECK_OK(pm_exr_write(path, image));
    pm_image_free(image);
    return path;
}

static pm_seen look(pm_image *picture, pm_image *reference)
{
    const char *a = write_picture("a.exr", picture);
    const char *b = write_picture("b.exr", reference);
    return pm_seen_look("view error {S} {O} --size 640x480", a, b);
}

/// The middle of a pixel of the error's picture, the third that is laid.
static const uint8_t *pixel(const pm_seen *s, int x, int y)
{
    CHECK(strcmp(pm_seen_text(s, "pictures.2.what"), "error") == 0);
    int zoom = (int)pm_seen_number(s, "pictures.2.zoom");
    return pm_seen_at(s, (int)pm_seen_number(s, "pictures.2.at.0") + zoom * x + zoom / 2,
                      (int)pm_seen_number(s, "pictures.2.at.1") + zoom * y + zoom / 2);
}

static void check_same(const uint8_t *got, const uint8_t *want, double tolerance)
{
    CHECK_COLOUR(got, (double)want[0], (double)want[1], (double)want[2], tolerance);
}

/// Against a reference of 2: rows that are 0.1 (5 %) too bright, and one 0.06 (3 %) too dark.
static pm_image make_wrong(void)
{
    pm_image image = make_even(2.0, 4);
    for (int x = 0; x < SIDE; x++) {
        set(&image, x, 8, 2.1);
        set(&image, x, 12, 1.94);
    }
    return image;
}

static json_t *compare(void)
{
    pm_test_ran ran = pm_command_run("compare {S} {O} --json", pm_command_path("a.exr"),
                                     pm_command_path("b.exr"));
    CHECK_THAT(ran.exit_code == 0, "%s", ran.err);
    json_t *answer = json_loads(ran.out, 0, NULL);
    CHECK(answer != NULL);
    pm_test_ran_free(&ran);
    return answer;
}

/// All numbers are those that `compare` has of the two files.
static void check_numbers(const pm_seen *s)
{
    char words[128];
    json_t *want = compare();
    double mse = json_number_value(json_object_get(want, "rel_mse"));
    double rmse = json_number_value(json_object_get(want, "rel_rmse"));
    CHECK_NEAR(pm_seen_number(s, "rel_mse"), mse, 0.0);
    CHECK_NEAR(pm_seen_number(s, "rel_rmse"), rmse, 0.0);
    CHECK(json_equal(pm_seen_member(s, "mean_ratio"), json_object_get(want, "mean_ratio")));
    CHECK(json_equal(pm_seen_member(s, "pixels"), json_object_get(want, "pixels")));
    snprintf(words, sizeof words, "rel_rmse %.5g (rel_mse %.5g)", rmse, mse);
    CHECK_CONTAINS(pm_seen_text(s, "note"), words);
    json_decref(want);
}

/// One pixel in 256 lies beyond what 99 of 100 reach: it has the end's colour, and is counted.
static void check_colours(const pm_seen *s)
{
    CHECK_NEAR(pm_seen_number(s, "scales.0.high"), 0.05, 1e-12);
    CHECK_NEAR(pm_seen_number(s, "scales.0.low"), -0.05, 1e-12);
    check_same(pixel(s, 10, 8), pm_seen_scale(s, 0, 1.0), NEAR);
    check_same(pixel(s, 10, 12), pm_seen_scale(s, 0, 0.2), 2.0 * NEAR);
    CHECK_COLOUR(pixel(s, 10, 10), 245.0, 245.0, 245.0, 0.0);
    CHECK(pixel(s, 10, 8)[0] > pixel(s, 10, 8)[2] + 100);   // orange
    CHECK(pixel(s, 10, 12)[2] > pixel(s, 10, 12)[0] + 100); // blue
    CHECK_NEAR(pm_seen_number(s, "beyond"), 1.0, 0.0);
    check_same(pixel(s, 9, 9), pm_seen_scale(s, 0, 1.0), NEAR);
}

static void check_mask(const pm_seen *s)
{
    const int masked[6][2] = {{0, 0}, {3, 8}, {SIDE - 4, 8}, {15, 10}, {14, 9}, {16, 11}};
    for (int i = 0; i < 6; i++) {
        check_same(pixel(s, masked[i][0], masked[i][1]), grey, 0.0);
    }
    CHECK(pixel(s, 13, 10)[0] == 245 && pixel(s, 4, 4)[0] == 245);
    CHECK_CONTAINS(pm_seen_text(s, "note"), "247 pixels compared, 329 left out.");
}

static void colours_tell_the_sign(void)
{
    pm_image wrong = make_wrong();
    pm_image right = make_even(2.0, 4);
    set(&wrong, 9, 9, 6.0);
    right.plane[3][10 * SIDE + 15] = 1.0F;
    pm_seen s = look(&wrong, &right);
    check_colours(&s);
    check_mask(&s);
    check_numbers(&s);
    pm_seen_free(&s);
}

static void halves_are_used_as_compare_does(void)
{
    pm_image wrong = make_wrong();
    pm_image right = make_even(2.0, 10);
    for (int i = 0; i < SIDE * SIDE; i++) {
        for (int c = 0; c < 3; c++) {
            right.plane[4 + c][i] = i % 2 == 0 ? 2.2F : 1.8F;
            right.plane[7 + c][i] = i % 2 == 0 ? 1.8F : 2.2F;
        }
    }
    pm_seen s = look(&wrong, &right);
    check_numbers(&s);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "The reference's own noise is taken out");
    pm_seen_free(&s);
}

static void equal_pictures_are_white(void)
{
    pm_image one = make_even(2.0, 4);
    pm_image two = make_even(2.0, 4);
    pm_seen s = look(&one, &two);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "rel_rmse 0 (rel_mse 0)");
    CHECK_COLOUR(pixel(&s, 12, 12), 245.0, 245.0, 245.0, 0.0);
    pm_seen_free(&s);
}

static void both_pictures_share_the_references_exposure(void)
{
    pm_image dark = make_even(0.25, 4);
    pm_image right = make_even(0.5, 4);
    pm_seen s = look(&dark, &right);
    double stops = pm_seen_number(&s, "exposure");
    const char *const zoom[2] = {"pictures.0.zoom", "pictures.1.zoom"};
    CHECK_NEAR(stops, 0.5, 0.0);
    CHECK(pm_seen_number(&s, zoom[0]) == pm_seen_number(&s, zoom[1]));
    for (int i = 0; i < 2; i++) {
        char key[2][32];
        snprintf(key[0], sizeof key[0], "pictures.%d.at.0", i);
        snprintf(key[1], sizeof key[1], "pictures.%d.at.1", i);
        double light = (i == 0 ? 0.25 : 0.5) * exp2(stops);
        double byte = 255.0 * (1.055 * pow(light, 1.0 / 2.4) - 0.055);
        CHECK_COLOUR(pm_seen_at(&s, (int)pm_seen_number(&s, key[0]) + 5,
                                (int)pm_seen_number(&s, key[1]) + 5),
                     byte, byte, byte, 0.51);
    }
    pm_seen_free(&s);
}

static void check_refused(pm_image *picture, pm_image *reference, const char *words)
{
    const char *a = write_picture("a.exr", picture);
    const char *b = write_picture("b.exr", reference);
    char line[512];
    int files = pm_command_count_files();
    snprintf(line, sizeof line, "view error %s {S} -o {O}", a);
    pm_test_ran ran = pm_command_run(line, b, pm_command_path("o.png"));
    pm_command_check_refusal("view error", &ran, words);
    CHECK(pm_command_count_files() == files);
    pm_test_ran_free(&ran);
}

static void what_cannot_be_compared_is_refused(void)
{
    pm_image one = make_even(1.0, 4);
    pm_image black = make_even(0.0, 4);
    check_refused(&one, &black, "b.exr: the reference is black where it counts");
    pm_image small;
    one = make_even(1.0, 4);
    CHECK_OK(pm_image_make(SIDE, SIDE - 1, names, 4, &small));
    check_refused(&one, &small, "sizes must be equal");
    one = make_even(1.0, 4);
    pm_image two = make_even(1.0, 4);
    two.plane[1][SIDE] = INFINITY;
    check_refused(&one, &two, "b.exr: pixel 0,1 of channel G is inf");
    one = make_even(1.0, 4);
    two = make_even(1.0, 2);
    check_refused(&one, &two, "b.exr: has no channel B, so it is no picture");
}

PM_TESTS({"view_error.1",
          "too bright is orange, too dark blue, lamps and frame grey; numbers are compare's",
          colours_tell_the_sign},
         {"view_error.2", "halves take the reference's noise out, as in compare",
          halves_are_used_as_compare_does},
         {"view_error.3", "equal pictures are white all over", equal_pictures_are_white},
         {"view_error.4", "picture and reference are shown at the reference's exposure",
          both_pictures_share_the_references_exposure},
         {"view_error.5",
          "a black reference, unlike sizes, an infinite pixel, a missing channel are refused",
          what_cannot_be_compared_is_refused})

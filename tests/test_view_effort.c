// `view effort` on channels made here: each pixel has the colour that its value has on the
// scale.
#include "command.h"
#include "exr.h"
#include "seen.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WIDE = 10, HIGH = 8 };

#define NEAR 12.0 // a bar's steps, and its half covered ends

static const uint8_t grey[3] = {84, 88, 98};

/// Radius rises to the right from 0.1 m by 0.05 m, photons fall downwards from 80 by 10; the
/// first row has no estimate.
static pm_image make_picture(void)
{
    static const char *const names[5] = {"R", "G", "B", "gather.radius", "gather.count"};
    pm_image image;
    CHECK_OK(pm_image_make(WIDE, HIGH, names, 5, &image));
    for (int i = 0; i < WIDE * HIGH; i++) {
        bool found = i >= WIDE;
        image.plane[0][i] = image.plane[1][i] = image.plane[2][i] = 0.5F;
        image.plane[3][i] = found ? 0.1F + 0.05F * (float)(i % WIDE) : 0.0F;
        image.plane[4][i] = found ? 80.0F - 10.0F * (float)(i / WIDE) : 0.0F;
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

static pm_seen look(const char *path)
{
    return pm_seen_look("view effort {S} --size 640x480", path, NULL);
}

/// The middle of a pixel of one of the pictures, by the order in which they were laid.
static const uint8_t *pixel(const pm_seen *s, int picture, int x, int y)
{
    char key[64];
    int at[2];
    const int pixel_at[2] = {x, y};
    snprintf(key, sizeof key, "pictures.%d.zoom", picture);
    int zoom = (int)pm_seen_number(s, key);
    for (int i = 0; i < 2; i++) {
        snprintf(key, sizeof key, "pictures.%d.at.%d", picture, i);
        at[i] = (int)pm_seen_number(s, key) + zoom * pixel_at[i] + zoom / 2;
    }
    return pm_seen_at(s, at[0], at[1]);
}

static void check_same(const uint8_t *got, const uint8_t *want, double tolerance)
{
    CHECK_COLOUR(got, (double)want[0], (double)want[1], (double)want[2], tolerance);
}

static void check_maps(const pm_seen *s)
{
    CHECK(strcmp(pm_seen_text(s, "pictures.0.what"), "radius") == 0);
    CHECK(strcmp(pm_seen_text(s, "pictures.1.what"), "count") == 0);
    for (int x = 0; x < WIDE; x++) {
        check_same(pixel(s, 0, x, 3), pm_seen_scale(s, 0, x / (WIDE - 1.0)), NEAR);
    }
    for (int y = 1; y < HIGH; y++) {
        check_same(pixel(s, 1, 4, y), pm_seen_scale(s, 1, (7.0 - y) / 6.0), NEAR);
    }
    for (int map = 0; map < 2; map++) {
        check_same(pixel(s, map, 3, 0), grey, 0.0);
    }
}

static void check_scales(const pm_seen *s)
{
    CHECK_NEAR(pm_seen_number(s, "scales.0.low"), 0.1, 1e-7);
    CHECK_NEAR(pm_seen_number(s, "scales.0.high"), 0.55, 1e-7);
    CHECK_NEAR(pm_seen_number(s, "scales.1.low"), 10.0, 0.0);
    CHECK_NEAR(pm_seen_number(s, "scales.1.high"), 70.0, 0.0);
    CHECK_CONTAINS(pm_seen_text(s, "note"),
                   "70 of 80 pixels have an estimate: radius 0.1 to 0.55 m, mean 0.325 m; "
                   "photons 10 to 70, mean 40.");
}

static void pixels_have_the_scales_colours(void)
{
    int x = 0;
    int y = 0;
    pm_image image = make_picture();
    pm_seen s = look(write_picture("a.exr", &image));
    check_maps(&s);
    check_scales(&s);
    pm_seen_chart(&s, 0, 0.1 + 0.45 / 64.0, 7.0, &x, &y); // seven rows of the first radius
    CHECK(pm_seen_near(&s, x, y, 2, (const uint8_t[3]){86, 180, 233}, 60));
    pm_seen_free(&s);
}

// A pixel that looked and found nothing is dark, not grey: it reached as far as it could.
static void finding_nothing_is_an_estimate(void)
{
    pm_image image = make_picture();
    image.plane[4][2 * WIDE] = 0.0F;
    image.plane[3][3 * WIDE + 2] = 10.0F;
    pm_seen s = look(write_picture("a.exr", &image));
    CHECK_NEAR(pm_seen_number(&s, "scales.1.low"), 0.0, 0.0);
    check_same(pixel(&s, 1, 0, 2), pm_seen_scale(&s, 1, 0.0), NEAR);
    CHECK(json_is_true(pm_seen_member(&s, "scales.0.logarithmic")));
    check_same(pixel(&s, 0, WIDE - 1, 3), pm_seen_scale(&s, 0, log(5.5) / log(100.0)), NEAR);
    pm_seen_free(&s);
}

// As with -r and a large k. A mean of equal radii may be off by the last bit.
static void one_radius_has_no_scale(void)
{
    int x = 0;
    int y = 0;
    pm_image image = make_picture();
    for (int i = WIDE; i < WIDE * HIGH; i++) {
        image.plane[3][i] = i % 2 == 0 ? 0.25F : nextafterf(0.25F, 1.0F);
    }
    pm_seen s = look(write_picture("a.exr", &image));
    CHECK(json_array_size(pm_seen_member(&s, "scales")) == 1);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "radius 0.25 to 0.25 m, mean 0.25 m");
    CHECK_COLOUR(pixel(&s, 0, 2, 2), 253.0, 231.0, 37.0, 0.0); // viridis' bright end
    pm_seen_chart(&s, 0, 10.0 + 60.0 / 64.0, 10.0, &x, &y);    // ten pixels of 10 photons
    CHECK(pm_seen_near(&s, x, y, 2, (const uint8_t[3]){86, 180, 233}, 60));
    pm_seen_free(&s);
}

static void check_refused(const char *path, const char *words)
{
    int files = pm_command_count_files();
    pm_test_ran ran = pm_command_run("view effort {S} -o {O}", path, pm_command_path("o.png"));
    pm_command_check_refusal("view effort", &ran, words);
    CHECK(pm_command_count_files() == files);
    pm_test_ran_free(&ran);
}

static void what_has_no_effort_is_refused(void)
{
    pm_image image = make_picture();
    snprintf(image.name[4], sizeof image.name[4], "gather.other");
    check_refused(write_picture("a.exr", &image), "a.exr: has no channel gather.count; take");
    image = make_picture();
    image.plane[3][WIDE + 1] = -1.0F;
    check_refused(write_picture("b.exr", &image),
                  "b.exr: pixel 1,1 of channel gather.radius is -1, not >= 0");
    image = make_picture();
    memset(image.plane[3], 0, sizeof(float) * WIDE * HIGH);
    check_refused(write_picture("c.exr", &image), "c.exr: no pixel looked into the global map");
}

PM_TESTS({"view_effort.1",
          "pixels have the colours of the scales, which end where the data do, or are grey",
          pixels_have_the_scales_colours},
         {"view_effort.2", "a pixel that found no photon is dark; a wide range is logarithmic",
          finding_nothing_is_an_estimate},
         {"view_effort.3", "one radius everywhere needs no scale, and the chart counts photons",
          one_radius_has_no_scale},
         {"view_effort.4", "a picture without radii, or with none above 0, is refused",
          what_has_no_effort_is_refused})

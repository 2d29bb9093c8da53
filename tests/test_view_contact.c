// Contact sheets: `view contact` without a display, on pictures made here. Where a picture
// stands
// --json says; its pixels are compared with the sRGB curve worked out here, byte for byte.
#include "command.h"
#include "exr.h"
#include "test.h"

#include <jansson.h>
#include <libpng16/png.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 24 };

/// Writes a square picture: red rises to the right, green downwards, blue is flat; all times
/// `gain`.
static const char *write_picture(const char *name, int side, double gain)
{
    static const char *const names[3] = {"R", "G", "B"};
    const char *path = pm_command_path(name);
    pm_image image;
    CHECK_OK(pm_image_make(side, side, names, 3, &image));
    for (int i = 0; i < side * side; i++) {
        image.plane[0][i] = (float)(gain * (i % side) / (side - 1.0));
        image.plane[1][i] = (float)(gain * (double)(i / side) / (side - 1.0));
        image.plane[2][i] = (float)(gain * 0.25);
    }
    CHECK_OK(pm_exr_write(path, &image));
    pm_image_free(&image);
    return path;
}

/// A sheet, and what --json says of it.
typedef struct {
    png_image png;
    png_bytep pixels;
    json_t *answer;
    const json_t *pictures;
} seen;

/// Runs `view contact WORDS -o sheet.png --json`; {S} in the words stands for `first`.
static pm_test_ran run_contact(const char *words, const char *first)
{
    char line[9000];
    snprintf(line, sizeof line, "view contact %s -o {O} --json", words);
    unsetenv("DISPLAY");
    return pm_command_run(line, first, pm_command_path("sheet.png"));
}

static seen look(const char *words, const char *first)
{
    seen s = {.png = {.version = PNG_IMAGE_VERSION}};
    pm_test_ran ran = run_contact(words, first);
    CHECK_THAT(ran.exit_code == 0 && ran.err[0] == '\0', "exit %d: %s", ran.exit_code, ran.err);
    s.answer = json_loads(ran.out, 0, NULL);
    CHECK_THAT(s.answer != NULL, "no JSON: %s", ran.out);
    s.pictures = json_object_get(s.answer, "pictures");
    CHECK(png_image_begin_read_from_file(&s.png, pm_command_path("sheet.png")) != 0);
    s.png.format = PNG_FORMAT_RGB;
    s.pixels = malloc(PNG_IMAGE_SIZE(s.png));
    CHECK(s.pixels != NULL && png_image_finish_read(&s.png, NULL, s.pixels, 0, NULL) != 0);
    pm_test_ran_free(&ran);
    return s;
}

static void forget(seen *s)
{
    json_decref(s->answer);
    free(s->pixels);
}

static const json_t *about(const seen *s, size_t picture, const char *key)
{
    const json_t *value = json_object_get(json_array_get(s->pictures, picture), key);
    CHECK_THAT(value != NULL, "no %s of picture %zu", key, picture);
    return value;
}

static int place(const seen *s, size_t picture, size_t axis)
{
    return (int)json_integer_value(json_array_get(about(s, picture, "at"), axis));
}

/// Byte of linear light in sRGB, by the standard's formula.
static int encode(double linear)
{
    double l = fmin(linear, 1.0);
    double coded = l <= 0.0031308 ? 12.92 * l : 1.055 * pow(l, 1.0 / 2.4) - 0.055;
    return (int)floor(255.0 * coded + 0.5);
}

/// Every pixel of a picture on the sheet is that of write_picture() times `gain`.
static void check_pixels(const seen *s, size_t picture, double gain)
{
    int left = place(s, picture, 0);
    int top = place(s, picture, 1);
    CHECK(left >= 0 && top >= 0 && left + SIDE <= (int)s->png.width);
    CHECK(top + SIDE <= (int)s->png.height);
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double light[3] = {(double)(float)(i % SIDE / (SIDE - 1.0)),
                                 (double)(float)((double)(i / SIDE) / (SIDE - 1.0)), 0.25};
        int at = (top + i / SIDE) * (int)s->png.width + left + i % SIDE;
        for (int c = 0; c < 3; c++) {
            int got = s->pixels[3 * at + c];
            int want = encode(gain * light[c]);
            CHECK_THAT(got == want, "picture %zu, pixel %d,%d, channel %d: %d, not %d", picture,
                       i % SIDE, i / SIDE, c, got, want);
        }
    }
}

// Most pixels of such a picture lie below its gain; at most 0.9 of what can be shown, in half
// stops: gain 1 is shown 0.5 stops darker, gain 4 2.5 stops darker.
static void pictures_are_shown_in_srgb(void)
{
    write_picture("plain.quick.exr", SIDE, 1.0);
    write_picture("plain.good.exr", SIDE, 1.0);
    char words[4096];
    snprintf(words, sizeof words, "%s {S}", pm_command_path("plain.quick.exr"));
    seen s = look(words, pm_command_path("plain.good.exr"));
    double exposure = json_number_value(about(&s, 0, "exposure"));
    CHECK_NEAR(exposure, -0.5, 0.0);
    check_pixels(&s, 0, exp2(exposure));
    check_pixels(&s, 1, exp2(exposure));
    forget(&s);
}

static void scenes_are_exposed_alone(void)
{
    const char *dim = write_picture("dim.a.exr", SIDE, 1.0);
    const char *bright = write_picture("bright.a.exr", SIDE, 64.0);
    char words[4096];
    snprintf(words, sizeof words, "%s {S} --exposure 1", dim);
    seen s = look(words, bright);
    CHECK_NEAR(json_number_value(about(&s, 0, "exposure")), 0.5, 0.0);
    CHECK_NEAR(json_number_value(about(&s, 1, "exposure")), -5.5, 0.0);
    check_pixels(&s, 0, sqrt(2.0));
    check_pixels(&s, 1, sqrt(2.0));
    forget(&s);
}

// A dim and a bright picture of one scene: the bright one sets the exposure of both.
static void a_scene_has_one_exposure(void)
{
    const char *dim = write_picture("one.a.exr", SIDE, 1.0);
    const char *bright = write_picture("one.b.exr", SIDE, 4.0);
    char words[4096];
    snprintf(words, sizeof words, "%s {S}", dim);
    seen s = look(words, bright);
    double exposure = json_number_value(about(&s, 0, "exposure"));
    CHECK_NEAR(exposure, -2.0, 0.5);
    CHECK_NEAR(json_number_value(about(&s, 1, "exposure")), exposure, 0.0);
    check_pixels(&s, 0, exp2(exposure));
    check_pixels(&s, 1, 4.0 * exp2(exposure));
    forget(&s);
}

static void names_and_reports_are_read(void)
{
    const char *path = write_picture("my.scene.good.exr", SIDE, 1.0);
    pm_command_write(
        "my.scene.good.json",
        "{\"settings\": {\"gather\": 64, \"spp\": 4}, \"seconds\": {\"total\": 2.5},"
        " \"maps\": {\"global\": {\"emitted\": 200000},"
        " \"caustic\": {\"emitted\": 5000}}}");
    seen s = look("{S}", path);
    CHECK_CONTAINS(json_string_value(about(&s, 0, "scene")), "my.scene");
    CHECK(strcmp(json_string_value(about(&s, 0, "setting")), "good") == 0);
    CHECK(strcmp(json_string_value(about(&s, 0, "note")), "205k photons, gather 64, 4 spp") ==
          0);
    forget(&s);
    // Of a preset that names stored photons the note tells these, and how they are asked.
    pm_command_write("my.scene.good.json",
                     "{\"settings\": {\"gather\": 0, \"spp\": 4, \"stored\": 500000,"
                     " \"estimate\": {\"k\": 500, \"shape\": \"disc\"}}}");
    s = look("{S}", path);
    CHECK(strcmp(json_string_value(about(&s, 0, "note")), "500k stored, k 500, disc") == 0);
    forget(&s);
}

static bool overlap(const seen *s, size_t a, size_t b)
{
    return abs(place(s, a, 0) - place(s, b, 0)) < SIDE &&
           abs(place(s, a, 1) - place(s, b, 1)) < SIDE;
}

// Five scenes, two pictures each: pairs side by side, nothing over anything else.
static void blocks_do_not_overlap(void)
{
    char words[8192] = "";
    for (int i = 0; i < 10; i++) {
        char name[32];
        snprintf(name, sizeof name, "scene%d.%s.exr", i / 2, i % 2 == 0 ? "quick" : "good");
        size_t used = strlen(words);
        snprintf(words + used, sizeof words - used, "%s ", write_picture(name, SIDE, 1.0));
    }
    seen s = look(words, NULL);
    CHECK(json_array_size(s.pictures) == 10);
    for (size_t a = 0; a < 10; a++) {
        check_pixels(&s, a, exp2(-0.5));
        for (size_t b = 0; b < a; b++) {
            CHECK_THAT(!overlap(&s, a, b), "pictures %zu and %zu overlap", a, b);
        }
        CHECK(a % 2 == 0 || place(&s, a, 1) == place(&s, a - 1, 1));
    }
    forget(&s);
}

/// Pixels of the rows from `first` to `end` that are as bright as letters.
static int count_letters(const seen *s, int first, int end, int left, int right)
{
    int found = 0;
    for (int y = first; y < end; y++) {
        for (int x = left; x < right; x++) {
            found += s->pixels[3 * (y * (int)s->png.width + x) + 1] > 160;
        }
    }
    return found;
}

static void everything_is_labelled(void)
{
    seen s = look("{S}", write_picture("cave.good.exr", SIDE, 1.0));
    int left = place(&s, 0, 0);
    int top = place(&s, 0, 1);
    CHECK(count_letters(&s, top - 32, top, left, left + 60) > 40);               // cave
    CHECK(count_letters(&s, top + SIDE, top + SIDE + 24, left, left + 60) > 25); // good
    CHECK(count_letters(&s, 20, 60, left, left + 200) > 200);                    // title
    CHECK(count_letters(&s, top, top + SIDE, left + 100, left + 300) == 0);
    forget(&s);
}

static void check_refused(const char *words, const char *first, const char *part)
{
    pm_test_ran ran = run_contact(words, first);
    int files = pm_command_count_files();
    pm_command_check_refusal(words, &ran, part);
    pm_test_ran_free(&ran);
    CHECK(pm_command_count_files() == files);
    CHECK(fopen(pm_command_path("sheet.png"), "rb") == NULL);
}

static void what_is_no_picture_is_refused(void)
{
    const char *good = write_picture("a.exr", SIDE, 1.0);
    char words[4096];
    snprintf(words, sizeof words, "%s {S}", good);
    check_refused(words, pm_command_path("none.exr"), "none.exr: cannot be read");
    check_refused(words, pm_command_write("text.exr", "no picture\n"), "text.exr: ");
    check_refused(words, write_picture("b.exr", SIDE + 1, 1.0), "b.exr: 25x25 pixels, but ");
    check_refused(words, write_picture("nan.exr", SIDE, (double)NAN), "is NaN");
    pm_command_write("c.json", "{");
    check_refused(words, write_picture("c.exr", SIDE, 1.0), "c.json: is no report of render");
}

static void every_fault_has_its_line(void)
{
    char words[4096];
    snprintf(words, sizeof words, "%s %s {S}", pm_command_path("gone1.exr"),
             write_picture("a.exr", SIDE, 1.0));
    pm_test_ran ran = run_contact(words, pm_command_path("gone2.exr"));
    pm_command_check_refusal(words, &ran, "gone1.exr: cannot be read");
    pm_command_check_refusal(words, &ran, "gone2.exr: cannot be read");
    pm_test_ran_free(&ran);
}

static void a_picture_needs_colour(void)
{
    static const char *const names[1] = {"depth.Z"};
    const char *path = pm_command_path("depth.exr");
    pm_image image;
    CHECK_OK(pm_image_make(SIDE, SIDE, names, 1, &image));
    CHECK_OK(pm_exr_write(path, &image));
    pm_image_free(&image);
    check_refused("{S}", path, "depth.exr: has no channel R, so it is no picture");
}

static void settings_that_mean_nothing_are_refused(void)
{
    const char *path = write_picture("a.exr", SIDE, 1.0);
    check_refused("{S} --size 300x300", path, "contact takes no --size");
    check_refused("{S} --scene scenes/cornell-diffuse.xml", path, "unknown option --scene");
}

PM_TESTS({"view_contact.1", "pictures stand on a sheet pixel for pixel, in sRGB",
          pictures_are_shown_in_srgb},
         {"view_contact.2", "each scene has its own exposure, to which --exposure adds",
          scenes_are_exposed_alone},
         {"view_contact.3", "pictures of one scene share an exposure",
          a_scene_has_one_exposure},
         {"view_contact.4", "scene, setting and note come from the file's name and its report",
          names_and_reports_are_read},
         {"view_contact.5", "pictures of a scene stand side by side, and none over another",
          blocks_do_not_overlap},
         {"view_contact.6", "sheet, scene and picture carry words", everything_is_labelled},
         {"view_contact.7",
          "a missing file, one that is no picture, an unlike size are refused",
          what_is_no_picture_is_refused},
         {"view_contact.8", "each of two missing files has its line", every_fault_has_its_line},
         {"view_contact.9", "an EXR without R G B is no picture", a_picture_needs_colour},
         {"view_contact.10", "a sheet takes neither --size nor --scene",
          settings_that_mean_nothing_are_refused})

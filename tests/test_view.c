// Pictures say what is so: the program `view` runs without a display on small data made here,
// and the pixels where something must be seen are looked up with the camera that --json prints,
// by the pinhole formula of viewpoint.h, not by VTK.
#include "balance.h"
#include "photon_file.h"
#include "photon_map.h"
#include "scene_read.h"
#include "store.h"
#include "test.h"

#include <jansson.h>
#include <libpng16/png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// A unit room of two walls around (5, 5, 5), so that coordinates are not centred by themselves;
// the camera looks along -z. Nothing stands in the middle.
static const char scene_text[] =
    "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>"
    "<transform name=\"to_world\"><lookat origin=\"5,5,8\" target=\"5,5,5\" up=\"0,1,0\"/>"
    "</transform></sensor>"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.5\"/>"
    "<translate x=\"5\" y=\"5\" z=\"4.5\"/></transform></shape>"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.5\"/>"
    "<rotate x=\"1\" angle=\"-90\"/><translate x=\"5\" y=\"4.5\" z=\"5\"/></transform></shape>"
    "<emitter type=\"point\"><point name=\"position\" x=\"5\" y=\"5.5\" z=\"5.5\"/>"
    "<rgb name=\"intensity\" value=\"1, 1, 1\"/></emitter></scene>";

#define PATH_MAX_LENGTH 1200

/// A picture, read back.
typedef struct {
    png_image png;
    uint8_t *pixels; // RGB, rows from the top
    json_t *answer;
    json_t *camera; // of `answer`
    char note[512];
} seen;

/// A path of a file in this test's folder, in one of eight buffers that take turns.
static const char *at(const char *name)
{
    static char paths[8][PATH_MAX_LENGTH];
    static int turn;
    char *path = paths[turn++ % 8];
    snprintf(path, PATH_MAX_LENGTH, "%s/%s", pm_test_folder(), name);
    return path;
}

static const char *write_text(const char *name, const char *text)
{
    const char *path = at(name);
    FILE *file = fopen(path, "w");
    CHECK(file != NULL && fputs(text, file) >= 0 && fclose(file) == 0);
    return path;
}

static const char *scene_file(void)
{
    return write_text("scene.xml", scene_text);
}

/// Runs `view KIND FILE --scene SCENE -o out.png --size 640x480 --json` and one option more.
static pm_test_ran run_view(const char *kind, const char *file, const char *option)
{
    const char *argv[] = {
        pm_test_program("view"), kind,     file,      "--scene", scene_file(), "-o",
        at("out.png"),           "--size", "640x480", "--json",  option,       NULL};
    unsetenv("DISPLAY");
    return pm_test_run(argv, 60.0);
}

static seen look(const char *kind, const char *file, const char *option)
{
    seen s;
    memset(&s, 0, sizeof s);
    pm_test_ran ran = run_view(kind, file, option);
    CHECK_THAT(ran.exit_code == 0, "view %s: exit %d: %s", kind, ran.exit_code, ran.err);
    CHECK_THAT(ran.err[0] == '\0', "view %s says on standard error: %s", kind, ran.err);
    s.answer = json_loads(ran.out, 0, NULL);
    CHECK_THAT(s.answer != NULL, "no JSON: %s", ran.out);
    s.camera = json_object_get(s.answer, "camera");
    snprintf(s.note, sizeof s.note, "%s", json_string_value(json_object_get(s.answer, "note")));
    s.png.version = PNG_IMAGE_VERSION;
    CHECK(png_image_begin_read_from_file(&s.png, at("out.png")) != 0);
    s.png.format = PNG_FORMAT_RGB;
    CHECK(s.png.width == 640 && s.png.height == 480);
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

static double number(const json_t *camera, const char *key, size_t index)
{
    return json_number_value(json_array_get(json_object_get(camera, key), index));
}

static double along(const json_t *camera, const char *axis, pm_vec3 to)
{
    return to.x * number(camera, axis, 0) + to.y * number(camera, axis, 1) +
           to.z * number(camera, axis, 2);
}

/// The pixel at a point in the scene file's coordinates.
static const uint8_t *pixel(const seen *s, pm_vec3 point)
{
    pm_vec3 eye = pm_vec(number(s->camera, "position", 0), number(s->camera, "position", 1),
                         number(s->camera, "position", 2));
    pm_vec3 to = pm_vec_sub(point, eye);
    double depth = along(s->camera, "forward", to);
    double x = along(s->camera, "right", to) / (depth * number(s->camera, "tan", 0)) -
               number(s->camera, "shift", 0);
    double y = along(s->camera, "up", to) / (depth * number(s->camera, "tan", 1)) -
               number(s->camera, "shift", 1);
    CHECK_THAT(fabs(x) < 1.0 && fabs(y) < 1.0, "the point is not in the picture: %g, %g", x, y);
    size_t column = (size_t)((1.0 + x) * 0.5 * 640.0);
    size_t row = (size_t)((1.0 - y) * 0.5 * 480.0);
    return s->pixels + 3 * (row * 640 + column);
}

#define CHECK_COLOUR(got, red, green, blue, tolerance)                                         \
    do {                                                                                       \
        const uint8_t *rgb = (got);                                                            \
        CHECK_NEAR((double)rgb[0], red, tolerance);                                            \
        CHECK_NEAR((double)rgb[1], green, tolerance);                                          \
        CHECK_NEAR((double)rgb[2], blue, tolerance);                                           \
    } while (0)

/// A map of photons at these places (file coordinates), all of the same power, in a file.
static const char *write_map(const char *name, const pm_vec3 *places, int count,
                             pm_spectrum power, bool balanced)
{
    pm_scene scene;
    CHECK_OK(pm_scene_read(scene_file(), NULL, 0, false, &scene));
    pm_photon_map map = {.kind = PM_MAP_GLOBAL};
    for (int i = 0; i < count; i++) {
        pm_deposit deposit = {.position = pm_vec_sub(places[i], scene.center),
                              .direction = pm_vec(0.0, 0.0, -1.0),
                              .normal = pm_vec(0.0, 0.0, 1.0),
                              .power = power};
        CHECK_OK(pm_store_push(&map, &deposit));
    }
    CHECK_OK(pm_store_scale(&map, 1234));
    if (balanced) {
        CHECK_OK(pm_balance_build(&map));
    }
    pm_photon_file_info info = {.scene_hash = scene.hash, .center = scene.center};
    const char *path = at(name);
    CHECK_OK(pm_photon_file_write(path, &map, &info, NULL));
    pm_photon_map_free(&map);
    pm_scene_free(&scene);
    return path;
}

static void photon_lights_its_pixel(void)
{
    const pm_vec3 place[] = {{5.2, 5.3, 4.6}};
    const pm_vec3 elsewhere[] = {{4.8, 4.9, 4.7}};
    seen here =
        look("photons", write_map("a.ply", place, 1, pm_rgb(1.0, 0.0, 0.0), true), NULL);
    seen there =
        look("photons", write_map("b.ply", elsewhere, 1, pm_rgb(1.0, 0.0, 0.0), true), NULL);
    CHECK_COLOUR(pixel(&here, place[0]), 255.0, 0.0, 0.0, 2.0);
    CHECK_COLOUR(pixel(&there, elsewhere[0]), 255.0, 0.0, 0.0, 2.0);
    CHECK(pixel(&there, place[0])[0] < 100);
    CHECK(pixel(&here, elsewhere[0])[0] < 100);
    forget(&here);
    forget(&there);
}

static void counts_are_the_files(void)
{
    const pm_vec3 places[] = {{5.2, 5.3, 4.6}, {4.8, 5.1, 4.7}, {4.9, 4.7, 5.1}};
    seen s = look("photons", write_map("a.ply", places, 3, pm_gray(1.0), true), NULL);
    CHECK_CONTAINS(s.note, "global map: 3 stored of 1,234 emitted");
    seen none = look("photons", write_map("none.ply", places, 0, pm_gray(1.0), false), NULL);
    CHECK_CONTAINS(none.note, "global map: 0 stored of 1,234 emitted");
    forget(&s);
    forget(&none);
}

/// Five photons whose box is longest in y. A left-balanced tree of five has three on the left
/// of its root, so the first split goes through the fourth from below: y = 4.6.
static const pm_vec3 tall[] = {
    {4.8, 4.5, 4.8}, {5.2, 4.6, 5.2}, {4.9, 4.55, 5.0}, {5.2, 5.4, 4.8}, {4.8, 4.52, 5.2}};

static void split_plane_is_seen(void)
{
    const pm_vec3 on_plane = {5.05, 4.6, 5.0};
    const char *map = write_map("tree.ply", tall, 5, pm_gray(1.0), true);
    seen tree = look("tree", map, "--depth=1");
    seen photons = look("photons", map, NULL);
    const uint8_t *with = pixel(&tree, on_plane);
    const uint8_t *without = pixel(&photons, on_plane);
    CHECK_CONTAINS(tree.note, "5 photons, tree 3 deep; the first 1 depths: 1 planes");
    // Okabe-Ito green over the background with opacity 0.33 adds that share of the difference.
    const double green[3] = {0.0, 158.0, 115.0};
    for (int c = 0; c < 3; c++) {
        CHECK_NEAR((double)with[c], 0.67 * without[c] + 0.33 * green[c], 12.0);
    }
    CHECK_THAT(with[1] > without[1] + 25,
               "green %d with the plane, %d without: the translucent "
               "plane is not drawn",
               with[1], without[1]);
    forget(&tree);
    forget(&photons);
}

static void tree_needs_balance(void)
{
    pm_test_ran ran =
        run_view("tree", write_map("flat.ply", tall, 5, pm_gray(1.0), false), NULL);
    CHECK(ran.exit_code == 2);
    CHECK_CONTAINS(ran.err, "flat.ply: this map is not balanced");
    pm_test_ran_free(&ran);
}

static void paths_have_the_colour_of_their_event(void)
{
    const char *csv = write_text("paths.csv", "photon,step,event,x,y,z,r,g,b\n"
                                              "0,0,L,4.6,5.4,5,1,1,1\n"
                                              "0,1,D,5.3,5.4,5,1,1,1\n"
                                              "0,2,S,5.3,4.7,5,1,1,1\n"
                                              "0,3,A,4.6,4.7,5,0,0,0\n"
                                              "7,0,L,4.6,5.2,5,1,1,1\n"
                                              "7,1,E,5.2,5.2,5,1,1,1\n");
    seen s = look("paths", csv, NULL);
    CHECK_CONTAINS(s.note, "2 of 2 paths drawn");
    const uint8_t *yellow = pixel(&s, pm_vec(4.95, 5.4, 5.0));
    const uint8_t *orange = pixel(&s, pm_vec(5.3, 5.05, 5.0));
    const uint8_t *sky = pixel(&s, pm_vec(4.95, 4.7, 5.0));
    CHECK_THAT(yellow[0] > 110 && yellow[1] > 100 && yellow[2] < yellow[1] - 40,
               "no yellow: %d %d %d", yellow[0], yellow[1], yellow[2]);
    CHECK_THAT(orange[0] > orange[1] + 20 && orange[1] > orange[2] + 20, "no orange: %d %d %d",
               orange[0], orange[1], orange[2]);
    CHECK_THAT(sky[2] > sky[1] + 15 && sky[1] > sky[0] + 20, "no blue: %d %d %d", sky[0],
               sky[1], sky[2]);
    seen one = look("paths", csv, "--paths=1");
    CHECK_CONTAINS(one.note, "1 of 2 paths drawn");
    forget(&s);
    forget(&one);
}

/// Irradiance 0, 1, 10 and 100 in the four corners of a grid in front of the back wall.
static void irradiance_has_the_colour_of_its_value(void)
{
    char text[8192] = "i,j,x,y,z,nx,ny,nz,r,g,b,radius,found\n";
    for (int j = 0; j < 10; j++) {
        for (int i = 0; i < 10; i++) {
            const double value[2][2] = {{0.0, 1.0}, {10.0, 100.0}};
            double e = value[j / 5][i / 5];
            char row[128];
            snprintf(row, sizeof row, "%d,%d,%g,%g,4.6,0,0,1,%g,%g,%g,0.1,%d\n", i, j,
                     4.6 + i / 11.25, 4.6 + j / 11.25, e, e, e, e > 0.0 ? 50 : 0);
            strcat(text, row);
        }
    }
    seen s = look("irradiance", write_text("grid.csv", text), NULL);
    CHECK_CONTAINS(s.note, "10 x 10 points");
    CHECK_COLOUR(pixel(&s, pm_vec(4.75, 4.75, 4.6)), 70.0, 74.0, 84.0, 3.0);
    CHECK_COLOUR(pixel(&s, pm_vec(5.25, 4.75, 4.6)), 0.0, 0.0, 4.0, 3.0);
    CHECK_COLOUR(pixel(&s, pm_vec(4.75, 5.25, 4.6)), 188.0, 55.0, 84.0, 3.0);
    CHECK_COLOUR(pixel(&s, pm_vec(5.25, 5.25, 4.6)), 252.0, 255.0, 164.0, 3.0);
    forget(&s);
}

static void check_refused(const char *kind, const char *file, const char *part)
{
    pm_test_ran ran = run_view(kind, file, NULL);
    CHECK_THAT(ran.exit_code == 2, "%s: exit %d, not 2: %s", part, ran.exit_code, ran.err);
    CHECK_CONTAINS(ran.err, part);
    CHECK_THAT(strchr(ran.err, '\n') == ran.err + strlen(ran.err) - 1, "not one line: %s",
               ran.err);
    struct stat there;
    CHECK_THAT(stat(at("out.png"), &there) != 0, "%s: a picture was left behind", part);
    pm_test_ran_free(&ran);
}

#define PATHS "photon,step,event,x,y,z,r,g,b\n0,0,L,5,5,5,1,1,1\n"
#define GRID "i,j,x,y,z,nx,ny,nz,r,g,b,radius,found\n"

static void bad_data_is_refused(void)
{
    static const struct {
        const char *kind, *text, *part;
    } bad[] = {
        {"paths", "", "x.csv:1: the file is empty"},
        {"paths", "photon,step\n", "x.csv:1: the header must be"},
        {"paths", "photon,step,event,x,y,z,r,g,b\n", "x.csv:2: the file holds no path"},
        {"paths", PATHS "0,1,D,5,5,5,1,1\n", "x.csv:3: a row has 9 fields, got 8"},
        {"paths", PATHS "0,1,D,5,5,5,1,1,1x\n", "x.csv:3: b must be a finite number"},
        {"paths", PATHS "0,1,D,nan,5,5,1,1,1\n", "x.csv:3: x must be a finite number"},
        {"paths", PATHS "0,1,D,5,500,5,1,1,1\n", "x.csv:3: the point 5,500,5 lies far outside"},
        {"paths", PATHS "0,1,D,5,5,5,-1,1,1\n", "x.csv:3: r must be >= 0"},
        {"paths", PATHS "0,1,Q,5,5,5,1,1,1\n", "x.csv:3: event must be one of"},
        {"paths", PATHS "0,2,D,5,5,5,1,1,1\n", "x.csv:3: photon 0 step 2 does not follow"},
        {"paths", PATHS "1,1,D,5,5,5,1,1,1\n", "x.csv:3: photon 1 step 1 does not follow"},
        {"paths", PATHS "0,1,A,5,5,5,1,1,1", "x.csv:3: the file ends in the middle"},
        {"irradiance", GRID "0,0,5,5,5,0,1,0,1,1,1,1,9\n", "x.csv:3: a grid has at least"},
        {"irradiance", GRID "1,0,5,5,5,0,1,0,1,1,1,1,9\n", "x.csv:2: the next grid point is"},
        {"irradiance", GRID "0,0,5,5,5,0,1,0,1,1,-1,1,9\n", "x.csv:2: b must be >= 0"},
        {"irradiance", GRID "0,0,5,5,5,0,1,0,1,1,1,1,-9\n", "x.csv:2: found must be a whole"},
        {"photons", "ply\nformat ascii 1.0\n", "x.csv"},
        {"tree", "solid\n", "x.csv"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        check_refused(bad[i].kind, write_text("x.csv", bad[i].text), bad[i].part);
    }
}

static void bad_usage_is_refused(void)
{
    const char *csv = write_text("paths.csv", PATHS);
    check_refused("pathes", csv, "KIND must be photons, paths, tree, irradiance or contact");
    check_refused("paths", at("missing.csv"), "missing.csv: cannot open");
    check_refused("paths", pm_test_folder(), "cannot read");
    check_refused("photons", at("missing.ply"), "missing.ply");
    static const struct {
        const char *option, *part;
    } bad[] = {{"--depth=0", "--depth must be a whole number from 1 to 16"},
               {"--paths=-3", "--paths must be a whole number"},
               {"--scene", "--scene needs a value"},
               {"--size=20x20", "--size"},
               {"--output=x", "--output"}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        pm_test_ran ran = run_view("paths", csv, bad[i].option);
        CHECK(ran.exit_code == 2);
        CHECK_CONTAINS(ran.err, bad[i].part);
        pm_test_ran_free(&ran);
    }
}

static void photons_of_another_scene_are_refused(void)
{
    const char *map = write_map("other.ply", tall, 5, pm_gray(1.0), true);
    char scene[sizeof scene_text];
    memcpy(scene, scene_text, sizeof scene);
    strstr(scene, "1, 1, 1")[6] = '2';
    const char *argv[] = {pm_test_program("view"),          "photons", map,           "--scene",
                          write_text("changed.xml", scene), "-o",      at("out.png"), NULL};
    pm_test_ran ran = pm_test_run(argv, 60.0);
    CHECK(ran.exit_code == 2);
    CHECK_CONTAINS(ran.err, "other.ply: these photons were traced in another scene");
    pm_test_ran_free(&ran);
}

static void no_display_is_needed(void)
{
    const char *csv = write_text("paths.csv", PATHS "0,1,A,5.2,5.2,5,0,0,0\n");
    seen without = look("paths", csv, NULL);
    const char *argv[] = {
        pm_test_program("view"), "paths",  csv,       "--scene", scene_file(), "-o",
        at("dead.png"),          "--size", "640x480", NULL};
    setenv("DISPLAY", ":99", 1);
    pm_test_ran ran = pm_test_run(argv, 60.0);
    CHECK_THAT(ran.exit_code == 0 && ran.err[0] == '\0', "exit %d: %s", ran.exit_code, ran.err);
    png_image dead = {.version = PNG_IMAGE_VERSION};
    CHECK(png_image_begin_read_from_file(&dead, at("dead.png")) != 0);
    dead.format = PNG_FORMAT_RGB;
    CHECK(PNG_IMAGE_SIZE(dead) == PNG_IMAGE_SIZE(without.png));
    uint8_t *pixels = malloc(PNG_IMAGE_SIZE(dead));
    CHECK(pixels != NULL && png_image_finish_read(&dead, NULL, pixels, 0, NULL) != 0);
    CHECK(memcmp(pixels, without.pixels, PNG_IMAGE_SIZE(dead)) == 0);
    free(pixels);
    pm_test_ran_free(&ran);
    forget(&without);
}

PM_TESTS({"view.1", "a photon lights its own pixel, in its colour", photon_lights_its_pixel},
         {"view.2", "the counts under a title are the file's", counts_are_the_files},
         {"view.3", "a translucent split plane is seen where it must be", split_plane_is_seen},
         {"view.4", "a map that is not balanced has no tree to draw", tree_needs_balance},
         {"view.5", "a stretch of a path has the colour of the event it starts from",
          paths_have_the_colour_of_their_event},
         {"view.6", "irradiance has the colour of its value, and 0 is off the scale",
          irradiance_has_the_colour_of_its_value},
         {"view.7", "bad data is refused with file and line, and leaves no picture",
          bad_data_is_refused},
         {"view.8", "bad usage is refused with the option's name", bad_usage_is_refused},
         {"view.9", "photons of another scene are refused",
          photons_of_another_scene_are_refused},
         {"view.10", "pictures are the same without a display and with a dead one",
          no_display_is_needed})

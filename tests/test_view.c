// Pictures say what is so: the program `view` runs without a display on small data made here,
// and the pixels where something must be seen are looked up.
#include "command.h"
#include "room.h"
#include "seen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// The line of a view of {S} in the room, {O}, with one option more.
static const char *line(const char *kind, const char *option)
{
    static char text[256];
    snprintf(text, sizeof text, "view %s {S} --scene {O} --size 640x480 %s", kind,
             option != NULL ? option : "");
    return text;
}

static pm_seen look(const char *kind, const char *file, const char *option)
{
    return pm_seen_look(line(kind, option), file, pm_room_scene());
}

/// As look(), but whatever comes of it.
static pm_test_ran run_view(const char *kind, const char *file, const char *option)
{
    char whole[512];
    snprintf(whole, sizeof whole, "%s -o %s %s", line(kind, NULL), pm_command_path("out.png"),
             option != NULL ? option : "");
    return pm_command_run(whole, file, pm_room_scene());
}

static const uint8_t *pixel(const pm_seen *s, pm_vec3 point)
{
    return pm_seen_pixel(s, 0, point);
}

static void photon_lights_its_pixel(void)
{
    const pm_vec3 place[] = {{5.2, 5.3, 4.6}};
    const pm_vec3 elsewhere[] = {{4.8, 4.9, 4.7}};
    pm_seen here =
        look("photons", pm_room_map("a.ply", place, 1, pm_rgb(1.0, 0.0, 0.0), true), NULL);
    pm_seen there =
        look("photons", pm_room_map("b.ply", elsewhere, 1, pm_rgb(1.0, 0.0, 0.0), true), NULL);
    CHECK_COLOUR(pixel(&here, place[0]), 255.0, 0.0, 0.0, 2.0);
    CHECK_COLOUR(pixel(&there, elsewhere[0]), 255.0, 0.0, 0.0, 2.0);
    CHECK(pixel(&there, place[0])[0] < 100);
    CHECK(pixel(&here, elsewhere[0])[0] < 100);
    pm_seen_free(&here);
    pm_seen_free(&there);
}

static void counts_are_the_files(void)
{
    const pm_vec3 places[] = {{5.2, 5.3, 4.6}, {4.8, 5.1, 4.7}, {4.9, 4.7, 5.1}};
    pm_seen s = look("photons", pm_room_map("a.ply", places, 3, pm_gray(1.0), true), NULL);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "global map: 3 stored of 1,234 emitted");
    pm_seen none =
        look("photons", pm_room_map("none.ply", places, 0, pm_gray(1.0), false), NULL);
    CHECK_CONTAINS(pm_seen_text(&none, "note"), "global map: 0 stored of 1,234 emitted");
    pm_seen_free(&s);
    pm_seen_free(&none);
}

/// Five photons whose box is longest in y. A left-balanced tree of five has three on the left
/// of its root, so the first split goes through the fourth from below: y = 4.6.
static const pm_vec3 tall[] = {
    {4.8, 4.5, 4.8}, {5.2, 4.6, 5.2}, {4.9, 4.55, 5.0}, {5.2, 5.4, 4.8}, {4.8, 4.52, 5.2}};

static void split_plane_is_seen(void)
{
    const pm_vec3 on_plane = {5.05, 4.6, 5.0};
    const char *map = pm_room_map("tree.ply", tall, 5, pm_gray(1.0), true);
    pm_seen tree = look("tree", map, "--depth=1");
    pm_seen photons = look("photons", map, NULL);
    const uint8_t *with = pixel(&tree, on_plane);
    const uint8_t *without = pixel(&photons, on_plane);
    CHECK_CONTAINS(pm_seen_text(&tree, "note"),
                   "5 photons, tree of height 2; planes down to depth 0: 1");
    // Okabe-Ito green over the background with opacity 0.33 adds that share of the difference.
    const double green[3] = {0.0, 158.0, 115.0};
    for (int c = 0; c < 3; c++) {
        CHECK_NEAR((double)with[c], 0.67 * without[c] + 0.33 * green[c], 12.0);
    }
    CHECK_THAT(with[1] > without[1] + 25,
               "green %d with the plane, %d without: the translucent "
               "plane is not drawn",
               with[1], without[1]);
    pm_seen_free(&tree);
    pm_seen_free(&photons);
}

static void tree_needs_balance(void)
{
    pm_test_ran ran =
        run_view("tree", pm_room_map("flat.ply", tall, 5, pm_gray(1.0), false), NULL);
    CHECK(ran.exit_code == 2);
    CHECK_CONTAINS(ran.err, "flat.ply: this map is not balanced");
    pm_test_ran_free(&ran);
}

static void paths_have_the_colour_of_their_event(void)
{
    const char *csv = pm_command_write("paths.csv", "photon,step,event,x,y,z,r,g,b\n"
                                                    "0,0,L,4.6,5.4,5,1,1,1\n"
                                                    "0,1,D,5.3,5.4,5,1,1,1\n"
                                                    "0,2,S,5.3,4.7,5,1,1,1\n"
                                                    "0,3,A,4.6,4.7,5,0,0,0\n"
                                                    "7,0,L,4.6,5.2,5,1,1,1\n"
                                                    "7,1,E,5.2,5.2,5,1,1,1\n");
    pm_seen s = look("paths", csv, NULL);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "2 of 2 paths drawn");
    const uint8_t *yellow = pixel(&s, pm_vec(4.95, 5.4, 5.0));
    const uint8_t *orange = pixel(&s, pm_vec(5.3, 5.05, 5.0));
    const uint8_t *sky = pixel(&s, pm_vec(4.95, 4.7, 5.0));
    CHECK_THAT(yellow[0] > 110 && yellow[1] > 100 && yellow[2] < yellow[1] - 40,
               "no yellow: %d %d %d", yellow[0], yellow[1], yellow[2]);
    CHECK_THAT(orange[0] > orange[1] + 20 && orange[1] > orange[2] + 20, "no orange: %d %d %d",
               orange[0], orange[1], orange[2]);
    CHECK_THAT(sky[2] > sky[1] + 15 && sky[1] > sky[0] + 20, "no blue: %d %d %d", sky[0],
               sky[1], sky[2]);
    pm_seen one = look("paths", csv, "--paths=1");
    CHECK_CONTAINS(pm_seen_text(&one, "note"), "1 of 2 paths drawn");
    pm_seen_free(&s);
    pm_seen_free(&one);
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
    pm_seen s = look("irradiance", pm_command_write("grid.csv", text), NULL);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "10 x 10 points");
    CHECK_COLOUR(pixel(&s, pm_vec(4.75, 4.75, 4.6)), 70.0, 74.0, 84.0, 3.0);
    CHECK_COLOUR(pixel(&s, pm_vec(5.25, 4.75, 4.6)), 0.0, 0.0, 4.0, 3.0);
    CHECK_COLOUR(pixel(&s, pm_vec(4.75, 5.25, 4.6)), 188.0, 55.0, 84.0, 3.0);
    CHECK_COLOUR(pixel(&s, pm_vec(5.25, 5.25, 4.6)), 252.0, 255.0, 164.0, 3.0);
    pm_seen_free(&s);
}

static void check_refused(const char *kind, const char *file, const char *part)
{
    pm_test_ran ran = run_view(kind, file, NULL);
    CHECK_THAT(ran.exit_code == 2, "%s: exit %d, not 2: %s", part, ran.exit_code, ran.err);
    CHECK_CONTAINS(ran.err, part);
    CHECK_THAT(strchr(ran.err, '\n') == ran.err + strlen(ran.err) - 1, "not one line: %s",
               ran.err);
    struct stat there;
    CHECK_THAT(stat(pm_command_path("out.png"), &there) != 0, "%s: a picture was left behind",
               part);
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
        check_refused(bad[i].kind, pm_command_write("x.csv", bad[i].text), bad[i].part);
    }
}

static void bad_usage_is_refused(void)
{
    const char *csv = pm_command_write("paths.csv", PATHS);
    check_refused("pathes", csv, "there is no kind \"pathes\"; the nearest is paths");
    check_refused("paths", pm_command_path("missing.csv"), "missing.csv: cannot open");
    check_refused("paths", pm_test_folder(), "cannot read");
    check_refused("photons", pm_command_path("missing.ply"), "missing.ply");
    static const struct {
        const char *option, *part;
    } bad[] = {{"--depth=3", "unknown option --depth; the nearest known one is --paths"},
               {"--paths=-3", "--paths must be a whole number"},
               {"--title", "--title needs a value"},
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
    const char *map = pm_room_map("other.ply", tall, 5, pm_gray(1.0), true);
    pm_test_ran ran = pm_command_run("view photons {S} --scene {O} -o x.png", map,
                                     "scenes/cornell-diffuse.xml");
    pm_command_check_refusal("photons", &ran,
                             "other.ply: these photons were traced in another scene");
    pm_test_ran_free(&ran);
}

static void no_display_is_needed(void)
{
    const char *csv = pm_command_write("paths.csv", PATHS "0,1,A,5.2,5.2,5,0,0,0\n");
    pm_seen without = look("paths", csv, NULL);
    setenv("DISPLAY", ":99", 1);
    pm_test_ran ran = run_view("paths", csv, NULL);
    CHECK_THAT(ran.exit_code == 0 && ran.err[0] == '\0', "exit %d: %s", ran.exit_code, ran.err);
    pm_seen dead = pm_seen_read(pm_command_path("out.png"));
    CHECK(dead.width == without.width && dead.height == without.height);
    size_t size = 3 * (size_t)dead.width * (size_t)dead.height;
    CHECK(memcmp(dead.pixels, without.pixels, size) == 0);
    pm_test_ran_free(&ran);
    pm_seen_free(&dead);
    pm_seen_free(&without);
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

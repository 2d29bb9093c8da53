// Pictures of a caustic's edge: a grid put by hand in front of the room's back wall, in the
// colours of its values; and filtering's grid against that of radiance.
#include "command.h"
#include "edge_file.h"
#include "room.h"
#include "scene_read.h"
#include "seen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define HEADER                                                                                 \
    "i,j,x,y,z,none,cone,gaussian,epanechnikov,none-lecture,cone-lecture,gaussian-lecture,"    \
    "epanechnikov-lecture,differential\n"
#define VALUES ",1,1,1,1,1,1,1,1,1\n"
#define SIDE 6 // points of the grid, 0.1 m apart

/// A step at x = 5: kernel number m has 1 on its left and m + 2 on its right; differential
/// checking has 50.
static const char *write_grid(const char *name, double factor)
{
    char text[8192];
    int used = snprintf(text, sizeof text, "%s", HEADER);
    for (int n = 0; n < SIDE * SIDE; n++) {
        int i = n % SIDE;
        int j = n / SIDE;
        used += snprintf(text + used, sizeof text - (size_t)used, "%d,%d,%g,%g,4.5", i, j,
                         4.75 + 0.1 * i, 4.75 + 0.1 * j);
        for (int m = 0; m < 9; m++) {
            double right = m == 8 ? 50.0 : m + 2.0;
            used += snprintf(text + used, sizeof text - (size_t)used, ",%g",
                             factor * (i < SIDE / 2 ? 1.0 : right));
        }
        used += snprintf(text + used, sizeof text - (size_t)used, "\n");
    }
    return pm_command_write(name, text);
}

static pm_seen look(const char *more)
{
    char line[512];
    snprintf(line, sizeof line, "view edge {S} %s --scene {O} --size 640x480", more);
    return pm_seen_look(line, write_grid("e.csv", 1.0), pm_room_scene());
}

/// A point of the map that the cut's line does not hide.
static const uint8_t *pixel(const pm_seen *seen, int map, double x)
{
    return pm_seen_pixel(seen, map, pm_vec(x, 4.87, 4.5));
}

static void check_value(const pm_seen *seen, int map, double x, double value)
{
    double low = pm_seen_number(seen, "scales.0.low");
    double high = pm_seen_number(seen, "scales.0.high");
    const uint8_t *want = pm_seen_scale(seen, 0, log(value / low) / log(high / low));
    CHECK_COLOUR(pixel(seen, map, x), (double)want[0], (double)want[1], (double)want[2], 14.0);
}

static void maps_have_the_colours_of_their_values(void)
{
    pm_seen s = look("");
    CHECK_NEAR(pm_seen_number(&s, "scales.0.low"), 1.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "scales.0.high"), 5.0, 0.0); // of Epanechnikov
    for (int map = 0; map < 4; map++) {
        check_value(&s, map, 4.85, 1.0);
        check_value(&s, map, 5.15, map + 2.0);
    }
    check_value(&s, 4, 4.85, 1.0);
    CHECK_COLOUR(pixel(&s, 4, 5.15), 252.0, 255.0, 164.0, 3.0); // above the scale
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "6 x 6 points on 0.5 m");
    CHECK_NEAR(pm_seen_number(&s, "drawn"), 36.0, 0.0);
    pm_seen_free(&s);
}

/// Whether a curve passes a point of the cut.
static bool passes(const pm_seen *seen, double x, double y, double r, double g, double b)
{
    const uint8_t colour[3] = {(uint8_t)r, (uint8_t)g, (uint8_t)b};
    int px;
    int py;
    pm_seen_chart(seen, 0, x, y, &px, &py);
    return pm_seen_near(seen, px, py, 1, colour, 70);
}

static void the_cut_runs_where_the_values_are(void)
{
    pm_seen s = look("");
    CHECK_NEAR(pm_seen_number(&s, "charts.0.x_ends.1"), 0.5, 1e-6);
    CHECK(passes(&s, 0.4, 50.0, 204, 121, 167));
    CHECK(passes(&s, 0.25, 25.5, 204, 121, 167)); // half way up its step
    CHECK(passes(&s, 0.4, 5.0, 0, 158, 115));
    CHECK(!passes(&s, 0.4, 20.0, 204, 121, 167));
    const uint8_t blue[3] = {86, 180, 233};
    int x;
    int y;
    pm_seen_place(&s, 0, pm_vec(4.85, 4.75 + 0.1 * (SIDE / 2.0), 4.5), &x, &y);
    CHECK(pm_seen_near(&s, x, y, 1, blue, 60));
    pm_seen_free(&s);
}

static void a_second_file_is_what_is_nearly_true(void)
{
    pm_seen s = look(write_grid("finer.csv", 10.0));
    CHECK_NEAR(pm_seen_number(&s, "scales.0.high"), 20.0, 0.0);
    check_value(&s, 5, 4.85, 10.0);
    check_value(&s, 5, 5.15, 20.0);
    check_value(&s, 0, 5.15, 2.0);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "nearly true");
    int x;
    int y;
    pm_seen_chart(&s, 0, 0.45, 15.0, &x, &y); // under the second file's 20, over all kernels
    const uint8_t *band = pm_seen_at(&s, x, y);
    pm_seen_chart(&s, 0, 0.45, 30.0, &x, &y);
    const uint8_t *over = pm_seen_at(&s, x, y);
    CHECK_THAT(band[0] > over[0] + 12, "%d in the band, %d over it", band[0], over[0]);
    pm_seen_free(&s);
}

static void no_light_is_off_the_scale(void)
{
    char text[2048] = HEADER;
    for (int n = 0; n < 9; n++) {
        char row[160];
        snprintf(row, sizeof row, "%d,%d,%g,%g,4.5%s", n % 3, n / 3, 4.8 + 0.2 * (n % 3),
                 4.8 + 0.2 * (n / 3), n % 3 == 2 ? VALUES : ",0,0,0,0,0,0,0,0,0\n");
        strcat(text, row);
    }
    pm_seen s = pm_seen_look("view edge {S} --scene {O} --size 640x480",
                             pm_command_write("e.csv", text), pm_room_scene());
    CHECK_COLOUR(pm_seen_pixel(&s, 0, pm_vec(4.85, 4.85, 4.5)), 70.0, 74.0, 84.0, 3.0);
    CHECK(pm_seen_number(&s, "scales.0.low") < 1.0 &&
          pm_seen_number(&s, "scales.0.high") > 1.0);
    pm_seen_free(&s);
}

/// Number `column` of a row.
static double field(const char *row, int column)
{
    for (int i = 0; i < column; i++) {
        row = strchr(row, ',') + 1;
    }
    return strtod(row, NULL);
}

static void filtering_agrees_with_radiance(void)
{
    static const char same[] = "{S} -n 3000 -k 30 --runs 2 --on floor --grid 3x2 --dump {O}";
    static const char scene[] = "scenes/square-over-floor.xml";
    char line[256];
    const char *ours = pm_command_path("ours.csv");
    const char *theirs = pm_command_path("theirs.csv");
    snprintf(line, sizeof line, "filtering %s", same);
    pm_test_ran ran = pm_command_run(line, scene, ours);
    CHECK_THAT(ran.exit_code == 0, "%s", ran.err);
    pm_test_ran_free(&ran);
    snprintf(line, sizeof line, "radiance %s", same);
    ran = pm_command_run(line, scene, theirs);
    CHECK_THAT(ran.exit_code == 0, "%s", ran.err);
    pm_test_ran_free(&ran);
    FILE *a = fopen(ours, "r");
    FILE *b = fopen(theirs, "r");
    char one[512];
    char other[512];
    CHECK(a != NULL && b != NULL);
    CHECK(fgets(one, sizeof one, a) != NULL && fgets(other, sizeof other, b) != NULL);
    CHECK_THAT(strcmp(one, HEADER) == 0, "header %s", one);
    for (int n = 0; n < 6; n++) {
        CHECK(fgets(one, sizeof one, a) != NULL && fgets(other, sizeof other, b) != NULL);
        double y =
            0.2126 * field(other, 8) + 0.7152 * field(other, 9) + 0.0722 * field(other, 10);
        CHECK_NEAR(field(one, 2), field(other, 2), 0.0);
        CHECK_THAT(y > 0.0, "row %d is dark", n);
        CHECK_NEAR(field(one, 5) / y, 1.0, 1e-3);
        CHECK_NEAR(field(one, 9) / field(one, 5), 30.0 / 29.0, 1e-6); // the lecture's k
    }
    CHECK(fgets(one, sizeof one, a) == NULL);
    fclose(a);
    fclose(b);
}

static void check_refused(const char *text, const char *part)
{
    pm_scene room;
    pm_edge_grid grid;
    CHECK_OK(pm_scene_read(pm_room_scene(), NULL, 0, false, &room));
    CHECK_FAILS(pm_edge_file_read(pm_command_write("x.csv", text), &room, &grid), PM_EINPUT,
                part);
    pm_scene_free(&room);
}

/// Of a second file that does not fit the first.
static void check_refused_with(const char *text, const char *more, const char *part)
{
    char whole[640];
    struct stat there;
    const char *out = pm_command_path("out.png");
    snprintf(whole, sizeof whole, "view edge {S} %s --scene {O} -o %s", more, out);
    pm_test_ran ran = pm_command_run(whole, pm_command_write("x.csv", text), pm_room_scene());
    pm_command_check_refusal(part, &ran, part);
    CHECK_THAT(stat(out, &there) != 0, "%s: a picture was left behind", part);
    pm_test_ran_free(&ran);
}

#define GRID                                                                                   \
    HEADER "0,0,5,5,4.5" VALUES "1,0,5.1,5,4.5" VALUES "0,1,5,5.1,4.5" VALUES                  \
           "1,1,5.1,5.1,4.5" VALUES

static void broken_files_are_refused(void)
{
    check_refused("", "x.csv:1: the file is empty; write it with filtering --grid --dump");
    check_refused(HEADER "0,0,5,5,4.5" VALUES, "x.csv:3: a grid has at least 2 x 2");
    check_refused(HEADER "0,0,5,5,4.5" VALUES "0,0,5,5,4.5" VALUES,
                  "x.csv:3: the next grid point is i,j = 1,0, got 0,0");
    check_refused(HEADER "0,0,5,5,4.5,1,1,1,1,1,1,1,1,-1\n",
                  "x.csv:2: differential must be >= 0, got -1");
    check_refused(HEADER "0,0,5,5,4.5,1,1,1,1,1,1,1,1,nan\n",
                  "x.csv:2: differential must be a finite number");
    check_refused(HEADER "0,0,5,5,4.5,1,1,1,1,1,1,1,1,1",
                  "x.csv:2: the file ends in the middle of a line");
    check_refused_with(GRID, write_grid("y.csv", 1.0),
                       "y.csv:2: this grid has 6 x 6 points, the first file's has 2 x 2");
    check_refused_with(GRID,
                       pm_command_write("z.csv",
                                        HEADER "0,0,5,5,4.5" VALUES "1,0,5.2,5,4.5" VALUES
                                               "0,1,5,5.1,4.5" VALUES "1,1,5.1,5.1,4.5" VALUES),
                       "z.csv:3: this point is 0.1 m from that of the first file");
}

PM_TESTS({"view_edge.1", "a map of each kernel has the colours of its values",
          maps_have_the_colours_of_their_values},
         {"view_edge.2", "the cut runs where the values are, along the blue line",
          the_cut_runs_where_the_values_are},
         {"view_edge.3", "a second file is drawn as what is nearly true",
          a_second_file_is_what_is_nearly_true},
         {"view_edge.4", "where no photon counts the map is off the scale",
          no_light_is_off_the_scale},
         {"view_edge.5", "filtering's grid without a kernel is that of radiance",
          filtering_agrees_with_radiance},
         {"view_edge.6", "broken files of grids are refused with file and line",
          broken_files_are_refused})

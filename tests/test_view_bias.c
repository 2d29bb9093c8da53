// Bias in pictures: squares have the colour of estimate over truth, charts have their dots and
// the curves of what is expected, and a real run follows them.
#include "command.h"
#include "grid_bias.h"
#include "room.h"
#include "seen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 6 };
static const char *line = "view bias {S} --scene {O} --size 640x480 --true 2";
static const uint8_t yellow[3] = {240, 228, 66};
static const uint8_t sky[3] = {86, 180, 233};

/// A grid that covers the room's back wall, its cells 1/6 m wide: `edge` in the outermost
/// points, `inside` in the others; radius 0.25 m.
static const char *write_grid(const char *name, double edge, double inside)
{
    static char text[8192];
    size_t used =
        (size_t)snprintf(text, sizeof text, "i,j,x,y,z,nx,ny,nz,r,g,b,radius,found\n");
    for (int n = 0; n < SIDE * SIDE; n++) {
        int i = n % SIDE;
        int j = n / SIDE;
        bool outer = i == 0 || j == 0 || i == SIDE - 1 || j == SIDE - 1;
        double value = outer ? edge : inside;
        used += (size_t)snprintf(
            text + used, sizeof text - used, "%d,%d,%.9g,%.9g,4.5,0,0,1,%g,%g,%g,0.25,80\n", i,
            j, 4.5 + (i + 0.5) / SIDE, 4.5 + (j + 0.5) / SIDE, value, value, value);
    }
    return pm_command_write(name, text);
}

static pm_seen look(const char *words, const char *file)
{
    return pm_seen_look(words, file, pm_room_scene());
}

static void check_square(const pm_seen *s, pm_vec3 at, double place)
{
    const uint8_t *bar = pm_seen_scale(s, 0, place);
    CHECK_COLOUR(pm_seen_pixel(s, 0, at), (double)bar[0], (double)bar[1], (double)bar[2], 6.0);
}

static void squares_have_the_colour_of_their_ratio(void)
{
    pm_seen s = look(line, write_grid("disc.csv", 1.1, 2.2));
    CHECK_NEAR(pm_seen_number(&s, "scales.0.low"), 0.5, 1e-9); // 0.55 in steps of a quarter
    CHECK_NEAR(pm_seen_number(&s, "scales.0.high"), 1.5, 1e-9);
    check_square(&s, pm_vec(4.52, 5.02, 4.5), 0.05);
    check_square(&s, pm_vec(5.02, 5.02, 4.5), 0.60);
    // Squares end where the wall does.
    CHECK(pm_seen_pixel(&s, 0, pm_vec(4.49, 5.0, 4.5))[2] < 60);
    pm_seen_free(&s);
}

static void numbers_are_means_over_truth(void)
{
    pm_seen s = look(line, write_grid("half-off.csv", 1.0, 2.0));
    CHECK_NEAR(pm_seen_number(&s, "grids.0.middle"), 1.0, 1e-12);
    CHECK_NEAR(pm_seen_number(&s, "grids.0.edge"), 0.5, 1e-12);
    CHECK_NEAR(pm_seen_number(&s, "grids.0.corner"), 0.5, 1e-12);
    CHECK_NEAR(pm_seen_number(&s, "grids.0.radius"), 0.25, 1e-12);
    CHECK_NEAR(pm_seen_number(&s, "grids.0.found"), 80.0, 1e-9);
    CHECK(strcmp(pm_seen_text(&s, "grids.0.name"), "half off") == 0);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "divided by what it should be: 2 W/m");
    pm_seen_free(&s);
}

static void charts_have_data_and_expectation(void)
{
    int x;
    int y;
    pm_seen s = look(line, write_grid("disc.csv", 1.2, 2.0));
    pm_seen_chart(&s, 0, 1.0 / 12.0 / 0.25, 0.6, &x, &y); // half a cell, in radii
    CHECK_THAT(pm_seen_near(&s, x, y, 2, yellow, 12), "%s", "no dot at the edge's ratio");
    pm_seen_chart(&s, 0, 3.0 / 12.0 / 0.25, 1.0, &x, &y);
    CHECK_THAT(pm_seen_near(&s, x, y, 2, yellow, 12), "%s", "no dot at the next ratio");
    pm_seen_chart(&s, 0, 0.6, pm_grid_bias_disc(0.6), &x, &y);
    CHECK_THAT(pm_seen_near(&s, x, y, 6, sky, 60), "%s", "no curve of a disc's share");
    pm_seen_free(&s);
}

static void three_grids_share_a_scale(void)
{
    char three[1024];
    const char *sphere = write_grid("sphere.csv", 2.5, 2.0);
    const char *disc = write_grid("disc.csv", 1.0, 2.0);
    snprintf(three, sizeof three, "view bias %s %s {S} --scene {O} --size 640x480", sphere,
             disc);
    pm_seen s = look(three, write_grid("small-k.csv", 1.4, 2.6));
    CHECK(json_array_size(pm_seen_member(&s, "panels")) == 3);
    CHECK(json_array_size(pm_seen_member(&s, "charts")) == 3);
    CHECK(json_array_size(pm_seen_member(&s, "scales")) == 1);
    CHECK_NEAR(pm_seen_number(&s, "grids.0.edge"), 1.25, 1e-12);
    CHECK_NEAR(pm_seen_number(&s, "grids.1.edge"), 0.5, 1e-12);
    // Without --true it is the median of the middles.
    CHECK_NEAR(pm_seen_number(&s, "truth"), 2.0, 1e-12);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "median of the middle");
    const uint8_t *bright = pm_seen_pixel(&s, 0, pm_vec(4.55, 5.0, 4.5));
    const uint8_t *dark = pm_seen_pixel(&s, 1, pm_vec(4.55, 5.0, 4.5));
    CHECK(bright[0] > bright[2] + 60 && dark[2] > dark[0] + 60);
    pm_seen_free(&s);
}

static void shares_of_a_disc_are_areas(void)
{
    CHECK_NEAR(pm_grid_bias_disc(0.0), 0.5, 1e-15);
    CHECK_NEAR(pm_grid_bias_disc(1.0), 1.0, 1e-15);
    CHECK(pm_grid_bias_disc(7.0) == 1.0);
    CHECK_NEAR(pm_grid_bias_disc(0.5), 0.804498890494, 1e-9);
    CHECK_NEAR(pm_grid_bias_sphere(0.0), 1.0, 1e-15);
    CHECK_NEAR(pm_grid_bias_sphere(0.5), 0.804498890494 + 0.375, 1e-9);
    CHECK(pm_grid_bias_sphere(7.0) == 1.0);
}

static void refuse(const char *command, const char *file, const char *part)
{
    pm_test_ran ran = pm_command_run(command, file, pm_room_scene());
    pm_command_check_refusal(command, &ran, part);
    pm_test_ran_free(&ran);
}

static void no_truth_is_refused(void)
{
    const char *dark = write_grid("dark.csv", 1.0, 0.0);
    refuse("view bias {S} --scene {O} -o x.png", dark,
           "dark.csv: the middle of the grid is dark");
    refuse("view bias {S} --scene {O} -o x.png --true 0", dark, "--true");
    refuse("view bias {S} --scene {O} -o x.png",
           pm_command_write("x.csv", "i,j,x,y,z,nx,ny,nz,r,g,b,radius,found\n"
                                     "0,0,5,5,4.5,0,0,1,1,1,1,0.1\n"),
           "x.csv:2: a row has 13 fields, got 12");
}

// --- a real run -----------------------------------------------------------------------------

/// Mean ratio on a wall of the furnace, in the middle and at the edge: the map's photons are
/// 20,000 a run, some 200 in a disc, so that a mean over 4 x 2 of them and 3 runs is good to
/// about 0.02.
static pm_seen run_furnace(const char *shape)
{
    char words[256];
    const char *csv = pm_command_path("grid.csv");
    snprintf(
        words, sizeof words,
        "radiance {S} -n 20000 --runs 3 --on floor --grid 12x6 -r 0.4 -k 100000 --shape %s "
        "--dump {O}",
        shape);
    pm_test_ran ran = pm_command_run(words, "scenes/furnace-walls.xml", csv);
    CHECK_THAT(ran.exit_code == 0, "%s", ran.err);
    pm_test_ran_free(&ran);
    return pm_seen_look("view bias {S} --scene {O} --size 640x480 --true 6.28318531", csv,
                        "scenes/furnace-walls.xml");
}

static void a_furnace_follows_the_curves(void)
{
    const double x = 1.0 / 12.0 / 0.4; // half a cell of the outermost column, in radii
    pm_seen disc = run_furnace("disc");
    pm_seen sphere = run_furnace("sphere");
    double low = 0.1 * (pm_grid_bias_sphere(x) - pm_grid_bias_disc(x)); // of flatness 0.1
    CHECK_NEAR(pm_seen_number(&disc, "grids.0.middle"), 1.0, 0.06);
    CHECK_NEAR(pm_seen_number(&disc, "grids.0.edge"), pm_grid_bias_disc(x) + low, 0.06);
    CHECK_NEAR(pm_seen_number(&sphere, "grids.0.middle"), 1.0, 0.06);
    CHECK_NEAR(pm_seen_number(&sphere, "grids.0.edge"), pm_grid_bias_sphere(x), 0.06);
    pm_seen_free(&disc);
    pm_seen_free(&sphere);
}

PM_TESTS({"view_bias.1", "a square has the colour of its estimate over the truth",
          squares_have_the_colour_of_their_ratio},
         {"view_bias.2", "the numbers under a map are means over the truth",
          numbers_are_means_over_truth},
         {"view_bias.3", "a chart has the edge's dots and the curve of a disc's share",
          charts_have_data_and_expectation},
         {"view_bias.4", "three grids share a scale and the median of their middles",
          three_grids_share_a_scale},
         {"view_bias.5", "what a disc and a sphere should find are areas",
          shares_of_a_disc_are_areas},
         {"view_bias.6", "without a truth there is no picture", no_truth_is_refused},
         {"view_bias.7", "a furnace's walls follow the curves of disc and sphere",
          a_furnace_follows_the_curves})

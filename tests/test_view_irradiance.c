// The heat map of irradiance: its scale ends where the data does, its note tells the data's
// extremes, and what is behind it can be had as a .vtp.
#include "command.h"
#include "room.h"
#include "seen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *line = "view irradiance {S} --scene {O} --size 640x480";

/// A grid of 4 x 4 points in front of the room's back wall; irradiance rises from `low` to
/// `high` by equal factors, photons from 10 to 25, radii from 0.1 to 0.25.
static const char *write_grid(double low, double high)
{
    static char text[4096];
    size_t used =
        (size_t)snprintf(text, sizeof text, "i,j,x,y,z,nx,ny,nz,r,g,b,radius,found\n");
    double value = low;
    for (int n = 0; n < 16; n++) {
        used += (size_t)snprintf(text + used, sizeof text - used,
                                 "%d,%d,%g,%g,4.6,0,0,1,%.9g,%.9g,%.9g,%g,%d\n", n % 4, n / 4,
                                 4.6 + 0.2 * (n % 4), 4.6 + 0.2 * (n / 4), value, value, value,
                                 0.1 + 0.01 * n, 10 + n);
        value *= n < 15 && low < high ? pow(high / low, 1.0 / 15.0) : 1.0;
    }
    return pm_command_write("grid.csv", text);
}

static void the_bar_ends_where_the_data_does(void)
{
    pm_seen s = pm_seen_look(line, write_grid(0.25, 40.0), pm_room_scene());
    CHECK_NEAR(pm_seen_number(&s, "scales.0.low"), 0.25, 1e-8);
    CHECK_NEAR(pm_seen_number(&s, "scales.0.high"), 40.0, 1e-6);
    CHECK(json_is_true(pm_seen_member(&s, "scales.0.logarithmic")));
    // The first and the last point are the least and the most, and the one between has the
    // colour of the scale at its place.
    const struct {
        pm_vec3 at;
        double place;
    } points[] = {
        {{4.61, 4.61, 4.6}, 0.02}, {{5.19, 5.19, 4.6}, 0.98}, {{5.19, 4.8, 4.6}, 6.95 / 15.0}};
    for (int i = 0; i < 3; i++) {
        const uint8_t *bar = pm_seen_scale(&s, 0, points[i].place);
        CHECK_COLOUR(pm_seen_pixel(&s, 0, points[i].at), (double)bar[0], (double)bar[1],
                     (double)bar[2], 22.0);
    }
    pm_seen_free(&s);
}

static void a_flat_field_has_a_scale_too(void)
{
    pm_seen s = pm_seen_look(line, write_grid(3.0, 3.0), pm_room_scene());
    CHECK(pm_seen_number(&s, "scales.0.low") < 3.0);
    CHECK(pm_seen_number(&s, "scales.0.high") > 3.0);
    pm_seen_free(&s);
}

static void the_note_tells_the_extremes(void)
{
    pm_seen s = pm_seen_look(line, write_grid(1.0, 2.0), pm_room_scene());
    CHECK_CONTAINS(pm_seen_text(&s, "note"),
                   "4 x 4 points, 10 to 25 photons each, within 0.1 to 0.25 m");
    CHECK(pm_seen_number(&s, "drawn") == 16.0);
    pm_seen_free(&s);
}

static void bad_grids_are_refused(void)
{
    static const struct {
        const char *row, *part;
    } bad[] = {{"0,0,5,5,5,0,0,1,1,1,1,-0.1,9\n", "x.csv:2: radius must be >= 0"},
               {"0,0,5,5,5,0,0,1,1,1,1,inf,9\n", "x.csv:2: radius must be a finite number"},
               {"0,0,5,5,5,0,0,0,1,1,1,0.1,9\n", "x.csv:2: nx and the two"}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char text[256];
        snprintf(text, sizeof text, "i,j,x,y,z,nx,ny,nz,r,g,b,radius,found\n%s", bad[i].row);
        pm_test_ran ran = pm_command_run("view irradiance {S} --scene {O} -o x.png",
                                         pm_command_write("x.csv", text), pm_room_scene());
        pm_command_check_refusal(bad[i].row, &ran, bad[i].part);
        pm_test_ran_free(&ran);
    }
}

PM_TESTS({"view_irradiance.1", "the bar's ends are the data's least and most",
          the_bar_ends_where_the_data_does},
         {"view_irradiance.2", "a flat field has a scale around its value",
          a_flat_field_has_a_scale_too},
         {"view_irradiance.3", "the note tells the extremes of photons and radii",
          the_note_tells_the_extremes},
         {"view_irradiance.4", "radii and normals that cannot be are refused",
          bad_grids_are_refused})

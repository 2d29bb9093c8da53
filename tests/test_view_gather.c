// The gather region in pictures: photons written by hand are found in their colours, and what
// `radiance --gathered` writes adds up to what it reports.
#include "command.h"
#include "room.h"
#include "seen.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define HEADER "what,number,x,y,z,nx,ny,nz,dx,dy,dz,r,g,b,distance,weight\n"
#define FLOOR ",0,1,0,0,-1,0,"
#define WALL ",0,0,1,0,0,-1,"

// A ball of radius 0.2 m on the room's floor, 0.1 m before its back wall.
#define REGION "sphere,4,5,4.5,4.6,0,1,0,0,0,0,2,3,4,0.2,1\n"
#define DISC "disc,4,5,4.5,4.6,0,1,0,0,0,0,2,3,4,0.2,0.1\n"
#define PHOTONS                                                                                \
    "counted,0,4.9,4.5,4.65" FLOOR "0.1,0.1,0.1,0.112,1\n"                                     \
    "counted,1,5.08,4.5,4.68" FLOOR "0.1,0.1,0.1,0.113,1\n"                                    \
    "counted,2,4.94,4.6,4.5" WALL "0.1,0.1,0.1,0.154,1\n"                                      \
    "rim,3,5,4.5,4.8" FLOOR "0.1,0.1,0.1,0.2,0\n"                                              \
    "near,4,5.25,4.5,4.85" FLOOR "0.1,0.1,0.1,0.354,0\n"

static const char *line = "view gather {S} --scene {O} --size 640x480";

static const uint8_t orange[3] = {230, 159, 0};
static const uint8_t sky[3] = {86, 180, 233};
static const uint8_t white[3] = {245, 245, 245};

static pm_seen look(const char *text)
{
    return pm_seen_look(line, pm_command_write("g.csv", text), pm_room_scene());
}

static bool is_lit(const pm_seen *seen, int panel, pm_vec3 place, const uint8_t colour[3])
{
    int x;
    int y;
    pm_seen_place(seen, panel, place, &x, &y);
    return pm_seen_near(seen, x, y, 1, colour, 12);
}

static void photons_have_the_colour_of_their_fate(void)
{
    const pm_vec3 here = {4.9, 4.5, 4.65};
    const pm_vec3 wall = {4.94, 4.6, 4.5};
    const pm_vec3 rim = {5.0, 4.5, 4.8};
    const pm_vec3 near = {5.25, 4.5, 4.85};
    pm_seen s = look(HEADER REGION PHOTONS);
    CHECK(is_lit(&s, 0, here, orange));
    CHECK(is_lit(&s, 0, wall, sky));
    CHECK(is_lit(&s, 0, rim, white));
    const uint8_t *dim = pm_seen_pixel(&s, 0, near);
    CHECK_THAT(dim[0] > 60 && dim[0] < 140 && abs(dim[0] - dim[2]) < 30,
               "a photon out of reach is %d %d %d, not a dim grey", dim[0], dim[1], dim[2]);
    pm_seen_free(&s);
}

static void ball_and_disc_stand_side_by_side(void)
{
    const char *ball = pm_command_write("ball.csv", HEADER REGION PHOTONS);
    char both[512];
    snprintf(both, sizeof both, "view gather %s {S} --scene {O} --size 640x480", ball);
    pm_seen s =
        pm_seen_look(both, pm_command_write("disc.csv", HEADER DISC PHOTONS), pm_room_scene());
    CHECK(json_array_size(pm_seen_member(&s, "panels")) == 2);
    CHECK(strcmp(pm_seen_text(&s, "regions.0.shape"), "sphere") == 0);
    CHECK(strcmp(pm_seen_text(&s, "regions.1.shape"), "disc") == 0);
    // Near its outline the ball is seen as a yellow veil; the disc is not so high.
    const pm_vec3 high = {5.13, 4.64, 4.6};
    const uint8_t *veil = pm_seen_pixel(&s, 0, high);
    const uint8_t *clear = pm_seen_pixel(&s, 1, high);
    CHECK_THAT(veil[0] > clear[0] + 15 && veil[1] > clear[1] + 15,
               "%d %d %d in the ball, %d %d %d over the disc: no translucent ball", veil[0],
               veil[1], veil[2], clear[0], clear[1], clear[2]);
    CHECK(is_lit(&s, 1, pm_vec(4.9, 4.5, 4.65), orange));
    pm_seen_free(&s);
}

static void counts_are_the_files(void)
{
    pm_seen s = look(HEADER REGION PHOTONS);
    CHECK(pm_seen_number(&s, "regions.0.here") == 2.0);
    CHECK(pm_seen_number(&s, "regions.0.elsewhere") == 1.0);
    CHECK(pm_seen_number(&s, "regions.0.rim") == 1.0);
    CHECK(pm_seen_number(&s, "regions.0.near") == 1.0);
    CHECK(pm_seen_number(&s, "regions.0.found") == 4.0);
    CHECK(pm_seen_number(&s, "regions.0.radius") == 0.2);
    CHECK(pm_seen_number(&s, "regions.0.irradiance.1") == 3.0);
    CHECK_NEAR(pm_seen_number(&s, "regions.0.sum"), 0.3 / (3.14159265358979 * 0.04), 1e-12);
    pm_seen_free(&s);
}

static void nothing_found_is_a_picture_too(void)
{
    pm_seen s = look(HEADER "disc,0,5,4.5,4.6,0,1,0,0,0,0,0,0,0,0,0.1\n");
    CHECK(pm_seen_number(&s, "regions.0.found") == 0.0);
    CHECK(pm_seen_number(&s, "regions.0.sum") == 0.0);
    pm_seen_free(&s);
}

static void refuse(const char *text, const char *part)
{
    char whole[256];
    snprintf(whole, sizeof whole, "%s -o %s", line, pm_command_path("out.png"));
    pm_test_ran ran = pm_command_run(whole, pm_command_write("x.csv", text), pm_room_scene());
    pm_command_check_refusal(part, &ran, part);
    struct stat there;
    CHECK_THAT(stat(pm_command_path("out.png"), &there) != 0, "%s: a picture is left", part);
    pm_test_ran_free(&ran);
}

static void broken_files_are_refused(void)
{
    refuse(HEADER, "x.csv:2: the file holds no region");
    refuse(HEADER "ball,0,5,4.5,4.6,0,1,0,0,0,0,2,3,4,0.2,1\n",
           "x.csv:2: the first row must be the region");
    refuse(HEADER "sphere,4,5,4.5,4.6,0,2,0,0,0,0,2,3,4,0.2,1\n", "x.csv:2: nx");
    refuse(HEADER "sphere,4,5,4.5,4.6,0,1,0,0,0,0,2,3,4,0,1\n",
           "x.csv:2: a region with photons");
    refuse(HEADER "disc,4,5,4.5,4.6,0,1,0,0,0,0,2,3,4,0.2,2\n",
           "x.csv:2: a region with photons");
    refuse(HEADER REGION "counted,0,4.9,4.5,4.65" FLOOR "0.1,0.1,0.1,0.112,1\n",
           "x.csv:4: the region holds 4 photons");
    refuse(HEADER REGION "taken,0,4.9,4.5,4.65" FLOOR "0.1,0.1,0.1,0.112,1\n",
           "x.csv:3: what must be one of counted, rim, near, behind, got \"taken\"");
    refuse(HEADER REGION "near,0,4.9,4.5,4.65" FLOOR "-1,0.1,0.1,0.112,1\n",
           "x.csv:3: r must be >= 0");
    refuse(HEADER REGION "near,0,4.9,4.5,4.65" FLOOR "1,0.1,0.1,0.112,nan\n",
           "x.csv:3: weight must be a finite number");
    refuse(HEADER REGION PHOTONS REGION, "x.csv:8: what must be one of");
}

// --- what the driver writes -----------------------------------------------------------------

/// Runs `radiance` near the corner of floor and wall, and returns its report.
static json_t *gather(const char *options, const char *csv)
{
    char words[256];
    snprintf(words, sizeof words,
             "radiance {S} -n 20000 --at -0.47,0,0.1 --normal 0,1,0 --json --gathered {O} %s",
             options);
    pm_test_ran ran = pm_command_run(words, "scenes/cornell-spheres.xml", csv);
    CHECK_THAT(ran.exit_code == 0, "%s: %s", options, ran.err);
    json_t *report = json_loads(ran.out, 0, NULL);
    CHECK(report != NULL);
    pm_test_ran_free(&ran);
    return report;
}

static double member(const json_t *report, const char *key)
{
    return json_number_value(json_object_get(report, key));
}

static void check_gathered(const char *options, double rims)
{
    const char *csv = pm_command_path("gathered.csv");
    json_t *report = gather(options, csv);
    pm_seen s = pm_seen_look(line, csv, "scenes/cornell-spheres.xml");
    const json_t *told = json_object_get(report, "irradiance");
    double luminance = 0.2126 * json_number_value(json_array_get(told, 0)) +
                       0.7152 * json_number_value(json_array_get(told, 1)) +
                       0.0722 * json_number_value(json_array_get(told, 2));
    CHECK_NEAR(pm_seen_number(&s, "regions.0.sum"), luminance, 1e-6 * luminance);
    CHECK(pm_seen_number(&s, "regions.0.found") == member(report, "found"));
    CHECK_NEAR(pm_seen_number(&s, "regions.0.radius"), member(report, "radius"), 1e-8);
    CHECK_THAT(pm_seen_number(&s, "regions.0.rim") == rims, "%s: %g photons set the radius",
               options, pm_seen_number(&s, "regions.0.rim"));
    CHECK(pm_seen_number(&s, "regions.0.near") > 10.0);
    json_decref(report);
    pm_seen_free(&s);
}

static void gathered_photons_add_up(void)
{
    check_gathered("-k 60 --shape sphere", 1.0);
    check_gathered("-k 60 --shape disc --filter cone", 1.0);
    check_gathered("-k 5000 -r 0.05 --filter gaussian", 0.0);
}

static void a_sphere_takes_the_walls_photons(void)
{
    static const char *const shapes[] = {"-k 60 --shape sphere", "-k 60 --shape disc"};
    double elsewhere[2];
    for (int i = 0; i < 2; i++) {
        const char *csv = pm_command_path("gathered.csv");
        json_decref(gather(shapes[i], csv));
        pm_seen s = pm_seen_look(line, csv, "scenes/cornell-spheres.xml");
        elsewhere[i] = pm_seen_number(&s, "regions.0.elsewhere");
        pm_seen_free(&s);
    }
    CHECK_THAT(elsewhere[0] >= 6.0 && 3.0 * elsewhere[1] <= elsewhere[0],
               "the sphere takes %g of the wall's photons, the disc %g", elsewhere[0],
               elsewhere[1]);
}

static void only_one_estimate_can_be_gathered(void)
{
    static const char *const bad[] = {
        "radiance {S} --at 0,0,0 --normal 0,1,0 --runs 2 --gathered {O}",
        "radiance {S} --on floor --grid 2x2 --gathered {O}"};
    for (int i = 0; i < 2; i++) {
        const char *csv = pm_command_path("gathered.csv");
        pm_test_ran ran = pm_command_run(bad[i], "scenes/cornell-spheres.xml", csv);
        struct stat there;
        pm_command_check_refusal(bad[i], &ran, "radiance: --gathered shows one estimate");
        CHECK(stat(csv, &there) != 0);
        pm_test_ran_free(&ran);
    }
}

PM_TESTS({"view_gather.1", "a photon has the colour of what became of it, at its place",
          photons_have_the_colour_of_their_fate},
         {"view_gather.2", "ball and disc stand side by side, the ball as a translucent veil",
          ball_and_disc_stand_side_by_side},
         {"view_gather.3", "the counts under a region are the file's", counts_are_the_files},
         {"view_gather.4", "a region that found nothing is a picture, too",
          nothing_found_is_a_picture_too},
         {"view_gather.5", "broken regions are refused with file and line",
          broken_files_are_refused},
         {"view_gather.6", "the photons that radiance writes add up to what it reports",
          gathered_photons_add_up},
         {"view_gather.7", "near a wall the sphere takes its photons, the disc few",
          a_sphere_takes_the_walls_photons},
         {"view_gather.8", "what is gathered is one estimate on a surface",
          only_one_estimate_can_be_gathered})

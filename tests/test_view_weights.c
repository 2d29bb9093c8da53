// Pictures of weights: photons put by hand in front of the room's back wall, each in the colour
// of what it counts; and the files of filtering that they are made from.
#include "command.h"
#include "room.h"
#include "scene_read.h"
#include "seen.h"
#include "weight_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define HEADER "x,y,z,r,g,b,distance,none,cone,gaussian,epanechnikov\n"
// Around (5, 5, 4.5), on the wall, in a disc of radius 0.2.
#define PHOTONS                                                                                \
    HEADER "5.05,5,4.5,1,1,1,0.05,1,2,1.5,1.875\n"                                             \
           "5,5.1,4.5,1,1,1,0.1,1,1,1.25,1.5\n"                                                \
           "4.86,5,4.5,1,1,1,0.2,0,0,0,0\n"
#define FILTER(name, mean, rms) "\"" name "\":{\"mean\":" mean ",\"rms\":" rms "}"
#define FILTERS                                                                                \
    "\"filters\":{" FILTER("none", "[1,2,3]", "[0.1,0.2,0.3]") "," FILTER(                     \
        "cone", "[4,4,4]",                                                                     \
        "[1,1,1]") "," FILTER("gaussian", "[5,5,5]",                                           \
                              "[0,0,0]") "," FILTER("epanechnikov", "[6,6,6]", "[0,0,0]") "}"
#define GATHERED(radius, photons)                                                              \
    "\"gathered\":{\"at\":[5,5,4.5],\"normal\":[0,0,1],\"radius\":" radius                     \
    ",\"photons\":" photons "}"
#define REPORT "{" FILTERS ",\"samples\":7.0," GATHERED("0.2", "3") "}"

/// The line of a view of {S} and a report in the room, {O}.
static const char *line(const char *report)
{
    static char text[512];
    snprintf(text, sizeof text, "view weights {S} %s --scene {O} --size 640x480",
             pm_command_write("r.json", report));
    return text;
}

static pm_seen look(const char *photons, const char *report)
{
    return pm_seen_look(line(report), pm_command_write("g.csv", photons), pm_room_scene());
}

static const uint8_t *at(const pm_seen *seen, int kernel, double x, double y)
{
    return pm_seen_pixel(seen, kernel, pm_vec(x, y, 4.5));
}

static void check_alike(const uint8_t *got, const uint8_t *want)
{
    CHECK_COLOUR(got, (double)want[0], (double)want[1], (double)want[2], 8.0);
}

static void check_numbers(const pm_seen *seen)
{
    CHECK_CONTAINS(pm_seen_text(seen, "note"), "the same 3 photons");
    CHECK_CONTAINS(pm_seen_text(seen, "note"), "mean of 7 maps");
    CHECK_NEAR(pm_seen_number(seen, "results.none.mean"), 2.0, 1e-12);
    CHECK_NEAR(pm_seen_number(seen, "results.none.rms"), 0.2, 1e-12);
    CHECK_NEAR(pm_seen_number(seen, "results.cone.mean"), 4.0, 1e-12);
    CHECK_NEAR(pm_seen_number(seen, "results.gaussian.mean"), 5.0, 1e-12);
    CHECK_NEAR(pm_seen_number(seen, "results.epanechnikov.mean"), 6.0, 1e-12);
}

static void photons_have_the_colour_of_their_weight(void)
{
    static const double near[4] = {1.0, 2.0, 1.5, 1.875};
    static const double far[4] = {1.0, 1.0, 1.25, 1.5};
    pm_seen s = look(PHOTONS, REPORT);
    CHECK_NEAR(pm_seen_number(&s, "scales.0.low"), 0.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "scales.0.high"), 2.0, 0.0);
    for (int kernel = 0; kernel < 4; kernel++) {
        check_alike(at(&s, kernel, 5.05, 5.0), pm_seen_scale(&s, 0, near[kernel] / 2.0));
        check_alike(at(&s, kernel, 5.0, 5.1), pm_seen_scale(&s, 0, far[kernel] / 2.0));
        const uint8_t *empty = at(&s, kernel, 5.0, 4.9);
        CHECK(empty[0] < 70 && empty[1] < 70 && empty[2] < 80);
    }
    check_numbers(&s);
    pm_seen_free(&s);
}

/// Pixels to the right of a photon that have its colour.
static int half_width(const pm_seen *seen, int kernel, double x, double y)
{
    int px;
    int py;
    pm_seen_place(seen, kernel, pm_vec(x, y, 4.5), &px, &py);
    const uint8_t *middle = pm_seen_at(seen, px, py);
    for (int width = 0;; width++) {
        const uint8_t *pixel = pm_seen_at(seen, px + width, py);
        if (abs(pixel[0] - middle[0]) + abs(pixel[2] - middle[2]) > 30) {
            return width;
        }
    }
}

static void photons_that_count_more_are_larger(void)
{
    pm_seen s = look(HEADER "5.05,5,4.5,1,1,1,0.05,2,2,2,2\n5,5.1,4.5,1,1,1,0.1,2,0.2,2,2\n"
                            "4.8,5,4.5,1,1,1,0.2,0,0,0,0\n",
                     REPORT);
    CHECK(abs(half_width(&s, 0, 5.05, 5.0) - half_width(&s, 0, 5.0, 5.1)) <= 1);
    CHECK(half_width(&s, 1, 5.05, 5.0) > half_width(&s, 1, 5.0, 5.1) + 1);
    pm_seen_free(&s);
}

static void a_photon_that_counts_for_nothing_is_a_ring(void)
{
    static const uint8_t white[3] = {245, 245, 245};
    pm_seen s = look(PHOTONS, REPORT);
    int x;
    int y;
    pm_seen_place(&s, 0, pm_vec(4.86, 5.0, 4.5), &x, &y);
    const uint8_t grey[3] = {150, 154, 165};
    CHECK(pm_seen_near(&s, x, y, 6, grey, 40) && !pm_seen_near(&s, x, y, 1, grey, 40));
    for (int i = 0; i < 4; i++) {
        double phi = 0.4 + i * PM_PI / 2.0;
        pm_seen_place(&s, 0, pm_vec(5.0 + 0.2 * cos(phi), 5.0 + 0.2 * sin(phi), 4.5), &x, &y);
        CHECK(pm_seen_near(&s, x, y, 1, white, 60));
    }
    pm_seen_free(&s);
}

/// Sums of power times weight in a file of filtering, for each kernel.
static int add_up(const char *path, double sums[4])
{
    char row[512];
    int count = 0;
    FILE *file = fopen(path, "r");
    CHECK(file != NULL && fgets(row, sizeof row, file) != NULL && strcmp(row, HEADER) == 0);
    for (; fgets(row, sizeof row, file) != NULL; count++) {
        double v[11];
        char *end = row;
        for (int i = 0; i < 11; i++) {
            v[i] = strtod(end, &end);
            CHECK(*end == (i < 10 ? ',' : '\n'));
            end++;
        }
        for (int kernel = 0; kernel < 4; kernel++) {
            sums[kernel] += v[3] * v[7 + kernel];
        }
    }
    fclose(file);
    return count;
}

/// Reach wide enough for k photons, and one that finds fewer.
static void check_sums(const char *reach)
{
    static const char *const names[4] = {"none", "cone", "gaussian", "epanechnikov"};
    char command[256];
    const char *path = pm_command_path("gathered.csv");
    snprintf(command, sizeof command,
             "filtering {S} -n 3000 -k 40 -r %s --at 0.1,0,0 --normal 0,0,1 --json --gathered "
             "{O}",
             reach);
    pm_test_ran ran = pm_command_run(command, "scenes/square-over-floor.xml", path);
    CHECK_THAT(ran.exit_code == 0, "%s", ran.err);
    json_t *told = json_loads(ran.out, 0, NULL);
    const json_t *region = json_object_get(told, "gathered");
    double radius = json_number_value(json_object_get(region, "radius"));
    double sums[4] = {0};
    int count = add_up(path, sums);
    CHECK(count > 2 && count == json_integer_value(json_object_get(region, "photons")));
    for (int kernel = 0; kernel < 4; kernel++) {
        const json_t *row = json_object_get(json_object_get(told, "filters"), names[kernel]);
        double mean = json_number_value(json_array_get(json_object_get(row, "mean"), 0));
        CHECK_NEAR(sums[kernel] / (PM_PI * radius * radius) / mean, 1.0, 1e-6);
    }
    json_decref(told);
    pm_test_ran_free(&ran);
}

static void weights_add_up_to_the_irradiance(void)
{
    check_sums("none");
    check_sums("0.2");
}

static void only_one_point_has_its_photons_written(void)
{
    const char *path = pm_command_path("gathered.csv");
    pm_test_ran ran =
        pm_command_run("filtering {S} -n 100 -k 5 --on floor --grid 2x2 --gathered {O}",
                       "scenes/square-over-floor.xml", path);
    pm_command_check_refusal("filtering", &ran,
                             "filtering: --gathered needs --at X,Y,Z with --normal");
    struct stat there;
    CHECK(stat(path, &there) != 0);
    pm_test_ran_free(&ran);
}

static void check_refused(const char *photons, const char *report, const char *part)
{
    pm_scene room;
    pm_weighed_set set;
    CHECK_OK(pm_scene_read(pm_room_scene(), NULL, 0, false, &room));
    CHECK_FAILS(pm_weight_file_read(pm_command_write("g.csv", photons),
                                    pm_command_write("r.json", report), &room, &set),
                PM_EINPUT, part);
    pm_scene_free(&room);
}

static void broken_files_are_refused(void)
{
    check_refused("", REPORT, "g.csv:1: the file is empty; write it with filtering --gathered");
    check_refused(HEADER, REPORT, "g.csv:2: the file holds no photon");
    check_refused(HEADER "5,5,4.5,1,1,1,0.1,1,1,1,1\n5,5,4.5,1,1,1,0.05,1,1,1,1\n", REPORT,
                  "g.csv:3: the photons stand nearest first, got 0.05 after 0.1");
    check_refused(HEADER "5,5,4.5,1,-1,1,0.1,1,1,1,1\n", REPORT, "g.csv:2: g must be >= 0");
    check_refused(HEADER "5,5,4.5,1,1,1,0.1,1,inf,1,1\n", REPORT,
                  "g.csv:2: cone must be a finite number, got \"inf\"");
    check_refused(HEADER "5,5,400,1,1,1,0.1,1,1,1,1\n", REPORT, "g.csv:2: the point 5,5,400");
    check_refused(PHOTONS, "{\n\"filters\": }", "r.json:2: this is no JSON");
    check_refused(PHOTONS, "{" FILTERS ",\"samples\":1}", "r.json: it must have \"gathered\"");
    check_refused(PHOTONS, "{\"samples\":1," GATHERED("0.2", "3") "}",
                  "r.json: it must have \"filters\"");
    check_refused(PHOTONS, "{" FILTERS "," GATHERED("0.2", "3") "}",
                  "r.json: it must have \"samples\"");
    check_refused(PHOTONS, "{" FILTERS ",\"samples\":1," GATHERED("0.2", "4") "}",
                  "r.json: the report is of 4 photons, and the other file has 3");
    check_refused(PHOTONS, "{" FILTERS ",\"samples\":1," GATHERED("0.12", "3") "}",
                  "g.csv:4: this photon is 0.14 m from the middle of a disc of radius 0.12");
    char whole[640];
    struct stat there;
    snprintf(whole, sizeof whole, "%s -o %s", line("{}"), pm_command_path("out.png"));
    pm_test_ran ran =
        pm_command_run(whole, pm_command_write("g.csv", PHOTONS), pm_room_scene());
    pm_command_check_refusal("weights", &ran, "r.json: it must have \"gathered\"");
    CHECK_THAT(stat(pm_command_path("out.png"), &there) != 0, "%s", "a picture was left");
    pm_test_ran_free(&ran);
}

PM_TESTS({"view_weights.1",
          "photons have the colours of their weights; numbers are the report's",
          photons_have_the_colour_of_their_weight},
         {"view_weights.2", "a photon that counts more is larger",
          photons_that_count_more_are_larger},
         {"view_weights.3", "a photon that counts for nothing is a ring; the disc has its rim",
          a_photon_that_counts_for_nothing_is_a_ring},
         {"view_weights.4", "powers times weights add up to filtering's irradiance",
          weights_add_up_to_the_irradiance},
         {"view_weights.5", "photons are written of one point only",
          only_one_point_has_its_photons_written},
         {"view_weights.6", "broken files of weights are refused with file and line",
          broken_files_are_refused})

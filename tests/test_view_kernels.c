// Pictures of kernels: curves where the file has them, and the means that filtering tells.
#include "command.h"
#include "kernel_file.h"
#include "seen.h"

#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#define HEADER "kernel,distance,weight,inside\n"
#define FLAT "none,0,1,0\nnone,0.5,1,0.25\nnone,1,1,1\n"
// A cone that falls to 0, and the Gaussian with both constants, roughly.
#define CONE "cone,0,3,0\ncone,0.5,1.5,0.5\ncone,1,0,1\n"
#define RIGHT "gaussian,0,1.7283,0\ngaussian,0.5,1.3,0.36\ngaussian,1,0.4728,1\n"
#define SAME "none-lecture,0,1,0\nnone-lecture,0.5,1,0.25\nnone-lecture,1,1,1\n"
#define WRONG                                                                                  \
    "gaussian-lecture,0,0.918,0\ngaussian-lecture,0.5,0.69,0.19\ngaussian-lecture,1,0.2512,"   \
    "0.531155\n"

static const uint8_t white[3] = {245, 245, 245};
static const uint8_t orange[3] = {230, 159, 0};
static const uint8_t sky[3] = {86, 180, 233};

static pm_seen look(const char *text)
{
    return pm_seen_look("view kernels {S} --size 640x480", pm_command_write("k.csv", text),
                        NULL);
}

/// Whether a curve of this colour passes a point of a chart.
static bool passes(const pm_seen *seen, int chart, double x, double y, const uint8_t colour[3])
{
    int px;
    int py;
    pm_seen_chart(seen, chart, x, y, &px, &py);
    return pm_seen_near(seen, px, py, 1, colour, 70);
}

static void curves_run_where_weights_are(void)
{
    pm_seen s = look(HEADER FLAT CONE);
    CHECK(passes(&s, 0, 0.25, 1.0, white));
    CHECK(passes(&s, 0, 0.25, 2.25, orange));
    CHECK(passes(&s, 0, 0.75, 0.75, orange));
    CHECK(!passes(&s, 0, 0.25, 1.6, orange) && !passes(&s, 0, 0.25, 1.6, white));
    CHECK(passes(&s, 1, 0.75, 0.625, white));
    CHECK(passes(&s, 1, 0.25, 0.25, orange));
    CHECK_NEAR(pm_seen_number(&s, "charts.0.x_ends.1"), 1.0, 0.0);
    CHECK_NEAR(pm_seen_number(&s, "drawn"), 2.0, 0.0);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "all of these do");
    pm_seen_free(&s);
}

/// Dashes have gaps, lines have none: pixels of a curve's colour along it.
static int count_along(const pm_seen *seen, double y0, double y1, const uint8_t colour[3])
{
    int count = 0;
    for (int i = 0; i < 80; i++) {
        double x = 0.55 + 0.4 * i / 79.0;
        count += passes(seen, 0, x, y0 + (y1 - y0) * (x - 0.5) / 0.5, colour);
    }
    return count;
}

static void a_constant_that_loses_light_is_dashed_and_named(void)
{
    pm_seen s = look(HEADER FLAT RIGHT SAME WRONG);
    CHECK_CONTAINS(pm_seen_text(&s, "note"),
                   "Gaussian with the lecture's constant loses 46.9 % of the light");
    CHECK_NEAR(pm_seen_number(&s, "drawn"), 3.0, 0.0); // SAME lies on FLAT
    CHECK(count_along(&s, 1.3, 0.4728, sky) == 80);
    int dashed = count_along(&s, 0.69, 0.2512, sky);
    CHECK_THAT(dashed > 30 && dashed < 75, "%d of 80 pixels of a dashed curve", dashed);
    pm_seen_free(&s);
}

static void wrong_kernels_are_drawn_as_they_are(void)
{
    pm_seen s = look(HEADER "cone,0,2,0\ncone,0.5,0.5,0.4\ncone,1,-1,0.3333\n"
                            "blurred,0,1.2,0\nblurred,1,1.2,1.2\n");
    CHECK(passes(&s, 0, 0.9, -0.7, orange));
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "cone loses 66.7 % of the light; blurred adds "
                                             "20.0 % of the light");
    pm_seen_free(&s);
}

static void means_are_those_of_filtering(void)
{
    char line[512];
    const char *curves = pm_command_path("curves.csv");
    snprintf(line, sizeof line,
             "filtering {S} -n 100 -k 5 --at 0,0,0 --normal 0,0,1 --json --curves {O}");
    pm_test_ran ran = pm_command_run(line, "scenes/square-over-floor.xml", curves);
    CHECK_THAT(ran.exit_code == 0, "%s", ran.err);
    json_t *told = json_loads(ran.out, 0, NULL);
    pm_seen s = pm_seen_look("view kernels {S} --size 640x480", curves, NULL);
    const char *name;
    json_t *mean;
    int count = 0;
    json_object_foreach(pm_seen_member(&s, "means"), name, mean)
    {
        const json_t *row = json_object_get(json_object_get(told, "filters"), name);
        double want = json_number_value(json_object_get(row, "mean_weight")) /
                      json_number_value(json_object_get(row, "normalisation"));
        CHECK_NEAR(json_number_value(mean), want, 1e-8);
        count++;
    }
    CHECK(count == 8);
    CHECK_NEAR(pm_seen_number(&s, "drawn"), 5.0, 0.0);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "loses 46.9 %");
    CHECK(passes(&s, 0, 0.5, (1.0 - 0.5 / 1.1) / (1.0 - 2.0 / 3.3), orange));
    pm_seen_free(&s);
    json_decref(told);
    pm_test_ran_free(&ran);
}

static void broken_files_are_refused(void)
{
    static const struct {
        const char *text, *part;
    } bad[] = {
        {"", "k.csv:1: the file is empty; write it with filtering --curves"},
        {HEADER, "k.csv:2: the file holds no kernel"},
        {HEADER "none,0.5,1,0\n",
         "k.csv:2: the distances of a kernel must begin at 0, got 0.5"},
        {HEADER FLAT "none,0,1,0\n", "k.csv:5: the distances of a kernel must rise, got 0"},
        {HEADER "none,0,1,0\nnone,1.5,1,1\n",
         "k.csv:3: the distances of a kernel must end at 1, got 1.5"},
        {HEADER "none,0,1,0\n", "k.csv:3: the distances of a kernel must end at 1, got 0"},
        {HEADER "none,0,1,0\ncone,0,1,0\n",
         "k.csv:3: the distances of a kernel must end at 1 before the next begins, got 0"},
        {HEADER FLAT CONE FLAT, "k.csv:8: the kernel none has ended already"},
        {HEADER "none,0,nan,0\n", "k.csv:2: weight must be a finite number, got \"nan\""},
        {HEADER "none,0,1\n", "k.csv:2: a row has 4 fields, got 3"},
        {HEADER "A b,0,1,0\n", "k.csv:2: a kernel's name is made of a-z, 0-9 and -"},
        {HEADER "none,0,1,0", "k.csv:2: the file ends in the middle of a line"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        pm_kernel_set set;
        CHECK_FAILS(pm_kernel_file_read(pm_command_write("k.csv", bad[i].text), &set),
                    PM_EINPUT, bad[i].part);
    }
    struct stat there;
    const char *out = pm_command_path("out.png");
    pm_test_ran ran =
        pm_command_run("view kernels {S} -o {O}", pm_command_write("k.csv", bad[1].text), out);
    pm_command_check_refusal("kernels", &ran, bad[1].part);
    CHECK_THAT(stat(out, &there) != 0, "%s", "a picture was left behind");
    pm_test_ran_free(&ran);
}

PM_TESTS({"view_kernels.1", "a kernel's curve runs where its weights are",
          curves_run_where_weights_are},
         {"view_kernels.2", "a lecture's constant that loses light is dashed and named",
          a_constant_that_loses_light_is_dashed_and_named},
         {"view_kernels.3", "wrong kernels are drawn as they are, negative weights too",
          wrong_kernels_are_drawn_as_they_are},
         {"view_kernels.4", "the means of a picture are those that filtering tells",
          means_are_those_of_filtering},
         {"view_kernels.5", "broken files of kernels are refused with file and line",
          broken_files_are_refused})

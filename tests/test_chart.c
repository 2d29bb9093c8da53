// Charts: a datum is seen at its place in its colour, axes hold their data and say what they
// mean in plain numbers, and what cannot be drawn is refused. The page is
// tests/charts/sample.c.
#include "command.h"
#include "seen.h"

#include <string.h>
#include <sys/stat.h>

enum { KERNELS, TRADE, SHARES, STEPS };

static const uint8_t orange[] = {230, 159, 0};
static const uint8_t sky[] = {86, 180, 233};
static const uint8_t green[] = {0, 158, 115};
static const uint8_t yellow[] = {240, 228, 66};
static const uint8_t purple[] = {204, 121, 167};
static const uint8_t white[] = {236, 239, 244};

static pm_test_ran run_sample(const char *path, const char *fault)
{
    if (strlen(PM_TEST_CHARTS) == 0) {
        pm_test_skip("charts are not built, because VTK is missing", "libvtk9-dev");
    }
    const char *argv[] = {PM_TEST_CHARTS, path, "900x675", fault, NULL};
    return pm_test_run(argv, 30.0);
}

static pm_seen look(void)
{
    const char *path = pm_command_path("charts.png");
    pm_test_ran ran = run_sample(path, NULL);
    CHECK_THAT(ran.exit_code == 0 && ran.err[0] == '\0', "exit %d: %s", ran.exit_code, ran.err);
    pm_seen seen = pm_seen_read(path);
    seen.answer = json_loads(ran.out, 0, NULL);
    CHECK(seen.answer != NULL);
    pm_test_ran_free(&ran);
    return seen;
}

static bool is_about(const pm_seen *s, int chart, double x, double y, const uint8_t *colour,
                     int reach, int tolerance)
{
    int px;
    int py;
    pm_seen_chart(s, chart, x, y, &px, &py);
    return pm_seen_near(s, px, py, reach, colour, tolerance);
}

/// Whether the colour is seen within `reach` pixels of a pair of values.
static bool is_at(const pm_seen *s, int chart, double x, double y, const uint8_t *colour,
                  int reach)
{
    return is_about(s, chart, x, y, colour, reach, 12);
}

/// The same for the strokes of error bars, thinner than two pixels, and their caps.
static bool has_stroke(const pm_seen *s, double x, double y)
{
    return is_about(s, TRADE, x, y, green, 2, 45);
}

static void datum_is_at_its_place(void)
{
    pm_seen s = look();
    CHECK(is_at(&s, KERNELS, 0.5, 1.5, orange, 1));
    CHECK(!is_at(&s, KERNELS, 0.5, 1.7, orange, 1));
    CHECK(is_at(&s, KERNELS, 0.3, 1.0, sky, 6)); // a dash or the gap before it
    CHECK(is_at(&s, TRADE, 1.0, 0.1, green, 0));
    CHECK(is_at(&s, TRADE, 30.0, 0.002, green, 0));
    CHECK(is_at(&s, STEPS, 40.0, 7.0, purple, 1));
    CHECK(is_at(&s, STEPS, 60.0, 4.0, purple, 1));
    CHECK(is_at(&s, STEPS, 75.0, 2.0, white, 1));
    pm_seen_free(&s);
}

static void bars_reach_their_value(void)
{
    pm_seen s = look();
    CHECK(is_at(&s, SHARES, 0.8, 24000.0, sky, 0));
    CHECK(!is_at(&s, SHARES, 0.8, 26000.0, sky, 0));
    CHECK(is_at(&s, SHARES, 2.2, 100.0, yellow, 0));
    CHECK(is_at(&s, SHARES, 2.2, 64000.0, yellow, 0));
    CHECK(!is_at(&s, SHARES, 2.2, 66500.0, yellow, 0));
    CHECK(!is_at(&s, SHARES, 1.5, 10000.0, sky, 0));
    pm_seen_free(&s);
}

static void errors_reach_both_ends(void)
{
    pm_seen s = look();
    CHECK(has_stroke(&s, 30.0, 0.002 * 1.38));
    CHECK(has_stroke(&s, 30.0, 0.002 * 0.72));
    CHECK(!has_stroke(&s, 30.0, 0.002 * 2.0));
    CHECK(has_stroke(&s, 0.2 * 0.82, 0.5));
    CHECK(has_stroke(&s, 0.2 * 1.22, 0.5));
    int x;
    int y;
    pm_seen_chart(&s, TRADE, 10.0, 0.0126, &x, &y); // the band's middle, half way
    const uint8_t *band = pm_seen_at(&s, x, y);
    CHECK(band[1] > band[0] + 25 && band[1] < 120);
    pm_seen_free(&s);
}

static void check_labels(const pm_seen *s, const char *key, const char *want)
{
    char got[256] = "";
    const json_t *labels = pm_seen_member(s, key);
    size_t i;
    json_t *label;
    json_array_foreach(labels, i, label)
    {
        strcat(got, i > 0 ? " " : "");
        strcat(got, json_string_value(label));
    }
    CHECK_THAT(strcmp(got, want) == 0, "%s: \"%s\", not \"%s\"", key, got, want);
}

static void labels_are_plain_numbers(void)
{
    pm_seen s = look();
    check_labels(&s, "charts.0.y_labels", "0.0 0.5 1.0 1.5 2.0 2.5");
    check_labels(&s, "charts.1.y_labels", "0.001 0.01 0.1 1");
    check_labels(&s, "charts.1.x_labels", "1 10");
    check_labels(&s, "charts.2.y_labels", "0 20,000 40,000 60,000");
    check_labels(&s, "charts.2.x_labels", "lamp window sun");
    CHECK_NEAR(pm_seen_number(&s, "charts.0.y_ends.1"), 2.5, 0.0);
    CHECK(pm_seen_number(&s, "charts.1.x_ends.0") < 0.16);
    CHECK(pm_seen_number(&s, "charts.1.y_ends.0") < 0.0014);
    CHECK(pm_seen_number(&s, "charts.1.y_ends.1") > 0.7);
    pm_seen_free(&s);
}

static void faults_are_refused(void)
{
    static const struct {
        const char *fault, *part;
    } bad[] = {{"nan", "a chart's y must be finite, got nan as number 1 of \"Faults\""},
               {"zero", "must be finite and > 0 on a logarithmic axis, got 0"},
               {"ends", "a chart's x axis must go up, got 2 to 1"},
               {"late", "a chart that is closed takes nothing more"}};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        const char *path = pm_command_path("bad.png");
        pm_test_ran ran = run_sample(path, bad[i].fault);
        struct stat there;
        CHECK_THAT(ran.exit_code == 2, "%s: exit %d", bad[i].fault, ran.exit_code);
        CHECK_CONTAINS(ran.err, bad[i].part);
        CHECK(stat(path, &there) != 0);
        pm_test_ran_free(&ran);
    }
}

PM_TESTS({"chart.1", "a datum is seen at its place on a chart, in its colour",
          datum_is_at_its_place},
         {"chart.2", "a bar reaches its value and no further", bars_reach_their_value},
         {"chart.3", "error bars and bands reach from their low to their high end",
          errors_reach_both_ends},
         {"chart.4", "axes hold their data, with labels as people write numbers",
          labels_are_plain_numbers},
         {"chart.5", "values that a chart cannot show are refused", faults_are_refused})

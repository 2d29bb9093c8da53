// `view trade` on measurements written by hand: a point stands where its time and its error
// are.
#include "command.h"
#include "seen.h"
#include "trade_names.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const uint8_t orange[3] = {230, 159, 0};
static const uint8_t sky[3] = {86, 180, 233};
static const uint8_t white[3] = {245, 245, 245};
static const uint8_t purple[3] = {204, 121, 167};

// Errors 0.4, 0.2, 0.3, 0.1. Point 2 is beaten by point 1. `packing` never differs, `k` only
// off the Pareto line.
static const char measured[] =
    "{\"points\": [\n"
    "{\"settings\": {\"photons\": 1000, \"gather\": 0, \"packing\": true, \"k\": 50},\n"
    " \"seconds\": {\"mean\": 0.1, \"sd\": 0.02}, \"rel_mse\": {\"mean\": 0.16, \"sd\": "
    "0.08},\n"
    " \"bias\": 0.3, \"variance\": 0.07, \"peak_bytes\": 12000000},\n"
    "{\"settings\": {\"photons\": 20000, \"gather\": 0, \"packing\": true, \"k\": 50},\n"
    " \"seconds\": 1, \"rel_mse\": 0.04, \"bias\": 0.1, \"variance\": 0.03},\n"
    "{\"settings\": {\"photons\": 20000, \"gather\": 64, \"packing\": true, \"k\": 99},\n"
    " \"seconds\": 3, \"rel_mse\": 0.09},\n"
    "{\"settings\": {\"photons\": 400000, \"gather\": 64, \"packing\": true, \"k\": 50},\n"
    " \"seconds\": 10, \"rel_mse\": 0.01, \"bias\": 0.05, \"variance\": 0.0075}],\n"
    "\"pareto\": [3, 0, 1], \"slope\": -0.301}\n";

static pm_seen look(const char *text)
{
    return pm_seen_look("view trade {S} --size 800x600", pm_command_write("t.json", text),
                        NULL);
}

static bool is_there(const pm_seen *s, int chart, double x, double y, const uint8_t colour[3])
{
    int px = 0;
    int py = 0;
    pm_seen_chart(s, chart, x, y, &px, &py);
    return pm_seen_near(s, px, py, 2, colour, 60);
}

static pm_trade read(const char *text)
{
    pm_trade trade;
    CHECK_OK(pm_trade_file_read(pm_command_write("t.json", text), &trade));
    return trade;
}

static void fewest_values_give_the_colours(void)
{
    pm_trade trade = read(measured);
    pm_trade_groups groups;
    CHECK_OK(pm_trade_group(&trade, &groups));
    CHECK(strcmp(groups.option, "gather") == 0 &&
          groups.count == 2); // k has two, too, but later
    CHECK(strcmp(groups.value[0], "0") == 0 && strcmp(groups.value[1], "64") == 0);
    CHECK(groups.group[0] == 0 && groups.group[1] == 0);
    CHECK(groups.group[2] == 1 && groups.group[3] == 1);
    pm_trade_groups_free(&groups);
    pm_trade_file_free(&trade);
}

static void numbers_are_sorted_and_absence_is_a_value(void)
{
    pm_trade trade = read("{\"points\": ["
                          "{\"settings\": {\"k\": 100}, \"seconds\": 1, \"rel_mse\": 1},"
                          "{\"settings\": {\"k\": 20}, \"seconds\": 1, \"rel_mse\": 1},"
                          "{\"settings\": {}, \"seconds\": 1, \"rel_mse\": 1}],"
                          "\"pareto\": [0, 1]}");
    pm_trade_groups groups;
    CHECK_OK(pm_trade_group(&trade, &groups));
    CHECK(groups.count == 3 && groups.group[0] == 2 && groups.group[1] == 1);
    CHECK(strcmp(groups.value[0], "not set") == 0 && strcmp(groups.value[2], "100") == 0);
    pm_trade_groups_free(&groups);
    pm_trade_file_free(&trade);
}

static void too_many_settings_end_in_dots(void)
{
    char name[24];
    pm_trade trade = read(measured);
    pm_trade_name(&trade, 3, name, sizeof name);
    CHECK_THAT(strcmp(name, "photons 400k...") == 0, "%s", name);
    snprintf(trade.point[3].name, sizeof trade.point[3].name, "lecture");
    pm_trade_name(&trade, 3, name, sizeof name);
    CHECK(strcmp(name, "lecture") == 0);
    pm_trade_file_free(&trade);
}

static void check_points(const pm_seen *s)
{
    CHECK(strcmp(pm_seen_text(s, "coloured_by"), "gather") == 0);
    CHECK(is_there(s, 0, 0.1, 0.4, orange) && is_there(s, 0, 1.0, 0.2, orange));
    CHECK(is_there(s, 0, 3.0, 0.3, sky) && is_there(s, 0, 10.0, 0.1, sky));
    CHECK(!is_there(s, 0, 3.0, 0.15, sky));
}

static void check_bars(const pm_seen *s)
{
    CHECK(is_there(s, 0, 0.08, 0.4, orange) && is_there(s, 0, 0.12, 0.4, orange));
    CHECK(!is_there(s, 0, 0.07, 0.4, orange) && !is_there(s, 0, 0.14, 0.4, orange));
    CHECK(is_there(s, 0, 0.1, sqrt(0.08), orange) && is_there(s, 0, 0.1, sqrt(0.24), orange));
    CHECK(!is_there(s, 0, 0.1, sqrt(0.06), orange));
}

static void check_line(const pm_seen *s)
{
    CHECK(is_there(s, 0, sqrt(0.1), sqrt(0.4 * 0.2), white));
    CHECK(is_there(s, 0, sqrt(10.0), sqrt(0.2 * 0.1), white));
    CHECK(!is_there(s, 0, sqrt(3.0), sqrt(0.2 * 0.3), white)); // point 2 is not on it
    CHECK(pm_seen_number(s, "pareto.0.point") == 0.0);         // by time
    CHECK(strcmp(pm_seen_text(s, "pareto.0.name"), "photons 1000, gather 0") == 0);
    CHECK(strcmp(pm_seen_text(s, "pareto.1.name"), "photons 20k, gather 0") == 0);
    CHECK(strcmp(pm_seen_text(s, "pareto.2.name"), "photons 400k, gather 64") == 0);
}

static void check_parts(const pm_seen *s)
{
    CHECK(is_there(s, 1, 0.1, 0.09, purple) && is_there(s, 1, 0.1, 0.07, white));
    CHECK(is_there(s, 1, 10.0, 0.0025, purple) && is_there(s, 1, 10.0, 0.0075, white));
    CHECK_NEAR(pm_seen_number(s, "charts.1.x_ends.0"), pm_seen_number(s, "charts.0.x_ends.0"),
               0.0);
}

static void points_stand_at_time_and_error(void)
{
    pm_seen s = look(measured);
    check_points(&s);
    check_bars(&s);
    check_line(&s);
    check_parts(&s);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "4 settings, 3 on the Pareto line");
    CHECK_CONTAINS(pm_seen_text(&s, "note"),
                   "Slope -0.301: ten times the time, 0.5 of the error.");
    pm_seen_free(&s);
}

// Against a reference with halves an error may come out below 0.
static void errors_without_a_logarithm_are_counted(void)
{
    pm_seen s = look("{\"points\": [{\"settings\": {}, \"seconds\": 2, \"rel_mse\": 0.25},"
                     "{\"settings\": {}, \"seconds\": 3, \"rel_mse\": -0.001},"
                     "{\"settings\": {}, \"seconds\": 1, \"rel_mse\": 0}],"
                     " \"pareto\": [0, 1], \"slope\": {\"fixed k\": -0.1, \"best k\":"
                     " {\"measured\": -0.3, \"predicted\": -0.333}}}");
    CHECK(pm_seen_number(&s, "drawn") == 1.0);
    CHECK(is_there(&s, 0, 2.0, 0.5, orange));
    CHECK(json_array_size(pm_seen_member(&s, "charts")) == 1);
    CHECK(strcmp(pm_seen_text(&s, "pareto.0.name"), "all settings alike") == 0);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "2 not drawn: error 0 or below.");
    pm_seen_free(&s);
}

static void check_refused(const char *text, const char *words)
{
    pm_trade trade;
    CHECK_FAILS(pm_trade_file_read(pm_command_write("t.json", text), &trade), PM_EINPUT, words);
}

static void what_is_no_json_has_its_line(void)
{
    check_refused("{\"points\": [\n{\"settings\": {},\n \"seconds\": nan}]}",
                  "t.json:3: this is no JSON");
    check_refused("{\"points\": [\n{\"seconds\": 1,\n\"seconds\": 2}]}",
                  "t.json:3: this is no JSON");
    check_refused("{\"points\": [", "t.json:1: this is no JSON");
    check_refused("", "t.json:1: this is no JSON");
    check_refused("{\"points\": [{\"settings\": {}, \"seconds\": 1e999}]}",
                  "t.json:1: this is");
}

/// One point with these members, and a Pareto line of it.
static void check_point_refused(const char *members, const char *words)
{
    char text[512];
    snprintf(text, sizeof text, "{\"points\": [{%s}], \"pareto\": [0]}", members);
    check_refused(text, words);
}

static void what_is_no_trade_has_its_place(void)
{
    check_refused("[]", "t.json: must be an object as tradeoff writes it, got a list");
    check_refused("{}", "t.json: points must be a list of 1 to 4096, got nothing");
    check_point_refused("\"settings\": {}, \"rel_mse\": 1",
                        "points[0].seconds must be a number, got nothing");
    check_point_refused("\"settings\": {}, \"seconds\": 0, \"rel_mse\": 1",
                        "points[0].seconds must be > 0, got 0");
    check_point_refused(
        "\"settings\": {}, \"seconds\": {\"mean\": 1, \"sd\": -1}, \"rel_mse\": 1",
        "points[0].seconds.sd must be finite and >= 0, got -1");
    check_point_refused(
        "\"settings\": {\"k\": [1]}, \"seconds\": 1, \"rel_mse\": 1",
        "points[0].settings.k must be a number, a text or a boolean, got a list");
    check_point_refused("\"settings\": 3, \"seconds\": 1, \"rel_mse\": 1",
                        "points[0].settings must be an object");
    check_point_refused("\"settings\": {}, \"seconds\": 1, \"rel_mse\": 1, \"bias\": 1",
                        "points[0].variance must be a number, got nothing");
}

static void a_wrong_line_has_its_place(void)
{
    const char *point = "{\"settings\": {}, \"seconds\": 1, \"rel_mse\": 1}";
    const char *const ends[4][2] = {
        {"\"pareto\": [1]", "t.json: pareto[0] must be a point's number from 0 to 0"},
        {"\"pareto\": [0, 0]", "t.json: pareto[1] must be a point's number"},
        {"\"slope\": 0", "t.json: pareto must be a list of points' numbers, got nothing"},
        {"\"pareto\": [0], \"slope\": {\"best\": \"flat\"}",
         "t.json: slope.best must be a number, got a text"},
    };
    for (int i = 0; i < 4; i++) {
        char text[256];
        snprintf(text, sizeof text, "{\"points\": [%s], %s}", point, ends[i][0]);
        check_refused(text, ends[i][1]);
    }
}

static void the_program_refuses_and_leaves_nothing(void)
{
    static const char *const bad[2][2] = {
        {"{\"points\": [{\"settings\": {}, \"seconds\": 1, \"rel_mse\": 0}], \"pareto\": []}",
         "t.json: no point has an error above 0"},
        {"{\"points\": [\n{", "t.json:2: this is no JSON"}};
    for (int i = 0; i < 2; i++) {
        const char *path = pm_command_write("t.json", bad[i][0]);
        int files = pm_command_count_files();
        pm_test_ran ran =
            pm_command_run("view trade {S} -o {O}", path, pm_command_path("o.png"));
        pm_command_check_refusal("view trade", &ran, bad[i][1]);
        CHECK(pm_command_count_files() == files);
        pm_test_ran_free(&ran);
    }
}

PM_TESTS(
    {"view_trade.1", "points, bars, Pareto line and the error's parts stand where they are",
     points_stand_at_time_and_error},
    {"view_trade.2", "errors that have no logarithm are counted and not drawn",
     errors_without_a_logarithm_are_counted},
    {"view_trade.3", "the setting with the fewest values gives the colours",
     fewest_values_give_the_colours},
    {"view_trade.4", "groups are in the order of their numbers; not set is a value",
     numbers_are_sorted_and_absence_is_a_value},
    {"view_trade.5", "a name that does not fit ends in dots", too_many_settings_end_in_dots},
    {"view_trade.6", "what is no JSON is refused with its line", what_is_no_json_has_its_line},
    {"view_trade.7", "what is no trade is refused with its place",
     what_is_no_trade_has_its_place},
    {"view_trade.8", "a Pareto line or slope of something else is refused",
     a_wrong_line_has_its_place},
    {"view_trade.9", "the program refuses in one line and leaves no picture",
     the_program_refuses_and_leaves_nothing})

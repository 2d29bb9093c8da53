// A page of charts with known data, for tests and for the eye: everything that chart.h can do.
//
//     sample OUT.png [WxH]      prints where everything is, as `view --json` does
//     sample OUT.png WxH FAULT  puts one of these on a chart: nan, zero, ends, late
#include "chart.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT 60

static pm_status draw_curves(pm_figure *figure, const pm_rect *where)
{
    double x[COUNT];
    double y[2][COUNT];
    for (int i = 0; i < COUNT; i++) {
        x[i] = i / (COUNT - 1.0);
        y[0][i] = 2.0 * (1.0 - x[i] * x[i]);
        y[1][i] = 1.0;
    }
    pm_chart_axes axes = {.heading = "Kernels",
                          .x_title = "distance / radius",
                          .y_title = "weight",
                          .x_high = 1.0,
                          .y_high = 2.5};
    pm_chart *chart = NULL;
    PM_TRY(pm_chart_open(figure, where, &axes, &chart));
    PM_TRY(pm_chart_curve(chart, "Epanechnikov", pm_colour_named(PM_COLOUR_ORANGE),
                          PM_CHART_LINE, x, y[0], COUNT));
    PM_TRY(pm_chart_curve(chart, "none", pm_colour_named(PM_COLOUR_SKY), PM_CHART_DASHES, x,
                          y[1], COUNT));
    return pm_chart_close(chart);
}

static pm_status draw_trade(pm_figure *figure, const pm_rect *where)
{
    const double seconds[] = {0.2, 1.0, 3.0, 30.0};
    const double error[] = {0.5, 0.1, 0.08, 0.002};
    double low[4];
    double high[4];
    double fast[4];
    double slow[4];
    for (int i = 0; i < 4; i++) {
        low[i] = 0.7 * error[i];
        high[i] = 1.4 * error[i];
        fast[i] = 0.8 * seconds[i];
        slow[i] = 1.25 * seconds[i];
    }
    pm_colour green = pm_colour_named(PM_COLOUR_GREEN);
    pm_chart_axes axes = {.heading = "Error against time",
                          .x_title = "time [s]",
                          .y_title = "relative error",
                          .x_log = true,
                          .y_log = true};
    pm_chart *chart = NULL;
    PM_TRY(pm_chart_open(figure, where, &axes, &chart));
    PM_TRY(pm_chart_band(chart, "spread", green, seconds, low, high, 4));
    PM_TRY(pm_chart_errors(chart, green, seconds, low, high, 4));
    PM_TRY(pm_chart_errors_x(chart, green, error, fast, slow, 4));
    PM_TRY(pm_chart_curve(chart, "runs", green, PM_CHART_DOTS, seconds, error, 4));
    for (int i = 0; i < 4; i++) {
        char word[32];
        snprintf(word, sizeof word, "k %d", 50 << i);
        PM_TRY(pm_chart_word(chart, seconds[i], error[i], word));
    }
    return pm_chart_close(chart);
}

static pm_status draw_shares(pm_figure *figure, const pm_rect *where)
{
    static const char *const names[] = {"lamp", "window", "sun"};
    const double power[] = {1000.0, 25000.0, 64000.0};
    const double want[] = {1200.0, 24000.0, 65000.0};
    const double left[] = {-0.2, 0.8, 1.8};
    const double right[] = {0.2, 1.2, 2.2};
    pm_chart_axes axes = {
        .heading = "Photons", .y_title = "photons", .x_names = names, .x_name_count = 3};
    pm_chart *chart = NULL;
    PM_TRY(pm_chart_open(figure, where, &axes, &chart));
    PM_TRY(
        pm_chart_bars(chart, "emitted", pm_colour_named(PM_COLOUR_SKY), left, power, 3, 0.36));
    PM_TRY(pm_chart_bars(chart, "by power", pm_colour_named(PM_COLOUR_YELLOW), right, want, 3,
                         0.36));
    return pm_chart_close(chart);
}

static pm_status draw_steps(pm_figure *figure, const pm_rect *where)
{
    const double edge[] = {0.0, 30.0, 60.0, 90.0};
    const double count[] = {3.0, 7.0, 2.0, 2.0};
    const double at[] = {15.0, 45.0, 75.0};
    pm_chart_axes axes = {.x_title = "angle [deg]", .y_title = "photons", .x_high = 90.0};
    pm_chart *chart = NULL;
    PM_TRY(pm_chart_open(figure, where, &axes, &chart));
    PM_TRY(pm_chart_curve(chart, "histogram", pm_colour_named(PM_COLOUR_PURPLE), PM_CHART_STEPS,
                          edge, count, 4));
    PM_TRY(pm_chart_curve(chart, "expected", pm_colour_named(PM_COLOUR_WHITE),
                          PM_CHART_DIAMONDS, at, count, 3));
    return pm_chart_close(chart);
}

static pm_status draw(pm_figure *figure)
{
    pm_status (*const draws[])(pm_figure *, const pm_rect *) = {draw_curves, draw_trade,
                                                                draw_shares, draw_steps};
    pm_rect room = pm_figure_room(figure);
    for (int i = 0; i < 4; i++) {
        pm_rect where = {room.x + (i % 2) * room.width / 2 + 8,
                         room.y + (i / 2) * room.height / 2, room.width / 2 - 16,
                         room.height / 2 - 8};
        PM_TRY(draws[i](figure, &where));
    }
    return pm_figure_title(figure, "Charts", "every thing that a chart can show");
}

/// What a chart must refuse.
static pm_status draw_fault(pm_figure *figure, const char *fault)
{
    const double good[] = {1.0, 2.0};
    const double bad[] = {1.0, strcmp(fault, "nan") == 0 ? (double)NAN : 0.0};
    pm_chart_axes axes = {.heading = "Faults", .y_log = strcmp(fault, "zero") == 0};
    if (strcmp(fault, "ends") == 0) {
        axes.x_low = 2.0;
        axes.x_high = 1.0;
    }
    pm_rect where = pm_figure_room(figure);
    pm_colour white = pm_colour_named(PM_COLOUR_WHITE);
    pm_chart *chart = NULL;
    PM_TRY(pm_chart_open(figure, &where, &axes, &chart));
    if (strcmp(fault, "late") == 0) {
        PM_TRY(pm_chart_close(chart));
    }
    PM_TRY(pm_chart_curve(chart, NULL, white, PM_CHART_LINE, good, bad, 2));
    return pm_chart_close(chart);
}

static pm_status make(const char *path, int width, int height, const char *fault)
{
    pm_figure *figure = NULL;
    PM_TRY(pm_figure_open_flat(width, height, &figure));
    pm_status status = fault == NULL ? draw(figure) : draw_fault(figure, fault);
    if (status == PM_OK) {
        status = pm_figure_write(figure, path);
    }
    if (status == PM_OK) {
        json_t *places = pm_figure_json(figure, pm_vec(0.0, 0.0, 0.0));
        json_dumpf(places, stdout, JSON_COMPACT);
        json_decref(places);
    }
    pm_figure_close(figure);
    return status;
}

int main(int argc, char **argv)
{
    int width = 1200;
    int height = 900;
    if (argc < 2 || (argc > 2 && sscanf(argv[2], "%dx%d", &width, &height) != 2)) {
        fprintf(stderr, "sample OUT.png [WxH [FAULT]]\n");
        return 2;
    }
    if (make(argv[1], width, height, argc > 3 ? argv[3] : NULL) != PM_OK) {
        fprintf(stderr, "%s\n", pm_status_message());
        return 2;
    }
    return 0;
}

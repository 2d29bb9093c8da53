// Both charts have the same time axis, so that a part of the error stands under its point. On a
// logarithmic axis a bar that reaches 0 goes down to the frame.
#include "chart.h"
#include "trade_chart.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double margin = 1.3; // beyond the outermost value, as a ratio

typedef struct {
    double low, high;
} span;

static span grow(span s, double value)
{
    if (value > 0.0) {
        s.low = fmin(s.low, value);
        s.high = fmax(s.high, value);
    }
    return s;
}

static span with_margin(span s)
{
    return (span){s.low / margin, s.high * margin};
}

static span none(void)
{
    return (span){HUGE_VAL, 0.0};
}

/// Times of all points that are drawn, with their bars.
static span times_of(const pm_trade *trade)
{
    span s = none();
    for (int i = 0; i < trade->point_count; i++) {
        const pm_trade_point *p = &trade->point[i];
        if (pm_trade_drawable(p)) {
            s = grow(grow(s, p->seconds.mean - p->seconds.sd), p->seconds.mean);
            s = grow(s, p->seconds.mean + p->seconds.sd);
        }
    }
    return with_margin(s);
}

static double error_of(const pm_trade_point *p, double sds)
{
    return sqrt(fmax(p->rel_mse.mean + sds * p->rel_mse.sd, 0.0));
}

static span errors_of(const pm_trade *trade)
{
    span s = none();
    for (int i = 0; i < trade->point_count; i++) {
        const pm_trade_point *p = &trade->point[i];
        if (pm_trade_drawable(p)) {
            s = grow(grow(grow(s, error_of(p, -1.0)), error_of(p, 0.0)), error_of(p, 1.0));
        }
    }
    return with_margin(s);
}

static span parts_of(const pm_trade *trade)
{
    span s = none();
    for (int i = 0; i < trade->pareto_count; i++) {
        const pm_trade_point *p = &trade->point[trade->pareto[i]];
        if (p->split && pm_trade_drawable(p)) {
            s = grow(grow(s, p->bias * p->bias), p->variance);
        }
    }
    return with_margin(s);
}

pm_colour pm_trade_chart_colour(int group)
{
    static const pm_colour_name names[PM_TRADE_GROUPS_MAX] = {
        PM_COLOUR_ORANGE, PM_COLOUR_SKY,        PM_COLOUR_GREEN, PM_COLOUR_YELLOW,
        PM_COLOUR_BLUE,   PM_COLOUR_VERMILLION, PM_COLOUR_PURPLE};
    return pm_colour_named(names[group]);
}

static pm_status draw_point(pm_chart *chart, const pm_trade_point *p, pm_colour colour,
                            span times, span errors)
{
    double x = p->seconds.mean;
    double y = error_of(p, 0.0);
    if (p->seconds.sd > 0.0) {
        double low = fmax(x - p->seconds.sd, times.low);
        double high = x + p->seconds.sd;
        PM_TRY(pm_chart_errors_x(chart, colour, &y, &low, &high, 1));
    }
    if (p->rel_mse.sd > 0.0) {
        double low = fmax(error_of(p, -1.0), errors.low);
        double high = error_of(p, 1.0);
        PM_TRY(pm_chart_errors(chart, colour, &x, &low, &high, 1));
    }
    return pm_chart_curve(chart, NULL, colour, PM_CHART_DOTS, &x, &y, 1);
}

/// The line through the Pareto points, under the dots.
static pm_status draw_line(pm_chart *chart, const pm_trade *trade)
{
    double *x = malloc(2 * ((size_t)trade->pareto_count + 1) * sizeof *x);
    if (x == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %d points", trade->pareto_count);
    }
    double *y = x + trade->pareto_count;
    int count = 0;
    for (int i = 0; i < trade->pareto_count; i++) {
        const pm_trade_point *p = &trade->point[trade->pareto[i]];
        if (pm_trade_drawable(p)) {
            x[count] = p->seconds.mean;
            y[count++] = error_of(p, 0.0);
        }
    }
    pm_status status = count > 1 ? pm_chart_curve(chart, NULL, pm_colour_named(PM_COLOUR_WHITE),
                                                  PM_CHART_LINE, x, y, count)
                                 : PM_OK;
    free(x);
    return status;
}

static pm_status draw_numbers(pm_chart *chart, const pm_trade *trade)
{
    for (int i = 0; i < trade->pareto_count; i++) {
        char number[16];
        const pm_trade_point *p = &trade->point[trade->pareto[i]];
        snprintf(number, sizeof number, "%d", i + 1);
        if (pm_trade_drawable(p)) {
            PM_TRY(pm_chart_word(chart, p->seconds.mean, error_of(p, 0.0), number));
        }
    }
    return PM_OK;
}

pm_status pm_trade_chart_errors(pm_figure *figure, const pm_rect *where, const pm_trade *trade,
                                const pm_trade_groups *groups)
{
    pm_chart *chart;
    span times = times_of(trade);
    span errors = errors_of(trade);
    const pm_chart_axes axes = {.heading = "error against time",
                                .x_title = "seconds",
                                .y_title = "error (rel_rmse)",
                                .x_log = true,
                                .y_log = true,
                                .x_low = times.low,
                                .x_high = times.high,
                                .y_low = errors.low,
                                .y_high = errors.high};
    PM_TRY(pm_chart_open(figure, where, &axes, &chart));
    PM_TRY(draw_line(chart, trade));
    for (int i = 0; i < trade->point_count; i++) {
        if (pm_trade_drawable(&trade->point[i])) {
            PM_TRY(draw_point(chart, &trade->point[i], pm_trade_chart_colour(groups->group[i]),
                              times, errors));
        }
    }
    PM_TRY(draw_numbers(chart, trade));
    return pm_chart_close(chart);
}

static double bias2_of(const pm_trade_point *p)
{
    return p->bias * p->bias;
}

static double variance_of(const pm_trade_point *p)
{
    return p->variance;
}

/// One part of the error along the Pareto line, where it is above 0.
static pm_status draw_part(pm_chart *chart, const pm_trade *trade, const char *label,
                           pm_colour colour, pm_chart_look look,
                           double (*part)(const pm_trade_point *p))
{
    double *x = malloc(2 * ((size_t)trade->pareto_count + 1) * sizeof *x);
    if (x == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %d points", trade->pareto_count);
    }
    double *y = x + trade->pareto_count;
    int count = 0;
    for (int i = 0; i < trade->pareto_count; i++) {
        const pm_trade_point *p = &trade->point[trade->pareto[i]];
        if (p->split && pm_trade_drawable(p) && part(p) > 0.0) {
            x[count] = p->seconds.mean;
            y[count++] = part(p);
        }
    }
    pm_status status = PM_OK;
    if (count > 1) {
        status =
            pm_chart_curve(chart, NULL, pm_colour_dim(colour, 0.6), PM_CHART_LINE, x, y, count);
    }
    if (count > 0 && status == PM_OK) {
        status = pm_chart_curve(chart, label, colour, look, x, y, count);
    }
    free(x);
    return status;
}

pm_status pm_trade_chart_parts(pm_figure *figure, const pm_rect *where, const pm_trade *trade)
{
    pm_chart *chart;
    span times = times_of(trade);
    span parts = parts_of(trade);
    if (!(parts.high > 0.0)) {
        return PM_OK;
    }
    const pm_chart_axes axes = {
        .heading =
            "what the error of the numbered settings is made of: rel_mse = bias^2 + variance",
        .x_title = "seconds",
        .y_title = "part of rel_mse",
        .x_log = true,
        .y_log = true,
        .x_low = times.low,
        .x_high = times.high,
        .y_low = parts.low,
        .y_high = parts.high};
    PM_TRY(pm_chart_open(figure, where, &axes, &chart));
    PM_TRY(draw_part(chart, trade, "bias^2: stays in every run",
                     pm_colour_named(PM_COLOUR_PURPLE), PM_CHART_DIAMONDS, bias2_of));
    PM_TRY(draw_part(chart, trade, "variance: differs from run to run",
                     pm_colour_named(PM_COLOUR_WHITE), PM_CHART_DOTS, variance_of));
    return pm_chart_close(chart);
}

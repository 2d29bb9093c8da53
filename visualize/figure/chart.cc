// What goes on a chart: checked when it comes, kept until the chart is closed.
#include "chart.hh"

#include <cmath>
#include <memory>

namespace {

pm_status check_ends(const char *side, bool log, double low, double high)
{
    if (low == 0.0 && high == 0.0) {
        return PM_OK;
    }
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high)) {
        return PM_FAIL(PM_EINPUT, "a chart's %s axis must go up, got %g to %g", side, low,
                       high);
    }
    if (log && !(low > 0.0)) {
        return PM_FAIL(PM_EINPUT, "a logarithmic %s axis must be > 0, got %g", side, low);
    }
    return PM_OK;
}

pm_status check_values(const pm_chart *chart, const char *side, bool log,
                       const std::vector<double> &values)
{
    if (chart->closed) {
        return PM_FAIL(PM_EINPUT, "%s", "a chart that is closed takes nothing more");
    }
    for (size_t i = 0; i < values.size(); i++) {
        if (!std::isfinite(values[i]) || (log && !(values[i] > 0.0))) {
            return PM_FAIL(PM_EINPUT,
                           "a chart's %s must be finite%s, got %g as number %zu of \"%s\"",
                           side, log ? " and > 0 on a logarithmic axis" : "", values[i], i,
                           chart->heading.c_str());
        }
    }
    return PM_OK;
}

pm_chart_axis make_axis(const char *title, bool log, double low, double high)
{
    return {title != nullptr ? title : "", log, low, high, {}};
}

std::vector<double> copy(const double *values, int count)
{
    return std::vector<double>(values, values + count);
}

/// Bars stand on 0, which a logarithmic axis does not have: there they stand on its low end.
pm_status add(pm_chart *chart, const pm_chart_series &series)
{
    bool turned = series.kind == PM_CHART_IS_ERRORS_X;
    bool x_log = turned ? chart->y.log : chart->x.log;
    bool y_log = turned ? chart->x.log : chart->y.log;
    PM_TRY(check_values(chart, turned ? "y" : "x", x_log, series.x));
    PM_TRY(check_values(chart, turned ? "x" : "y", y_log, series.low));
    PM_TRY(check_values(chart, turned ? "x" : "y", y_log, series.high));
    chart->series.push_back(series);
    return PM_OK;
}

/// The ends of some values, so far.
struct range {
    double least = HUGE_VAL, most = -HUGE_VAL;

    void take(const std::vector<double> &values, double beside = 0.0)
    {
        for (double v : values) {
            least = std::fmin(least, v - beside);
            most = std::fmax(most, v + beside);
        }
    }

    void give(pm_chart_axis *axis) const
    {
        bool none = !(least <= most);
        axis->fit(none ? 1.0 : least, none ? 10.0 : most);
    }
};

void fit_axes(pm_chart *chart)
{
    range x;
    range y;
    for (const pm_chart_series &s : chart->series) {
        bool turned = s.kind == PM_CHART_IS_ERRORS_X;
        (turned ? y : x).take(s.x, 0.5 * s.width);
        (turned ? x : y).take(s.low);
        (turned ? x : y).take(s.high);
        if (s.kind == PM_CHART_IS_BARS && !chart->y.log) {
            y.take({0.0});
        }
    }
    x.give(&chart->x);
    y.give(&chart->y);
}

} // namespace

pm_status pm_chart_open(pm_figure *figure, const pm_rect *where, const pm_chart_axes *axes,
                        pm_chart **chart)
{
    return pm_figure_guard("a chart", [&] {
        PM_TRY(check_ends("x", axes->x_log, axes->x_low, axes->x_high));
        PM_TRY(check_ends("y", axes->y_log, axes->y_low, axes->y_high));
        auto made = std::make_shared<pm_chart>();
        made->figure = figure;
        made->where = *where;
        made->heading = axes->heading != nullptr ? axes->heading : "";
        made->x = make_axis(axes->x_title, axes->x_log, axes->x_low, axes->x_high);
        made->y = make_axis(axes->y_title, axes->y_log, axes->y_low, axes->y_high);
        for (int i = 0; axes->x_names != nullptr && i < axes->x_name_count; i++) {
            made->x.names.push_back(axes->x_names[i]);
        }
        figure->open_charts.push_back(made);
        *chart = made.get();
        return PM_OK;
    });
}

pm_status pm_chart_curve(pm_chart *chart, const char *label, pm_colour colour,
                         pm_chart_look look, const double *x, const double *y, int count)
{
    return pm_figure_guard("a curve", [&] {
        return add(chart, {PM_CHART_IS_CURVE,
                           label != nullptr ? label : "",
                           colour,
                           look,
                           copy(x, count),
                           {},
                           copy(y, count),
                           0.0});
    });
}

pm_status pm_chart_bars(pm_chart *chart, const char *label, pm_colour colour, const double *x,
                        const double *height, int count, double width)
{
    return pm_figure_guard("bars", [&] {
        return add(chart, {PM_CHART_IS_BARS,
                           label != nullptr ? label : "",
                           colour,
                           PM_CHART_LINE,
                           copy(x, count),
                           {},
                           copy(height, count),
                           width});
    });
}

pm_status pm_chart_errors(pm_chart *chart, pm_colour colour, const double *x, const double *low,
                          const double *high, int count)
{
    return pm_figure_guard("error bars", [&] {
        return add(chart, {PM_CHART_IS_ERRORS_Y, "", colour, PM_CHART_LINE, copy(x, count),
                           copy(low, count), copy(high, count), 0.0});
    });
}

pm_status pm_chart_errors_x(pm_chart *chart, pm_colour colour, const double *y,
                            const double *low, const double *high, int count)
{
    return pm_figure_guard("error bars", [&] {
        return add(chart, {PM_CHART_IS_ERRORS_X, "", colour, PM_CHART_LINE, copy(y, count),
                           copy(low, count), copy(high, count), 0.0});
    });
}

pm_status pm_chart_band(pm_chart *chart, const char *label, pm_colour colour, const double *x,
                        const double *low, const double *high, int count)
{
    return pm_figure_guard("a band", [&] {
        return add(chart,
                   {PM_CHART_IS_BAND, label != nullptr ? label : "", colour, PM_CHART_LINE,
                    copy(x, count), copy(low, count), copy(high, count), 0.0});
    });
}

pm_status pm_chart_word(pm_chart *chart, double x, double y, const char *text)
{
    return pm_figure_guard("a word", [&] {
        PM_TRY(check_values(chart, "x", chart->x.log, {x}));
        PM_TRY(check_values(chart, "y", chart->y.log, {y}));
        chart->words.push_back({x, y, text});
        return PM_OK;
    });
}

pm_status pm_chart_close(pm_chart *chart)
{
    return pm_figure_guard("a chart", [&] {
        fit_axes(chart);
        chart->closed = true;
        chart->figure->charts.push_back(pm_chart_draw(chart));
        chart->plot = chart->figure->charts.back().where;
        return PM_OK;
    });
}

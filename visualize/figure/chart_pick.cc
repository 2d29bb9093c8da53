// A click on a chart is answered by the datum beside it.
#include "chart.hh"
#include "pick.hh"

#include <cmath>
#include <cstdio>

namespace {

const double reach = 12.0; // pixels

std::string value_on(const pm_chart_axis &axis, double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.5g", value);
    size_t index = static_cast<size_t>(std::lround(std::fmax(value, 0.0)));
    if (index < axis.names.size()) {
        return axis.names[index];
    }
    return axis.title + (axis.title.empty() ? "" : " ") + text;
}

std::string tell(const pm_chart *chart, const pm_chart_series &series, size_t i)
{
    const std::string &name = series.label.empty() ? chart->heading : series.label;
    return name + ": " + value_on(chart->x, series.x[i]) + ", " +
           value_on(chart->y, series.high[i]);
}

/// How far a pixel is from a datum; from all of a bar.
double distance_to(const pm_chart *chart, const pm_chart_series &series, size_t i, double x,
                   double y)
{
    const pm_rect &plot = chart->plot;
    auto across = [&](double v) { return plot.x + chart->x.at(v) * plot.width; };
    double top = plot.y + (1.0 - chart->y.at(series.high[i])) * plot.height;
    double half = 0.5 * (across(series.x[i] + series.width) - across(series.x[i]));
    double beside = std::fabs(x - across(series.x[i])) - half;
    double above = top - y;
    if (series.kind == PM_CHART_IS_BARS) {
        double below = y - (plot.y + plot.height);
        return std::hypot(std::fmax(beside, 0.0), std::fmax(std::fmax(above, below), 0.0));
    }
    return std::hypot(beside, above);
}

} // namespace

std::string pm_chart_pick(const pm_chart *chart, double x, double y)
{
    std::string text;
    double nearest = reach;
    for (const pm_chart_series &series : chart->series) {
        bool data = series.kind == PM_CHART_IS_CURVE || series.kind == PM_CHART_IS_BARS;
        for (size_t i = 0; data && i < series.x.size(); i++) {
            double away = distance_to(chart, series, i, x, y);
            if (away < nearest) {
                nearest = away;
                text = tell(chart, series, i);
            }
        }
    }
    return text;
}

std::string pm_pick_on_chart(const pm_figure *figure, double x, double y)
{
    const int *size = figure->window->GetSize();
    double across = x * figure->width / size[0];
    double down = (size[1] - 1 - y) * figure->height / size[1];
    for (const auto &chart : figure->open_charts) {
        std::string text = chart->closed ? pm_chart_pick(chart.get(), across, down) : "";
        if (!text.empty()) {
            return text;
        }
    }
    return "";
}

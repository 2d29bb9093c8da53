// The inside of a chart: what was put on it, and its axes. Everything is kept until the chart
// is closed, because axes that fit the data need all of it.
#ifndef PM_CHART_HH
#define PM_CHART_HH

#include "chart.h"
#include "chart_axis.hh"
#include "figure.hh"

#include <string>
#include <vector>

enum pm_chart_kind {
    PM_CHART_IS_CURVE, // (x, high)
    PM_CHART_IS_BARS,  // from 0 to high
    PM_CHART_IS_BAND,  // from low to high
    PM_CHART_IS_ERRORS_Y,
    PM_CHART_IS_ERRORS_X, // x holds the height, low and high are along x
};

struct pm_chart_series {
    pm_chart_kind kind;
    std::string label; // "": not in the legend
    pm_colour colour;
    pm_chart_look look; // of a curve
    std::vector<double> x, low, high;
    double width; // of bars
};

struct pm_chart_note {
    double x, y;
    std::string text;
};

struct pm_chart {
    pm_figure *figure;
    pm_rect where;
    std::string heading;
    pm_chart_axis x, y;
    std::vector<pm_chart_series> series;
    std::vector<pm_chart_note> words;
    bool closed;
};

/// Puts a closed chart on its figure's page.
/// @return the rectangle between its axes
pm_rect pm_chart_draw(const pm_chart *chart);

#endif

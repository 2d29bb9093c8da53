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
    pm_rect plot; // once closed: between the axes
};

/// A chart while it is drawn. Pixels are counted from the bottom left.
struct pm_chart_sheet {
    const pm_chart *chart;
    pm_figure *figure;
    double left, bottom, width, height; // of the rectangle between the axes
    std::vector<pm_chart_tick> x_ticks, y_ticks;
    double pixels(double at900) const
    {
        return figure->pixels(at900);
    }
    double px(double at) const
    {
        return left + at * width;
    }
    double py(double at) const
    {
        return bottom + at * height;
    }
};

/// An entry of the legend, and where it stands: the left middle of its swatch.
struct pm_chart_entry {
    const pm_chart_series *series;
    double x, y;
};

// Pixels of a figure 900 high.
const double pm_chart_label_size = 17.0;
const double pm_chart_marker_size = 11.0;

/// Entries in rows from `left` to `right`, the first row's middle at `top`.
std::vector<pm_chart_entry> pm_chart_place_legend(const pm_chart_sheet &sheet, double left,
                                                  double right, double top);
void pm_chart_draw_legend(const pm_chart_sheet &sheet,
                          const std::vector<pm_chart_entry> &places);
void pm_chart_draw_data(const pm_chart_sheet &sheet);

/// Each word beside its point, where it hides the least of curves, dots and other words.
void pm_chart_draw_words(const pm_chart_sheet &sheet);

/// Puts a closed chart on its figure's page.
/// @return where it stands
pm_drawn_chart pm_chart_draw(const pm_chart *chart);

/// The datum of a closed chart nearest to a pixel of the figure, counted from the top left: ""
/// when none is within a few pixels, else its curve and its two values.
std::string pm_chart_pick(const pm_chart *chart, double x, double y);

#endif

// Charts on a figure: curves, dots, bars and bands between two axes, by VTK's charts. Each has
// its rectangle; a figure may have several, and panels beside them.
//
// Logarithms are taken here and VTK draws on linear axes with labels of our own, since its own
// logarithmic axes put the first picture's curves in the wrong place.
#ifndef PM_CHART_H
#define PM_CHART_H

#include "figure.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    const char *heading; // over the chart; NULL: none
    const char *x_title; // with the unit
    const char *y_title;
    bool x_log, y_log;
    double x_low, x_high; // ends of the axis; both 0: from the data
    double y_low, y_high;
    /// Words under the bars: `x_names[i]` stands at x = i. NULL: numbers.
    const char *const *x_names;
    int x_name_count;
} pm_chart_axes;

typedef enum {
    PM_CHART_LINE,
    PM_CHART_DASHES,
    PM_CHART_DOTS, // a disc each, no line
    PM_CHART_DIAMONDS,
    PM_CHART_STEPS, // a level line from x[i] to x[i + 1], as of a histogram
} pm_chart_look;

typedef struct pm_chart pm_chart;

/// Opens an empty chart. The calls below copy what they are given and refuse, by PM_EINPUT,
/// values that are not finite, or not positive along a logarithmic axis.
/// @param where  with its titles and labels
/// @param chart  [out] the figure's
/// @return PM_EINPUT for axis ends that are out of order, not finite, or not positive where the
///         axis is logarithmic
pm_status pm_chart_open(pm_figure *figure, const pm_rect *where, const pm_chart_axes *axes,
                        pm_chart **chart);

/// Points in order.
/// @param label  in the chart's legend; NULL: not there
pm_status pm_chart_curve(pm_chart *chart, const char *label, pm_colour colour,
                         pm_chart_look look, const double *x, const double *y, int count);

/// Bars from 0 up to `height`, `width` wide, around `x`.
pm_status pm_chart_bars(pm_chart *chart, const char *label, pm_colour colour, const double *x,
                        const double *height, int count, double width);

/// An error bar from `low` to `high` at each x, not in the legend.
pm_status pm_chart_errors(pm_chart *chart, pm_colour colour, const double *x, const double *low,
                          const double *high, int count);

/// The same along the other axis: from `low` to `high` [x] at each height `y`.
pm_status pm_chart_errors_x(pm_chart *chart, pm_colour colour, const double *y,
                            const double *low, const double *high, int count);

/// The area between two curves, translucent.
pm_status pm_chart_band(pm_chart *chart, const char *label, pm_colour colour, const double *x,
                        const double *low, const double *high, int count);

/// A small word beside a point, above or below it, where it hides the least.
pm_status pm_chart_word(pm_chart *chart, double x, double y, const char *text);

/// Finishes the chart: axes, ticks, legend. Nothing can be added afterwards.
pm_status pm_chart_close(pm_chart *chart);

#ifdef __cplusplus
}
#endif
#endif

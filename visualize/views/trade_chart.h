// The charts of a trade: error against time, and below it what the error is made of.
#ifndef PM_TRADE_CHART_H
#define PM_TRADE_CHART_H

#include "figure.h"
#include "trade_names.h"

/// The colour of a group of points.
pm_colour pm_trade_chart_colour(int group);

/// Every point that has a place on logarithmic axes, with error bars where its spread is known,
/// and the Pareto line with a number at each of its points, from 1.
pm_status pm_trade_chart_errors(pm_figure *figure, const pm_rect *where, const pm_trade *trade,
                                const pm_trade_groups *groups);

/// bias^2 and variance of the Pareto points over the same times.
pm_status pm_trade_chart_parts(pm_figure *figure, const pm_rect *where, const pm_trade *trade);

#endif

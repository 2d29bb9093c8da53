// An axis: from a value to a place between 0 and 1, and the ticks that make it readable.
#ifndef PM_CHART_AXIS_HH
#define PM_CHART_AXIS_HH

#include <string>
#include <vector>

struct pm_chart_tick {
    double at;        // on the axis, 0 to 1
    std::string text; // "": a minor tick
};

struct pm_chart_axis {
    std::string title;
    bool log;
    double low, high;               // both 0 until fitted
    std::vector<std::string> names; // instead of numbers, at 0, 1, 2 ...

    /// Where a value lies; on a logarithmic axis it must be positive.
    double at(double value) const;

    /// Ends just beyond the data [least, most]; keeps ends that were given.
    void fit(double least, double most);

    /// Ticks with labels about `spacing` apart or more, in parts of the axis.
    std::vector<pm_chart_tick> ticks(double spacing) const;
};

/// As people write it: 1,000 and 0.02; powers of ten only far from 1.
/// @param step  between neighbours: as many decimals as tell them apart
std::string pm_chart_number(double value, double step);

#endif

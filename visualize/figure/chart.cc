// Charts on a figure.
#include "figure.hh"

#include "chart.h"

struct pm_chart {
    pm_figure *figure;
};

pm_status pm_chart_open(pm_figure * /*figure*/, const pm_rect * /*where*/,
                        const pm_chart_axes * /*axes*/, pm_chart ** /*chart*/)
{
    return PM_FAIL(PM_ETODO, "%s", "no charts yet");
}
pm_status pm_chart_curve(pm_chart *, const char *, pm_colour, pm_chart_look, const double *,
                         const double *, int)
{
    return PM_OK;
}
pm_status pm_chart_bars(pm_chart *, const char *, pm_colour, const double *, const double *,
                        int, double)
{
    return PM_OK;
}
pm_status pm_chart_errors(pm_chart *, pm_colour, const double *, const double *, const double *,
                          int)
{
    return PM_OK;
}
pm_status pm_chart_band(pm_chart *, const char *, pm_colour, const double *, const double *,
                        const double *, int)
{
    return PM_OK;
}
pm_status pm_chart_word(pm_chart *, double, double, const char *)
{
    return PM_OK;
}
pm_status pm_chart_close(pm_chart *)
{
    return PM_OK;
}

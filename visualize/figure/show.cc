// A window to look around in.
#include "figure.hh"

pm_status pm_figure_show(pm_figure *figure, const char *title, pm_vec3 center)
{
    (void)figure;
    (void)center;
    return PM_FAIL(PM_ETODO, "%s: no window yet", title);
}

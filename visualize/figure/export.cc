// The numbers behind a picture as a file for ParaView.
#include "figure.hh"

pm_status pm_figure_export(pm_figure *figure, const char *path, pm_vec3 center)
{
    (void)figure;
    (void)center;
    return PM_FAIL(PM_ETODO, "%s: .vtp is not written yet", path);
}

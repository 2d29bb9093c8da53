// Irradiance on a rectangle.
#ifndef PM_DRAW_IRRADIANCE_H
#define PM_DRAW_IRRADIANCE_H

#include "figure.h"
#include "figure_data.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A heat map of luminance on the grid's surface, with a logarithmic scale in W/m^2.
pm_status pm_draw_irradiance(pm_figure *figure, const pm_grid *grid);

#ifdef __cplusplus
}
#endif
#endif

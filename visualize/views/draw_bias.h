// Estimates over what they should be, face on.
#ifndef PM_DRAW_BIAS_H
#define PM_DRAW_BIAS_H

#include "figure.h"
#include "figure_data.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Draws the grid into the current panel, a square a point, in pm_colour_diverging(): white is
/// 1, the ends are 1 - `reach` and 1 + `reach`. Keeps its numbers under `name`.
/// @param truth  luminance of the irradiance there should be [W/m^2], > 0
pm_status pm_draw_bias(pm_figure *figure, const pm_grid *grid, double truth, double reach,
                       const char *name);

/// The scale of all panels.
/// @param beyond  some values are above its end
pm_status pm_draw_bias_scale(pm_figure *figure, double reach, bool beyond);

#ifdef __cplusplus
}
#endif
#endif

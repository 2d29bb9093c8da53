// The unit sphere of directions, cut into the 256 x 256 cells that two bytes can name.
#ifndef PM_DRAW_PACKING_H
#define PM_DRAW_PACKING_H

#include "figure.h"
#include "packing_sphere.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The whole sphere with every `PM_SPHERE_STEP`-th line between cells, exact directions as
/// dots, and a ring around each patch.
pm_status pm_draw_sphere(pm_figure *figure, const pm_rect *where, const pm_sphere_choice *whole,
                         const pm_sphere_patch *patches, int count);

/// A piece of the sphere with all lines between cells; each direction is a dot, joined to the
/// dot where its bytes put it.
pm_status pm_draw_patch(pm_figure *figure, const pm_rect *where, const pm_sphere_patch *patch);

/// The legend of all this, in the right column beside `row`.
pm_status pm_draw_packing_legend(pm_figure *figure, const pm_rect *row);

/// Keeps every direction with its numbers as the data behind the picture; `exact` and the
/// arrays are the caller's and must outlive the figure.
pm_status pm_draw_packing_keep(pm_figure *figure, float (*exact)[3], float (*packed)[3],
                               float *angle, float *power, uint32_t count);

#ifdef __cplusplus
}
#endif
#endif

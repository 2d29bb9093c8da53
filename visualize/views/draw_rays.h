// Photons as they leave the lights.
#ifndef PM_DRAW_RAYS_H
#define PM_DRAW_RAYS_H

#include "figure.h"
#include "ray_pick.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A dot where each photon starts and, for those with one, an arrow along its way, in the
/// colour of its light (light_pick.h). Keeps the photons as numbers, too.
/// @param length  of an arrow [m]
pm_status pm_draw_rays(pm_figure *figure, const pm_ray_choice *choice, double dot_size,
                       double length);

#ifdef __cplusplus
}
#endif
#endif

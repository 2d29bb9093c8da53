// Light that reaches a diffuse surface straight from the lights: shadow rays.
#ifndef PM_DIRECT_H
#define PM_DIRECT_H

#include "intersect.h"
#include "material.h"

/// Radiance [W/(m^2 sr)] that leaves `hit` towards lobes->wi by its D lobes after coming
/// straight from all lights.
///
/// Area lights are sampled uniformly over their surface at `samples` points, the points
/// `first`, `first + step`, .. of a lattice of samples * step with the given shift, so that
/// several calls share one even spread. Every surface but null blocks.
pm_spectrum pm_direct(const pm_intersector *world, const pm_hit *hit, const pm_lobes *lobes,
                      uint32_t samples, uint32_t first, uint32_t step, const double shift[2]);

#endif

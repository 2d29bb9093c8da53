// Rays against single primitives, in double. Both intersectors decide by this one function, so
// they give the same hits to the last bit.
#ifndef PM_SHAPE_HIT_H
#define PM_SHAPE_HIT_H

#include "intersect.h"

/// Where `ray` first meets the primitive, at 0 < t <= t_max. A ray in the plane of a flat
/// primitive, and any ray to a triangle without area, misses.
/// @param t  [out] [m]; untouched on a miss
bool pm_shape_hit(const pm_shape *shape, uint32_t primitive, const pm_ray *ray, double t_max,
                  double *t);

#endif

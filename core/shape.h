// Geometry of single shapes in double: their boxes, points on them, hits made exact. Rays
// against them are in shape_hit.h.
//
// A shape is made of primitives: the triangles of a mesh, numbered as they stand there; every
// other shape is one primitive, number 0.
#ifndef PM_SHAPE_H
#define PM_SHAPE_H

#include "intersect.h"

/// A box [m], along the axes.
typedef struct {
    pm_vec3 low, high;
} pm_box;

/// How many primitives `shape` has.
uint32_t pm_shape_primitives(const pm_shape *shape);

/// Whether light passes `shape` as if it were not there. Sides that differ count as matter.
bool pm_shape_is_null(const pm_scene *scene, const pm_shape *shape);

/// The box around one primitive, exact but for rounding in double.
pm_box pm_shape_box(const pm_shape *shape, uint32_t primitive);

/// Completes a hit whose t, shape and primitive stand: position (the point at t on `ray`, moved
/// onto the primitive), normal, inner and offset.
void pm_shape_complete(const pm_shape *shape, const pm_ray *ray, pm_hit *hit);

/// The point of `shape` that (u, v) of the unit square maps to, uniform by area, as a hit that
/// rays can leave (t is 0, hit->shape is left to the caller).
/// @param u, v  in [0, 1)
/// @param hit   [out]; a mesh must have area_below, and an area above 0
void pm_shape_point(const pm_shape *shape, double u, double v, pm_hit *hit);

#endif

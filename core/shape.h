// Geometry of single shapes in double: points on them and, for those that are not triangles, rays
// against them.
#ifndef PM_SHAPE_H
#define PM_SHAPE_H

#include "intersect.h"

/// The point of `shape` that the unit square's (u, v) maps to, uniform by area, as a hit that rays
/// can leave (t is 0, `shape` is left to the caller). A mesh must have area_below.
void pm_shape_point(const pm_shape *shape, double u, double v, pm_hit *hit);

/// Nearest meeting of the ray with a sphere, disk or cylinder at 0 < t <= t_max.
bool pm_shape_hit(const pm_shape *shape, const pm_ray *ray, double t_max, double *t);

/// Completes a hit: position on the primitive, normal, inner and offset, for the meeting of `ray`
/// at about hit->t with hit->primitive (u, v: barycentrics of triangle vertices 1 and 2, or the
/// rectangle's coordinates; not used for others).
void pm_shape_complete(const pm_shape *shape, const pm_ray *ray, double u, double v, pm_hit *hit);

#endif

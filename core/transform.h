// Affine transforms: what <transform> is made of. Column vectors; the last row is 0 0 0 1.
//
// Every result is homogeneous in the lengths that go in, so scaling a scene by a power of two
// scales it exactly, and turns by multiples of 90 degrees are exact.
#ifndef PM_TRANSFORM_H
#define PM_TRANSFORM_H

#include "vec.h"

typedef struct {
    pm_vec3 column[3]; // where the unit vectors go
    pm_vec3 origin;    // where the origin goes
} pm_transform;

pm_transform pm_transform_identity(void);
pm_transform pm_transform_translate(pm_vec3 by);
pm_transform pm_transform_scale(pm_vec3 by);

/// Turns by `degrees` about `axis`, which must not be zero; right-handed.
pm_transform pm_transform_rotate(pm_vec3 axis, double degrees);

/// A camera's frame: x to the left, y up, z from `origin` to `target`, as Mitsuba has it. A
/// zero `up` stands for any. Not finite when `target` is `origin` or `up` runs along the view.
pm_transform pm_transform_look_at(pm_vec3 origin, pm_vec3 target, pm_vec3 up);

/// First `first`, then `second`.
pm_transform pm_transform_then(const pm_transform *first, const pm_transform *second);

/// A difference of points: turned and scaled, not moved.
pm_vec3 pm_transform_vector(const pm_transform *transform, pm_vec3 v);

/// Volume of the image of the unit cube over the product of its edge lengths, in [-1, 1]:
/// negative when it mirrors, and 0 within rounding (1e-12), or NaN, when it is singular.
double pm_transform_handedness(const pm_transform *transform);

#endif

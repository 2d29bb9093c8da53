// Rays against rectangles, spheres, disks, cylinders and triangles.
//
// Invariant: the borders of flat primitives and the ends of cylinders are widened by a slack of
// 2^-48 of the distances involved, some eight times what rounding can do to the point of
// meeting. So of two primitives that share an edge, or of many that share a vertex, a ray aimed
// at it hits at least one: closed surfaces do not leak. Everything is homogeneous in lengths: a
// scene scaled by a power of two gives the same bits.
// @source triangles: Plucker form, as in Woop, Benthin, Wald, "Watertight Ray/Triangle
//         Intersection", JCGT 2(1), 2013, with the origin moved next to the triangle first
// @source spheres: Haines et al., "Precision Improvements for Ray/Sphere Intersection",
//         Ray Tracing Gems, 2019
#include "shape_hit.h"

#define SLACK 0x1p-48

/// Sum of |x|, |y|, |z|: no smaller than the length, and cheaper.
static double span(pm_vec3 a)
{
    return fabs(a.x) + fabs(a.y) + fabs(a.z);
}

static bool accept(double at, double t_max, double *t)
{
    if (!(at > 0.0 && at <= t_max)) {
        return false;
    }
    *t = at;
    return true;
}

static bool hit_rectangle(const pm_shape *shape, const pm_ray *ray, double t_max, double *t)
{
    pm_vec3 normal = pm_vec_cross(shape->edge[0], shape->edge[1]);
    pm_vec3 from_origin = pm_vec_sub(shape->corner, ray->origin);
    double at = pm_vec_dot(normal, from_origin) / pm_vec_dot(normal, ray->direction);
    if (!(at > 0.0 && at <= t_max)) { // NaN and infinity of a ray in the plane fail here
        return false;
    }
    pm_vec3 from_corner = pm_vec_sub(pm_vec_scale(ray->direction, at), from_origin);
    double slack = SLACK * (span(ray->origin) + span(from_origin) + at) * span(normal);
    double area2 = pm_vec_dot(normal, normal);
    double u = pm_vec_dot(pm_vec_cross(from_corner, shape->edge[1]), normal);
    double u_slack = slack * span(shape->edge[1]);
    if (!(u >= -u_slack && u <= area2 + u_slack)) {
        return false;
    }
    double v = pm_vec_dot(pm_vec_cross(shape->edge[0], from_corner), normal);
    double v_slack = slack * span(shape->edge[0]);
    if (!(v >= -v_slack && v <= area2 + v_slack)) {
        return false;
    }
    *t = at;
    return true;
}

static bool hit_triangle(const pm_vec3 vertex[3], const pm_ray *ray, double t_max, double *t)
{
    // Vertices as seen from the ray's point next to the triangle: its size, not its distance,
    // then sets the rounding errors.
    double near = pm_vec_dot(pm_vec_sub(vertex[0], ray->origin), ray->direction);
    pm_vec3 foot = pm_vec_along(ray->origin, ray->direction, near);
    pm_vec3 a = pm_vec_sub(vertex[0], foot);
    pm_vec3 b = pm_vec_sub(vertex[1], foot);
    pm_vec3 c = pm_vec_sub(vertex[2], foot);
    double size = span(a) + span(b) + span(c);
    double slack = SLACK * (span(ray->origin) + fabs(near) + size) * size;

    double u = pm_vec_dot(ray->direction, pm_vec_cross(c, b));
    double v = pm_vec_dot(ray->direction, pm_vec_cross(a, c));
    double w = pm_vec_dot(ray->direction, pm_vec_cross(b, a));
    double sum = u + v + w;
    double side = sum < 0.0 ? -1.0 : 1.0;
    if (fabs(sum) <= slack || side * u < -slack || side * v < -slack || side * w < -slack) {
        return false;
    }
    pm_vec3 normal = pm_vec_cross(pm_vec_sub(b, a), pm_vec_sub(c, a));
    double step = pm_vec_dot(normal, a) / pm_vec_dot(normal, ray->direction);
    return accept(near + step, t_max, t);
}

static bool hit_mesh(const pm_shape *shape, uint32_t primitive, const pm_ray *ray, double t_max,
                     double *t)
{
    const uint32_t *corner = shape->triangles[primitive];
    pm_vec3 vertex[3] = {shape->vertices[corner[0]], shape->vertices[corner[1]],
                         shape->vertices[corner[2]]};
    return hit_triangle(vertex, ray, t_max, t);
}

static bool hit_sphere(const pm_shape *shape, const pm_ray *ray, double t_max, double *t)
{
    pm_vec3 to_center = pm_vec_sub(shape->center, ray->origin);
    double near = pm_vec_dot(to_center, ray->direction);
    // From the nearest point of the ray to the centre: as exact from afar as from close by.
    pm_vec3 aside = pm_vec_along(to_center, ray->direction, -near);
    double half2 = shape->radius * shape->radius - pm_vec_dot(aside, aside);
    if (half2 < 0.0) {
        return false;
    }
    double half = sqrt(half2);
    return accept(near - half, t_max, t) || accept(near + half, t_max, t);
}

static bool hit_disk(const pm_shape *shape, const pm_ray *ray, double t_max, double *t)
{
    pm_vec3 to_center = pm_vec_sub(shape->center, ray->origin);
    double at = pm_vec_dot(shape->axis, to_center) / pm_vec_dot(shape->axis, ray->direction);
    if (!(at > 0.0 && at <= t_max)) {
        return false;
    }
    pm_vec3 from_center = pm_vec_sub(pm_vec_scale(ray->direction, at), to_center);
    double slack = SLACK * (span(ray->origin) + span(to_center) + at);
    if (!(pm_vec_length(from_center) <= shape->radius + slack)) {
        return false;
    }
    *t = at;
    return true;
}

/// `a` without its part along the unit `axis`.
static pm_vec3 across(pm_vec3 a, pm_vec3 axis)
{
    return pm_vec_along(a, axis, -pm_vec_dot(a, axis));
}

static bool between_ends(const pm_shape *shape, const pm_ray *ray, double at)
{
    pm_vec3 to_center = pm_vec_sub(shape->center, ray->origin);
    pm_vec3 from_center = pm_vec_sub(pm_vec_scale(ray->direction, at), to_center);
    double height = pm_vec_dot(from_center, shape->axis);
    double slack = SLACK * (span(ray->origin) + span(to_center) + fabs(at));
    return height >= -slack && height <= shape->length + slack;
}

static bool hit_cylinder(const pm_shape *shape, const pm_ray *ray, double t_max, double *t)
{
    // The sphere's problem in the plane across the axis, where the direction is `speed` long.
    pm_vec3 way = across(ray->direction, shape->axis);
    pm_vec3 to_axis = across(pm_vec_sub(shape->center, ray->origin), shape->axis);
    double speed2 = pm_vec_dot(way, way);
    double near = pm_vec_dot(to_axis, way) / speed2;
    pm_vec3 aside = pm_vec_along(to_axis, way, -near);
    double half2 = shape->radius * shape->radius - pm_vec_dot(aside, aside);
    if (!(half2 >= 0.0)) { // also NaN: the ray runs along the axis
        return false;
    }
    double half = sqrt(half2 / speed2);
    if (between_ends(shape, ray, near - half) && accept(near - half, t_max, t)) {
        return true;
    }
    return between_ends(shape, ray, near + half) && accept(near + half, t_max, t);
}

bool pm_shape_hit(const pm_shape *shape, uint32_t primitive, const pm_ray *ray, double t_max,
                  double *t)
{
    switch (shape->type) {
    case PM_SHAPE_RECTANGLE:
        return hit_rectangle(shape, ray, t_max, t);
    case PM_SHAPE_SPHERE:
        return hit_sphere(shape, ray, t_max, t);
    case PM_SHAPE_DISK:
        return hit_disk(shape, ray, t_max, t);
    case PM_SHAPE_CYLINDER:
        return hit_cylinder(shape, ray, t_max, t);
    case PM_SHAPE_MESH:
        return hit_mesh(shape, primitive, ray, t_max, t);
    }
    return false;
}

// Points on single shapes, and what a ray needs to leave them.
//
// Invariant: a hit's position lies on its primitive to rounding in double; `inner` is that
// position, or, nearer to a border than EDGE_MARGIN offsets, the position drawn in until it is
// that far away. At an inner corner the walls beside this one are then at least an offset away,
// as long as they stand at more than 14 degrees (atan 1/EDGE_MARGIN) to it.
#include "shape.h"

#include <assert.h>

#define EDGE_MARGIN 4.0

uint32_t pm_shape_primitives(const pm_shape *shape)
{
    return shape->type == PM_SHAPE_MESH ? shape->triangle_count : 1;
}

static bool is_null(const pm_scene *scene, int material)
{
    return material != PM_NONE && scene->materials[material].type == PM_BSDF_NULL;
}

bool pm_shape_is_null(const pm_scene *scene, const pm_shape *shape)
{
    return is_null(scene, shape->material[0]) && is_null(scene, shape->material[1]);
}

// --- boxes -------------------------------------------------------------------------------

static pm_box box_of(const pm_vec3 *points, int count)
{
    pm_box box = {points[0], points[0]};
    for (int i = 1; i < count; i++) {
        box.low = pm_vec_min(box.low, points[i]);
        box.high = pm_vec_max(box.high, points[i]);
    }
    return box;
}

static pm_box rectangle_box(const pm_shape *shape)
{
    pm_vec3 side = pm_vec_add(shape->corner, shape->edge[0]);
    pm_vec3 points[4] = {shape->corner, side, pm_vec_add(shape->corner, shape->edge[1]),
                         pm_vec_add(side, shape->edge[1])};
    return box_of(points, 4);
}

static pm_box mesh_box(const pm_shape *shape, uint32_t primitive)
{
    const uint32_t *corner = shape->triangles[primitive];
    pm_vec3 points[3] = {shape->vertices[corner[0]], shape->vertices[corner[1]],
                         shape->vertices[corner[2]]};
    return box_of(points, 3);
}

/// Half the box of a circle about the unit `axis`.
static pm_vec3 circle_extent(pm_vec3 axis, double radius)
{
    return pm_vec(radius * sqrt(pm_most(0.0, 1.0 - axis.x * axis.x)),
                  radius * sqrt(pm_most(0.0, 1.0 - axis.y * axis.y)),
                  radius * sqrt(pm_most(0.0, 1.0 - axis.z * axis.z)));
}

/// The box of what lies within `extent` of the segment from the shape's centre to `end`.
static pm_box swept_box(const pm_shape *shape, pm_vec3 end, pm_vec3 extent)
{
    return (pm_box){pm_vec_sub(pm_vec_min(shape->center, end), extent),
                    pm_vec_add(pm_vec_max(shape->center, end), extent)};
}

pm_box pm_shape_box(const pm_shape *shape, uint32_t primitive)
{
    pm_vec3 ball = pm_vec(shape->radius, shape->radius, shape->radius);
    pm_vec3 end = pm_vec_along(shape->center, shape->axis, shape->length);
    switch (shape->type) {
    case PM_SHAPE_RECTANGLE:
        return rectangle_box(shape);
    case PM_SHAPE_SPHERE:
        return swept_box(shape, shape->center, ball);
    case PM_SHAPE_DISK:
        return swept_box(shape, shape->center, circle_extent(shape->axis, shape->radius));
    case PM_SHAPE_CYLINDER:
        return swept_box(shape, end, circle_extent(shape->axis, shape->radius));
    case PM_SHAPE_MESH:
        break;
    }
    return mesh_box(shape, primitive);
}

// --- hits --------------------------------------------------------------------------------

/// Position, normal and offset; `inner` is the position until a border is near.
static void place(const pm_shape *shape, pm_vec3 position, pm_vec3 normal, double reach,
                  pm_hit *hit)
{
    hit->position = position;
    hit->inner = position;
    hit->normal = shape->flipped ? pm_vec_negate(normal) : normal;
    hit->offset = PM_OFFSET * pm_most(reach, pm_vec_reach(position));
}

/// `at` moved to `margin` from both ends of [0, length]; to the middle when there is no room.
static double draw_in(double at, double margin, double length)
{
    double least = pm_least(margin, 0.5 * length);
    return pm_least(pm_most(at, least), length - least);
}

static void place_on_rectangle(const pm_shape *shape, double u, double v, pm_hit *hit)
{
    pm_vec3 side = pm_vec_along(shape->corner, shape->edge[0], u);
    pm_vec3 normal = pm_vec_cross(shape->edge[0], shape->edge[1]);
    double area = pm_vec_length(normal);
    place(shape, pm_vec_along(side, shape->edge[1], v), pm_vec_scale(normal, 1.0 / area),
          shape->reach, hit);
    double margin = EDGE_MARGIN * hit->offset;
    double u_in = draw_in(u, margin * pm_vec_length(shape->edge[1]) / area, 1.0);
    double v_in = draw_in(v, margin * pm_vec_length(shape->edge[0]) / area, 1.0);
    if (u_in != u || v_in != v) {
        pm_vec3 side_in = pm_vec_along(shape->corner, shape->edge[0], u_in);
        hit->inner = pm_vec_along(side_in, shape->edge[1], v_in);
    }
}

static void place_on_sphere(const pm_shape *shape, pm_vec3 normal, pm_hit *hit)
{
    place(shape, pm_vec_along(shape->center, normal, shape->radius), normal, shape->reach, hit);
}

/// @param outward  from the centre, in the disk's plane, at most a radius long
static void place_on_disk(const pm_shape *shape, pm_vec3 outward, pm_hit *hit)
{
    place(shape, pm_vec_add(shape->center, outward), shape->axis, shape->reach, hit);
    double length = pm_vec_length(outward);
    double limit = pm_most(0.0, shape->radius - EDGE_MARGIN * hit->offset);
    if (length > limit) {
        hit->inner = pm_vec_along(shape->center, outward, limit / length);
    }
}

/// @param outward  unit, away from the axis
static void place_on_cylinder(const pm_shape *shape, double height, pm_vec3 outward,
                              pm_hit *hit)
{
    pm_vec3 rim = pm_vec_along(shape->center, outward, shape->radius);
    place(shape, pm_vec_along(rim, shape->axis, height), outward, shape->reach, hit);
    double height_in = draw_in(height, EDGE_MARGIN * hit->offset, shape->length);
    if (height_in != height) {
        hit->inner = pm_vec_along(rim, shape->axis, height_in);
    }
}

/// A triangle with what its points are made from: v0, the edges from it, the normal's length.
typedef struct {
    pm_vec3 v0, edge1, edge2, normal;
    double area2; // twice the area
    double reach;
} triangle;

static triangle triangle_of(const pm_shape *shape, uint32_t primitive)
{
    const uint32_t *corner = shape->triangles[primitive];
    pm_vec3 v0 = shape->vertices[corner[0]];
    pm_vec3 v1 = shape->vertices[corner[1]];
    pm_vec3 v2 = shape->vertices[corner[2]];
    triangle face = {.v0 = v0, .edge1 = pm_vec_sub(v1, v0), .edge2 = pm_vec_sub(v2, v0)};
    pm_vec3 normal = pm_vec_cross(face.edge1, face.edge2);
    face.area2 = pm_vec_length(normal);
    face.normal = pm_vec_scale(normal, 1.0 / face.area2);
    face.reach = pm_most(pm_vec_reach(v0), pm_most(pm_vec_reach(v1), pm_vec_reach(v2)));
    return face;
}

static pm_vec3 triangle_point(const triangle *face, double b1, double b2)
{
    return pm_vec_along(pm_vec_along(face->v0, face->edge1, b1), face->edge2, b2);
}

/// How far towards the centroid, 0 to 1, a point must go that has barycentric `b` over an edge
/// of length `edge`, to be `margin` away from that edge.
static double pull(double b, double edge, double area2, double margin)
{
    double wanted = margin * edge / area2;
    if (b >= wanted) {
        return 0.0;
    }
    return wanted >= 1.0 / 3.0 ? 1.0 : (wanted - b) / (1.0 / 3.0 - b);
}

static void place_on_triangle(const pm_shape *shape, const triangle *face, double b1, double b2,
                              pm_hit *hit)
{
    place(shape, triangle_point(face, b1, b2), face->normal, face->reach, hit);
    double margin = EDGE_MARGIN * hit->offset;
    double far_edge = pm_vec_length(pm_vec_sub(face->edge2, face->edge1));
    double pull0 = pull(1.0 - b1 - b2, far_edge, face->area2, margin);
    double pull1 = pull(b1, pm_vec_length(face->edge2), face->area2, margin);
    double pull2 = pull(b2, pm_vec_length(face->edge1), face->area2, margin);
    double most = pm_most(pull0, pm_most(pull1, pull2));
    if (most > 0.0) {
        double b1_in = b1 + (1.0 / 3.0 - b1) * most;
        double b2_in = b2 + (1.0 / 3.0 - b2) * most;
        hit->inner = triangle_point(face, b1_in, b2_in);
    }
}

static double clamp(double x, double high)
{
    return pm_least(pm_most(x, 0.0), high);
}

static void complete_rectangle(const pm_shape *shape, pm_vec3 near, pm_hit *hit)
{
    pm_vec3 from_corner = pm_vec_sub(near, shape->corner);
    pm_vec3 normal = pm_vec_cross(shape->edge[0], shape->edge[1]);
    double scale = 1.0 / pm_vec_dot(normal, normal);
    double u = scale * pm_vec_dot(pm_vec_cross(from_corner, shape->edge[1]), normal);
    double v = scale * pm_vec_dot(pm_vec_cross(shape->edge[0], from_corner), normal);
    place_on_rectangle(shape, clamp(u, 1.0), clamp(v, 1.0), hit);
}

static void complete_disk(const pm_shape *shape, pm_vec3 near, pm_hit *hit)
{
    pm_vec3 from_center = pm_vec_sub(near, shape->center);
    double height = pm_vec_dot(from_center, shape->axis);
    pm_vec3 outward = pm_vec_along(from_center, shape->axis, -height);
    double length = pm_vec_length(outward);
    double shrink = length > shape->radius ? shape->radius / length : 1.0;
    place_on_disk(shape, pm_vec_scale(outward, shrink), hit);
}

static void complete_cylinder(const pm_shape *shape, pm_vec3 near, pm_hit *hit)
{
    pm_vec3 from_center = pm_vec_sub(near, shape->center);
    double height = pm_vec_dot(from_center, shape->axis);
    pm_vec3 outward = pm_vec_normalize(pm_vec_along(from_center, shape->axis, -height));
    place_on_cylinder(shape, clamp(height, shape->length), outward, hit);
}

static void complete_mesh(const pm_shape *shape, pm_vec3 near, pm_hit *hit)
{
    triangle face = triangle_of(shape, hit->primitive);
    pm_vec3 from_v0 = pm_vec_sub(near, face.v0);
    double b1 = pm_vec_dot(pm_vec_cross(from_v0, face.edge2), face.normal) / face.area2;
    double b2 = pm_vec_dot(pm_vec_cross(face.edge1, from_v0), face.normal) / face.area2;
    b1 = clamp(b1, 1.0);
    place_on_triangle(shape, &face, b1, clamp(b2, 1.0 - b1), hit);
}

void pm_shape_complete(const pm_shape *shape, const pm_ray *ray, pm_hit *hit)
{
    pm_vec3 near = pm_vec_along(ray->origin, ray->direction, hit->t);
    switch (shape->type) {
    case PM_SHAPE_RECTANGLE:
        complete_rectangle(shape, near, hit);
        break;
    case PM_SHAPE_SPHERE:
        place_on_sphere(shape, pm_vec_normalize(pm_vec_sub(near, shape->center)), hit);
        break;
    case PM_SHAPE_DISK:
        complete_disk(shape, near, hit);
        break;
    case PM_SHAPE_CYLINDER:
        complete_cylinder(shape, near, hit);
        break;
    case PM_SHAPE_MESH:
        complete_mesh(shape, near, hit);
        break;
    }
}

// --- points ------------------------------------------------------------------------------

static pm_vec3 on_circle(pm_vec3 axis, double turn)
{
    pm_frame frame = pm_frame_around(axis);
    double angle = 2.0 * PM_PI * turn;
    return pm_frame_to_world(&frame, pm_vec(cos(angle), sin(angle), 0.0));
}

static pm_vec3 on_unit_sphere(double u, double v)
{
    double height = 1.0 - 2.0 * u;
    double across = 2.0 * sqrt(u * (1.0 - u));
    double angle = 2.0 * PM_PI * v;
    return pm_vec(across * cos(angle), across * sin(angle), height);
}

/// The first triangle whose area_below exceeds `area`.
static uint32_t triangle_at(const pm_shape *shape, double area)
{
    uint32_t low = 0;
    uint32_t high = shape->triangle_count - 1;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        if (shape->area_below[middle] > area) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

static void point_on_mesh(const pm_shape *shape, double u, double v, pm_hit *hit)
{
    assert(shape->area_below && shape->triangle_count > 0);
    double area = u * shape->area_below[shape->triangle_count - 1];
    hit->primitive = triangle_at(shape, area);
    double below = hit->primitive > 0 ? shape->area_below[hit->primitive - 1] : 0.0;
    double rest = (area - below) / (shape->area_below[hit->primitive] - below);
    double root = sqrt(rest);
    triangle face = triangle_of(shape, hit->primitive);
    place_on_triangle(shape, &face, root * (1.0 - v), root * v, hit);
}

void pm_shape_point(const pm_shape *shape, double u, double v, pm_hit *hit)
{
    hit->t = 0.0;
    hit->primitive = 0;
    switch (shape->type) {
    case PM_SHAPE_RECTANGLE:
        place_on_rectangle(shape, u, v, hit);
        break;
    case PM_SHAPE_SPHERE:
        place_on_sphere(shape, on_unit_sphere(u, v), hit);
        break;
    case PM_SHAPE_DISK:
        place_on_disk(shape, pm_vec_scale(on_circle(shape->axis, v), shape->radius * sqrt(u)),
                      hit);
        break;
    case PM_SHAPE_CYLINDER:
        place_on_cylinder(shape, u * shape->length, on_circle(shape->axis, v), hit);
        break;
    case PM_SHAPE_MESH:
        point_on_mesh(shape, u, v, hit);
        break;
    }
}

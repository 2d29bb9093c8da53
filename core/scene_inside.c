// A straight line from a point to a point on a shape that parts media first meets one of these
// shapes, and from the side of the medium that the first point is in; so lines to many of them
// agree, or the shapes do not close.
#include "scene_inside.h"

#include "intersect_plain.h"
#include "shape.h"

#include <math.h>

#define LINES 8
#define LINES_THROUGH 32
#define CROSSINGS_MOST 1000 // of one line, which then says nothing of its far end

bool pm_scene_inside_begin(pm_scene_file *source, pm_scene_inside *inside)
{
    const pm_scene *scene = &source->scene;
    pm_scene *bounds = &inside->bounds;
    *inside = (pm_scene_inside){.bounds = *scene};
    bounds->shapes =
        pm_arena_take(&source->tree, (size_t)scene->shape_count, sizeof *scene->shapes);
    bounds->shape_count = 0;
    for (int i = 0; bounds->shapes != NULL && i < scene->shape_count; i++) {
        if (scene->shapes[i].boundary) {
            bounds->shapes[bounds->shape_count++] = scene->shapes[i];
        }
    }
    return bounds->shapes != NULL && pm_intersect_plain(bounds, &inside->world) == PM_OK;
}

static double fraction(double x)
{
    return x - floor(x);
}

/// A place on a shape, another one for each number; inside a face of a mesh.
static pm_vec3 place_on(const pm_shape *shape, int number)
{
    // Steps whose multiples fill a square evenly and never fall on edges or diagonals.
    double u = fraction(0.5 + 0.7548776662466927 * number);
    double v = fraction(0.5 + 0.5698402909980532 * number);
    if (shape->type != PM_SHAPE_MESH) {
        pm_hit hit;
        pm_shape_point(shape, u, v, &hit);
        return hit.position;
    }
    const uint32_t *corner = shape->triangles[(uint32_t)(u * shape->triangle_count)];
    const pm_vec3 *vertex = shape->vertices;
    double a = 0.2 + 0.3 * v;
    pm_vec3 place = pm_vec_scale(vertex[corner[0]], a);
    place = pm_vec_along(place, vertex[corner[1]], 0.3);
    return pm_vec_along(place, vertex[corner[2]], 0.7 - a);
}

static void tell(pm_scene_place *place, const pm_shape *by, int medium)
{
    if (place->by == NULL) {
        place->by = by;
        place->medium = medium;
    } else if (place->against == NULL && medium != place->medium) {
        place->against = by;
        place->other = medium;
    }
}

/// The next shape on `ray`, the medium before it and the one beyond; `ray` goes on from there.
/// NULL when there is none.
static const pm_shape *cross(const pm_scene_inside *inside, pm_ray *ray, int medium[2])
{
    pm_hit hit;
    if (!pm_closest(&inside->world, ray, &hit)) {
        return NULL;
    }
    const pm_shape *shape = &inside->bounds.shapes[hit.shape];
    bool enters = pm_vec_dot(hit.normal, ray->direction) < 0.0;
    medium[0] = enters ? shape->exterior : shape->interior;
    medium[1] = enters ? shape->interior : shape->exterior;
    *ray = pm_hit_ray(&hit, ray->direction, 0.0, PM_NONE);
    return shape;
}

/// Line number `line` of `lines` from a point, to a place on one of the shapes.
static pm_ray ray_from(const pm_scene_inside *inside, pm_vec3 from, int line, int lines)
{
    const pm_scene *bounds = &inside->bounds;
    int count = bounds->shape_count;
    int which = count <= lines ? line % count : (int)((int64_t)line * count / lines);
    pm_vec3 way = pm_vec_sub(place_on(&bounds->shapes[which], line), from);
    return (pm_ray){from, pm_vec_normalize(way), HUGE_VAL, 0.0, PM_NONE};
}

pm_scene_place pm_scene_inside_at(const pm_scene_inside *inside, pm_vec3 from)
{
    pm_scene_place place = {.medium = PM_NONE, .other = PM_NONE};
    for (int i = 0; i < LINES; i++) {
        pm_ray ray = ray_from(inside, from, i, LINES);
        int medium[2];
        const pm_shape *shape = cross(inside, &ray, medium);
        if (shape != NULL) {
            tell(&place, shape, medium[0]);
        }
    }
    return place;
}

/// One line from outside the scene to outside it. Two shapes that contradict each other between
/// their crossings; otherwise `around`, which learns of both ends.
static pm_scene_place cross_all(const pm_scene_inside *inside, pm_ray ray,
                                pm_scene_place *around)
{
    int medium[2];
    const pm_shape *last = cross(inside, &ray, medium);
    if (last == NULL) {
        return *around;
    }
    tell(around, last, medium[0]);
    for (int i = 0; i < CROSSINGS_MOST; i++) {
        pm_scene_place between = {medium[1], last, PM_NONE, NULL};
        const pm_shape *next = cross(inside, &ray, medium);
        if (next == NULL) {
            tell(around, last, between.medium);
            return *around;
        }
        tell(&between, next, medium[0]);
        if (between.against != NULL) {
            return between;
        }
        last = next;
    }
    return *around;
}

/// Somewhere outside, another place for each number: even over height and azimuth.
static pm_vec3 place_outside(const pm_scene *scene, int number)
{
    double z = 2.0 * fraction(0.5 + 0.8191725133961645 * number) - 1.0;
    double azimuth = 2.0 * PM_PI * fraction(0.6710436067037893 * number);
    double across = sqrt(1.0 - z * z);
    return pm_vec_scale(pm_vec(across * cos(azimuth), across * sin(azimuth), z),
                        2.0 * scene->radius);
}

pm_scene_place pm_scene_inside_around(const pm_scene_inside *inside)
{
    pm_scene_place around = {.medium = PM_NONE, .other = PM_NONE};
    for (int i = 0; i < LINES_THROUGH; i++) {
        pm_vec3 from = place_outside(&inside->bounds, i);
        pm_scene_place found =
            cross_all(inside, ray_from(inside, from, i, LINES_THROUGH), &around);
        if (found.against != NULL) {
            return found;
        }
    }
    return around;
}

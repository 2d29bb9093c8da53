// A straight line from a point to a point on a shape that parts media first meets one of these
// shapes, and from the side of the medium that the first point is in; so lines to many of them
// agree, or the shapes do not close.
#include "scene_inside.h"

#include "intersect_plain.h"
#include "shape.h"

#include <math.h>

#define LINES 16

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

/// The medium at `from` as one line tells it, and the shape that it meets; NULL when none.
static const pm_shape *ask(const pm_scene_inside *inside, pm_vec3 from, int line, int *medium)
{
    const pm_scene *bounds = &inside->bounds;
    int count = bounds->shape_count;
    int which = count <= LINES ? line % count : (int)((int64_t)line * count / LINES);
    pm_vec3 way = pm_vec_sub(place_on(&bounds->shapes[which], line), from);
    pm_ray ray = {from, pm_vec_normalize(way), HUGE_VAL, 0.0, PM_NONE};
    pm_hit hit;
    if (!(pm_vec_length(way) > 0.0) || !pm_closest(&inside->world, &ray, &hit)) {
        return NULL;
    }
    const pm_shape *shape = &bounds->shapes[hit.shape];
    bool before = pm_vec_dot(hit.normal, ray.direction) < 0.0;
    *medium = before ? shape->exterior : shape->interior;
    return shape;
}

pm_scene_place pm_scene_inside_at(const pm_scene_inside *inside, pm_vec3 from)
{
    pm_scene_place place = {.medium = PM_NONE, .other = PM_NONE};
    for (int i = 0; i < LINES && place.against == NULL; i++) {
        int medium;
        const pm_shape *shape = ask(inside, from, i, &medium);
        if (shape != NULL && place.by == NULL) {
            place.medium = medium;
            place.by = shape;
        } else if (shape != NULL && medium != place.medium) {
            place.other = medium;
            place.against = shape;
        }
    }
    return place;
}

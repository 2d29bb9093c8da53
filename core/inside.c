// One line is enough where shapes close, so lines to further shapes are drawn only when one
// misses what it was drawn to: a line that grazes its end may.
#include "inside.h"

#include "shape.h"

/// Inside the first face of a mesh, off the middle of any other shape.
static pm_vec3 place_on(const pm_shape *shape)
{
    if (shape->type == PM_SHAPE_MESH) {
        const uint32_t *corner = shape->triangles[0];
        pm_vec3 place = pm_vec_scale(shape->vertices[corner[0]], 0.45);
        place = pm_vec_along(place, shape->vertices[corner[1]], 0.3);
        return pm_vec_along(place, shape->vertices[corner[2]], 0.25);
    }
    pm_hit hit;
    pm_shape_point(shape, 0.37, 0.61, &hit);
    return hit.position;
}

/// What lies on this side of the first shape on the way that parts media; false without one.
static bool look_along(const pm_intersector *world, pm_ray ray, int *medium)
{
    pm_hit hit;
    while (pm_closest(world, &ray, &hit)) {
        const pm_shape *shape = &world->scene->shapes[hit.shape];
        if (shape->boundary) {
            bool before = pm_vec_dot(hit.normal, ray.direction) < 0.0;
            *medium = before ? shape->exterior : shape->interior;
            return true;
        }
        ray = pm_hit_ray(&hit, ray.direction, 0.0, PM_NONE);
    }
    return false;
}

int pm_inside_medium(const pm_intersector *world, pm_vec3 at)
{
    const pm_scene *scene = world->scene;
    int medium = scene->light_count > 0 ? scene->lights[0].medium : PM_NONE;
    for (int i = 0; i < scene->shape_count; i++) {
        if (!scene->shapes[i].boundary) {
            continue;
        }
        pm_vec3 way = pm_vec_sub(place_on(&scene->shapes[i]), at);
        pm_ray ray = {at, pm_vec_normalize(way), HUGE_VAL, 0.0, PM_NONE};
        if (pm_vec_length(way) > 0.0 && look_along(world, ray, &medium)) {
            return medium;
        }
    }
    return medium;
}

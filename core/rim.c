// A wall at the distance a is met by the axis that is most along its normal, at most at
// sqrt(3) a.
#include "rim.h"

#include <stddef.h>

#define FARTHER 1.7320508075688774 // sqrt(3)

/// Whether a surface ends a photon's medium.
static bool ends_medium(const pm_scene *scene, const pm_hit *hit)
{
    const pm_shape *shape = &scene->shapes[hit->shape];
    int material = shape->material[0];
    bool null = material != PM_NONE && scene->materials[material].type == PM_BSDF_NULL;
    return !null || (shape->boundary && shape->interior != shape->exterior);
}

/// The first such surface along a ray.
static bool meet_end(const pm_intersector *world, pm_ray ray, pm_hit *hit)
{
    double end = ray.t_max;
    while (end > 0.0) {
        ray.t_max = end;
        if (!pm_closest(world, &ray, hit)) {
            return false;
        }
        if (ends_medium(world->scene, hit)) {
            return true;
        }
        end -= hit->t;
        ray = pm_hit_ray(hit, ray.direction, 0.0, PM_NONE);
    }
    return false;
}

static pm_rim plane_of(const pm_hit *hit, pm_vec3 at)
{
    double height = pm_vec_dot(pm_vec_sub(hit->position, at), hit->normal);
    double side = height < 0.0 ? -1.0 : 1.0;
    return (pm_rim){
        {(float)(side * hit->normal.x), (float)(side * hit->normal.y),
         (float)(side * hit->normal.z)},
        (float)(side * height),
    };
}

pm_rim pm_rim_find(const pm_intersector *world, pm_vec3 at, double radius)
{
    pm_rim nearest = pm_rim_none;
    for (int way = 0; way < 6 && world != NULL; way++) {
        double step = way % 2 == 0 ? 1.0 : -1.0;
        pm_ray ray = {
            .origin = at,
            .direction = pm_vec(way / 2 == 0 ? step : 0.0, way / 2 == 1 ? step : 0.0,
                                way / 2 == 2 ? step : 0.0),
            .t_max = FARTHER * radius,
            .medium = PM_NONE,
        };
        pm_hit hit;
        if (!meet_end(world, ray, &hit)) {
            continue;
        }
        pm_rim plane = plane_of(&hit, at);
        nearest = plane.distance < nearest.distance ? plane : nearest;
    }
    return (double)nearest.distance < radius ? nearest : pm_rim_none;
}

// The scene's surface behind a pixel: a click a second needs no fast ray queries.
#include "surface.h"

#include "intersect_plain.h"

static pm_surface look(const pm_intersector *world, pm_vec3 from, pm_vec3 forward)
{
    pm_ray ray = {from, forward, HUGE_VAL, 0.0, PM_NONE};
    pm_hit hit;
    while (pm_closest(world, &ray, &hit)) {
        bool front = pm_vec_dot(hit.normal, forward) < 0.0;
        const pm_shape *shape = &world->scene->shapes[hit.shape];
        if (shape->material[front ? 0 : 1] != PM_NONE) {
            pm_vec3 normal = pm_vec_scale(hit.normal, front ? 1.0 : -1.0);
            return (pm_surface){true, hit.position, normal, shape->id};
        }
        ray = pm_hit_ray(&hit, forward, 0.0, PM_NONE);
    }
    return (pm_surface){0};
}

pm_status pm_surface_find(const pm_scene *scene, pm_vec3 from, pm_vec3 forward,
                          pm_surface *surface)
{
    pm_intersector world;
    PM_TRY(pm_intersect_plain(scene, &world));
    *surface = look(&world, from, forward);
    pm_intersector_free(&world);
    return PM_OK;
}

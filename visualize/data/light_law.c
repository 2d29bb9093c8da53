// Bands are found by adding the density up in small steps of the angle, so that each law stands
// here in one place only.
#include "light_law.h"

#include "light.h"
#include "shape.h"

#define STEPS 8192

static bool is_curved(const pm_shape *shape)
{
    return shape->type != PM_SHAPE_RECTANGLE && shape->type != PM_SHAPE_DISK;
}

/// Which triangle of a mesh, or the one face of another shape, lies at a point.
static uint32_t nearest_primitive(const pm_shape *shape, pm_vec3 at)
{
    uint32_t nearest = 0;
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < pm_shape_primitives(shape) && shape->type == PM_SHAPE_MESH; i++) {
        pm_ray ray = {.origin = at, .direction = {0.0, 0.0, 1.0}};
        pm_hit hit = {.primitive = i};
        pm_shape_complete(shape, &ray, &hit);
        double off = pm_vec_length(pm_vec_sub(hit.position, at));
        if (off < least) {
            least = off;
            nearest = i;
        }
    }
    return nearest;
}

static pm_vec3 normal_at(const pm_shape *shape, pm_vec3 at)
{
    pm_ray ray = {.origin = at, .direction = {0.0, 0.0, 1.0}};
    pm_hit hit = {.primitive = nearest_primitive(shape, at)};
    pm_shape_complete(shape, &ray, &hit);
    return hit.normal;
}

static pm_vec3 axis_of(const pm_scene *scene, const pm_light *light, bool turned)
{
    pm_vec3 up = scene->has_camera ? scene->camera.up : pm_vec(0.0, 1.0, 0.0);
    switch (light->type) {
    case PM_LIGHT_AREA:
        return turned ? up : normal_at(&scene->shapes[light->shape], light->position);
    case PM_LIGHT_SPOT:
    case PM_LIGHT_DIRECTIONAL:
        return light->direction;
    case PM_LIGHT_POINT:
    case PM_LIGHT_CONSTANT:
        break;
    }
    return pm_vec(0.0, 0.0, 1.0);
}

pm_light_law pm_light_law_of(const pm_scene *scene, int index)
{
    const pm_light *light = &scene->lights[index];
    pm_light_law law = {.scene = scene, .light = light, .reach = PM_PI};
    law.single = light->type == PM_LIGHT_DIRECTIONAL;
    law.turned = light->type == PM_LIGHT_AREA && is_curved(&scene->shapes[light->shape]);
    law.axis = pm_frame_around(axis_of(scene, light, law.turned));
    if (light->type == PM_LIGHT_AREA) {
        law.reach = 0.5 * PM_PI;
    } else if (light->type == PM_LIGHT_SPOT) {
        law.reach = light->cutoff;
    }
    return law;
}

double pm_light_law_density(const pm_light_law *law, double angle)
{
    switch (law->light->type) {
    case PM_LIGHT_AREA:
        return pm_most(0.0, cos(angle)) / PM_PI;
    case PM_LIGHT_SPOT:
        return pm_light_falloff(law->light, cos(angle)) / pm_light_cone(law->light);
    case PM_LIGHT_DIRECTIONAL:
        return 0.0;
    case PM_LIGHT_POINT:
    case PM_LIGHT_CONSTANT:
        break;
    }
    return 1.0 / (4.0 * PM_PI);
}

double pm_light_law_solid(double from, double to)
{
    return 4.0 * PM_PI * sin(0.5 * (to + from)) * sin(0.5 * (to - from));
}

void pm_light_law_bands(const pm_light_law *law, int count, double *border)
{
    const double step = law->reach / STEPS;
    double below = 0.0;
    int next = 0;
    border[next++] = 0.0;
    for (int i = 0; i < STEPS && next < count; i++) {
        double power = pm_light_law_density(law, (i + 0.5) * step) *
                       pm_light_law_solid(i * step, (i + 1) * step);
        while (next < count && below + power >= (double)next / count) {
            border[next] = step * (i + ((double)next / count - below) / power);
            next++;
        }
        below += power;
    }
    for (; next <= count; next++) {
        border[next] = law->reach;
    }
}

pm_vec3 pm_light_law_local(const pm_light_law *law, const pm_ray_start *ray)
{
    pm_frame frame = law->axis;
    if (law->turned) {
        pm_vec3 normal = normal_at(&law->scene->shapes[law->light->shape], ray->origin);
        bool there = isfinite(pm_vec_dot(normal, normal)); // none in the middle of a sphere
        frame = there ? pm_frame_around(normal) : frame;
    }
    return pm_vec(pm_vec_dot(ray->direction, frame.s), pm_vec_dot(ray->direction, frame.t),
                  pm_vec_dot(ray->direction, frame.n));
}

double pm_light_law_angle(pm_vec3 local)
{
    return atan2(hypot(local.x, local.y), local.z);
}

// A density per area becomes one per solid angle by distance^2 / cos at the light.
#include "light.h"

#include "medium.h"
#include "shape.h"

double pm_light_falloff(const pm_light *light, double cosine)
{
    if (cosine >= cos(light->beam)) {
        return 1.0;
    }
    if (cosine <= cos(light->cutoff)) {
        return 0.0;
    }
    double share = (light->cutoff - acos(cosine)) / (light->cutoff - light->beam);
    return pm_least(1.0, pm_most(0.0, share)); // acos is coarse near 0, for very narrow cones
}

/// 1 - sin(x) / x, without the cancellation near 0.
static double one_minus_sinc(double x)
{
    if (x > 0.1) {
        return 1.0 - sin(x) / x;
    }
    double x2 = x * x;
    return x2 / 6.0 * (1.0 - x2 / 20.0 * (1.0 - x2 / 42.0 * (1.0 - x2 / 72.0)));
}

double pm_light_cone(const pm_light *light)
{
    // 2 pi [1 - (sin c - sin b) / (c - b)] for beam b and cutoff c, in terms of their mean and
    // half their difference, so that a narrow cone loses no digits and c = b is no exception.
    double middle = 0.5 * (light->cutoff + light->beam);
    double half = 0.5 * (light->cutoff - light->beam);
    double sine = sin(0.5 * middle);
    return 2.0 * PM_PI * (2.0 * sine * sine + cos(middle) * one_minus_sinc(half));
}

/// Points and spots.
static bool sample_point(const pm_light *light, pm_vec3 from, pm_light_sample *sample)
{
    pm_vec3 way = pm_vec_sub(light->position, from);
    double distance2 = pm_vec_dot(way, way);
    if (distance2 == 0.0) {
        return false;
    }
    sample->target = light->position;
    sample->direction = pm_vec_scale(way, 1.0 / sqrt(distance2));
    double share = 1.0;
    if (light->type == PM_LIGHT_SPOT) {
        share = pm_light_falloff(light, -pm_vec_dot(sample->direction, light->direction));
    }
    sample->radiance = pm_spectrum_scale(light->emitted, share / distance2);
    return share > 0.0;
}

static bool sample_area(const pm_scene *scene, const pm_light *light, pm_vec3 from,
                        const double u[2], pm_light_sample *sample)
{
    const pm_shape *shape = &scene->shapes[light->shape];
    pm_hit source = {.shape = light->shape};
    pm_shape_point(shape, u[0], u[1], &source);
    pm_vec3 way = pm_vec_sub(source.position, from);
    double distance2 = pm_vec_dot(way, way);
    if (distance2 == 0.0) {
        return false;
    }
    sample->direction = pm_vec_scale(way, 1.0 / sqrt(distance2));
    double leaving = -pm_vec_dot(sample->direction, source.normal);
    if (leaving <= 0.0) {
        return false;
    }
    sample->target = pm_hit_leave(&source, pm_vec_negate(sample->direction));
    double solid_angle = leaving * shape->area / distance2;
    sample->pdf = 1.0 / solid_angle;
    sample->radiance = pm_spectrum_scale(light->emitted, solid_angle);
    return true;
}

bool pm_light_sample_from(const pm_scene *scene, const pm_light *light, pm_vec3 from,
                          const double u[2], pm_light_sample *sample)
{
    *sample = (pm_light_sample){0};
    switch (light->type) {
    case PM_LIGHT_POINT:
    case PM_LIGHT_SPOT:
        return sample_point(light, from, sample);
    case PM_LIGHT_AREA:
        return sample_area(scene, light, from, u, sample);
    case PM_LIGHT_DIRECTIONAL:
        sample->direction = pm_vec_negate(light->direction);
        sample->endless = true;
        sample->radiance = light->emitted;
        return true;
    case PM_LIGHT_CONSTANT:
        break;
    }
    return false;
}

bool pm_light_place(const pm_scene *scene, const pm_light *light, const double u[2],
                    pm_vec3 *place)
{
    if (light->type == PM_LIGHT_DIRECTIONAL || light->type == PM_LIGHT_CONSTANT) {
        return false;
    }
    *place = light->position;
    if (light->type == PM_LIGHT_AREA) {
        pm_hit source = {.shape = light->shape};
        pm_shape_point(&scene->shapes[light->shape], u[0], u[1], &source);
        *place = source.position;
    }
    return true;
}

double pm_light_clear(const pm_intersector *world, pm_vec3 from, int medium,
                      const pm_light_sample *sample)
{
    pm_ray ray = {from, sample->direction, HUGE_VAL, 0.0, medium};
    if (!sample->endless) {
        // From a hit's offset origin the light lies in a slightly other direction.
        pm_vec3 way = pm_vec_sub(sample->target, from);
        ray.t_max = pm_vec_length(way);
        if (ray.t_max == 0.0) {
            return 1.0;
        }
        ray.direction = pm_vec_scale(way, 1.0 / ray.t_max);
    }
    return pm_medium_clear(world, &ray);
}

double pm_light_pdf(const pm_scene *scene, const pm_hit *hit, pm_vec3 from, pm_vec3 direction)
{
    double leaving = -pm_vec_dot(direction, hit->normal);
    if (scene->shapes[hit->shape].light == PM_NONE || leaving <= 0.0) {
        return 0.0;
    }
    pm_vec3 way = pm_vec_sub(hit->position, from);
    return pm_vec_dot(way, way) / (leaving * scene->shapes[hit->shape].area);
}

pm_spectrum pm_light_emitted(const pm_scene *scene, const pm_hit *hit, pm_vec3 wo)
{
    int light = scene->shapes[hit->shape].light;
    bool front = pm_vec_dot(wo, hit->normal) > 0.0;
    return light != PM_NONE && front ? scene->lights[light].emitted : pm_gray(0.0);
}

pm_spectrum pm_light_sky(const pm_scene *scene)
{
    pm_spectrum sky = pm_gray(0.0);
    for (int i = 0; i < scene->light_count; i++) {
        if (scene->lights[i].type == PM_LIGHT_CONSTANT) {
            sky = pm_spectrum_add(sky, scene->lights[i].emitted);
        }
    }
    return sky;
}

const char *pm_light_name(pm_light_type type)
{
    static const char *const names[] = {"point", "area", "directional", "spot", "constant"};
    return names[type];
}

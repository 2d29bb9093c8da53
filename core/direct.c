// L = sum over lights of f * (what arrives without the surface) * cos / pdf, where nothing is
// between.
#include "direct.h"

#include "lattice.h"
#include "light.h"

/// f * cos towards `direction`, 0 where the surface does not look.
static pm_spectrum response(const pm_lobes *lobes, pm_vec3 direction)
{
    double cosine = pm_vec_dot(direction, lobes->normal);
    return pm_spectrum_scale(pm_material_evaluate(lobes, direction), pm_most(0.0, cosine));
}

/// Whether something stands between the receiver and the light.
static bool shadowed(pm_direct_query *query, const pm_hit *hit, const pm_lobes *lobes,
                     const pm_light_sample *sample)
{
    pm_ray ray = pm_hit_ray(hit, sample->direction, 0.0, lobes->medium_here);
    if (!sample->endless) {
        pm_vec3 way = pm_vec_sub(sample->target, ray.origin);
        ray.t_max = pm_vec_length(way);
        if (ray.t_max == 0.0) {
            return false;
        }
        ray.direction = pm_vec_scale(way, 1.0 / ray.t_max);
    }
    query->rays++;
    return pm_blocked(query->world, &ray);
}

/// What one draw of one light brings.
static pm_spectrum from_light(pm_direct_query *query, const pm_light *light, const double u[2],
                              const pm_hit *hit, const pm_lobes *lobes)
{
    pm_light_sample sample;
    if (!pm_light_sample_from(query->world->scene, light, hit->position, u, &sample)) {
        return pm_gray(0.0);
    }
    pm_spectrum f = response(lobes, sample.direction);
    if (pm_spectrum_is_black(f) || shadowed(query, hit, lobes, &sample)) {
        return pm_gray(0.0);
    }
    return pm_spectrum_mul(f, sample.radiance);
}

pm_spectrum pm_direct(pm_direct_query *query, const pm_hit *hit, const pm_lobes *lobes)
{
    const pm_scene *scene = query->world->scene;
    pm_spectrum sum = pm_gray(0.0);
    for (int i = 0; i < scene->light_count; i++) {
        uint32_t samples = scene->lights[i].type == PM_LIGHT_AREA ? query->samples : 1;
        for (uint32_t s = 0; s < samples; s++) {
            double u[2];
            uint32_t point = query->first + s * query->step;
            pm_lattice_point(query->shift, point, samples * query->step, u);
            pm_spectrum one = from_light(query, &scene->lights[i], u, hit, lobes);
            sum = pm_spectrum_add(sum, pm_spectrum_scale(one, 1.0 / samples));
        }
    }
    return sum;
}

pm_spectrum pm_direct_glint(pm_direct_query *query, const pm_hit *hit, const pm_lobes *lobes)
{
    (void)query;
    (void)hit;
    (void)lobes;
    return pm_gray(0.0);
}

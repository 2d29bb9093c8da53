// The phase function and its inverse are written so that no digits are lost for g near 0 or
// near +-1; neither has a special case.
#include "medium.h"

#include "material.h"

double pm_medium_depth(const pm_medium *medium, double length)
{
    return medium->sigma_t > 0.0 ? medium->sigma_t * length : 0.0;
}

double pm_medium_transmittance(const pm_medium *medium, double length)
{
    return exp(-pm_medium_depth(medium, length));
}

double pm_medium_collision_depth(double u)
{
    return -log1p(-u);
}

double pm_medium_phase(const pm_medium *medium, double cosine)
{
    double g = medium->g;
    double base = (1.0 - g) * (1.0 - g) + 2.0 * g * (1.0 - cosine); // 1 + g^2 - 2 g cos
    return (1.0 - g * g) / (4.0 * PM_PI * base * sqrt(base));
}

/// The cosine below which lies the share (1 + s) / 2 of the phase function.
static double cosine_at(double g, double s)
{
    double g2 = g * g;
    double root = 1.0 + g * s;
    double cosine =
        (s * (1.0 + g2) + 0.5 * g * (s * s * (1.0 + g2) + 3.0 - g2)) / (root * root);
    return pm_most(-1.0, pm_least(1.0, cosine)); // rounding only
}

pm_vec3 pm_medium_turn(const pm_medium *medium, pm_vec3 direction, pm_rng *rng)
{
    double s = 2.0 * pm_rng_draw(rng) - 1.0;
    double azimuth = 2.0 * PM_PI * pm_rng_draw(rng);
    double cosine = cosine_at(medium->g, s);
    double sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    pm_frame frame = pm_frame_around(direction);
    pm_vec3 local = pm_vec(sine * cos(azimuth), sine * sin(azimuth), cosine);
    return pm_vec_normalize(pm_frame_to_world(&frame, local));
}

/// Through null surfaces, from medium to medium.
static double clear_through_media(const pm_intersector *world, pm_ray ray)
{
    const pm_scene *scene = world->scene;
    double depth = 0.0;
    double left = ray.t_max;
    for (;;) {
        pm_hit hit;
        bool met = pm_closest(world, &ray, &hit);
        if (ray.medium != PM_NONE) {
            depth += pm_medium_depth(&scene->media[ray.medium], met ? hit.t : ray.t_max);
        }
        if (!met) {
            return exp(-depth);
        }
        pm_lobes lobes;
        pm_material_lobes(scene, &hit, &ray, &lobes);
        if (!lobes.passes) {
            return 0.0;
        }
        left -= hit.t;
        if (!(left > 0.0)) {
            return exp(-depth);
        }
        ray = pm_hit_ray(&hit, ray.direction, ray.wavelength, lobes.medium_beyond);
        ray.t_max = left;
    }
}

double pm_medium_clear(const pm_intersector *world, const pm_ray *ray)
{
    if (world->scene->medium_count == 0) {
        return pm_blocked(world, ray) ? 0.0 : 1.0;
    }
    return clear_through_media(world, *ray);
}

// The phase function and its inverse are written in sums of terms of one sign, so that no
// digits are lost for g near 0 or near +-1.
#include "medium.h"

#include "shape.h"

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
    double apart = g < 0.0 ? 1.0 + cosine : 1.0 - cosine; // from the likeliest way
    double rest = 1.0 - fabs(g);
    double base = rest * rest + 2.0 * fabs(g) * apart; // 1 + g^2 - 2 g cos
    return rest * (1.0 + fabs(g)) / (4.0 * PM_PI * base * sqrt(base));
}

/// 1 - cosine at which the share (1 + s) / 2 of the phase function has a smaller cosine; with
/// both signs changed, 1 + cosine.
static double apart_at(double g, double s)
{
    double root = g < 0.0 ? 1.0 + g - g * (1.0 - s) : 1.0 - g + g * (1.0 + s); // 1 + g s
    double part = (1.0 - g) / root;
    return 0.5 * part * part * (1.0 - s) * (root + 1.0 + g);
}

pm_vec3 pm_medium_turn(const pm_medium *medium, pm_vec3 direction, pm_rng *rng)
{
    double s = 2.0 * pm_rng_draw(rng) - 1.0;
    double azimuth = 2.0 * PM_PI * pm_rng_draw(rng);
    double before = apart_at(medium->g, s);
    double behind = apart_at(-medium->g, -s);
    double cosine = before < behind ? 1.0 - before : behind - 1.0;
    double sine = sqrt(before * behind);
    pm_frame frame = pm_frame_around(direction);
    pm_vec3 local = pm_vec(sine * cos(azimuth), sine * sin(azimuth), cosine);
    return pm_vec_normalize(pm_frame_to_world(&frame, local));
}

double pm_medium_share(const pm_scene *scene, int medium, double length)
{
    return medium == PM_NONE ? 1.0 : pm_medium_transmittance(&scene->media[medium], length);
}

pm_ray pm_medium_beyond(const pm_scene *scene, const pm_ray *ray, const pm_hit *hit)
{
    const pm_shape *shape = &scene->shapes[hit->shape];
    int medium = ray->medium;
    if (shape->boundary) {
        bool inward = pm_vec_dot(ray->direction, hit->normal) < 0.0;
        medium = inward ? shape->interior : shape->exterior;
    }
    return pm_hit_ray(hit, ray->direction, ray->wavelength, medium);
}

/// Turns a ray that starts anew beyond a null surface, a little aside, to where it was to end.
/// False when it is there.
static bool aim(pm_ray *ray, pm_vec3 target)
{
    pm_vec3 way = pm_vec_sub(target, ray->origin);
    if (pm_vec_dot(way, ray->direction) <= 0.0) {
        return false;
    }
    ray->t_max = pm_vec_length(way);
    ray->direction = pm_vec_scale(way, 1.0 / ray->t_max);
    return true;
}

/// Through null surfaces, from medium to medium.
static double clear_through_media(const pm_intersector *world, pm_ray ray)
{
    const pm_scene *scene = world->scene;
    bool endless = ray.t_max == HUGE_VAL;
    pm_vec3 target = pm_vec_along(ray.origin, ray.direction, endless ? 0.0 : ray.t_max);
    double share = 1.0;
    pm_hit hit;
    while (share > 0.0 && pm_closest(world, &ray, &hit)) {
        if (!pm_shape_is_null(scene, &scene->shapes[hit.shape])) {
            return 0.0;
        }
        share *= pm_medium_share(scene, ray.medium, hit.t);
        ray = pm_medium_beyond(scene, &ray, &hit);
        if (!endless && !aim(&ray, target)) {
            return share;
        }
    }
    return share * pm_medium_share(scene, ray.medium, ray.t_max);
}

double pm_medium_clear(const pm_intersector *world, const pm_ray *ray)
{
    if (world->scene->medium_count == 0) {
        return pm_blocked(world, ray) ? 0.0 : 1.0;
    }
    return clear_through_media(world, *ray);
}

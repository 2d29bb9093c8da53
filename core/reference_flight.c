// A way without a medium draws no number, so scenes without one are drawn as if there were
// none.
#include "reference_flight.h"

#include "medium.h"
#include "wavelength.h"

/// Whether the next `length` [m] of the ray's medium use up the optical depth that is left.
static bool collides(const pm_medium *medium, double length, pm_rng *rng, double *left)
{
    if (*left < 0.0) {
        *left = pm_medium_collision_depth(pm_rng_draw(rng));
    }
    double thickness = pm_medium_depth(medium, length);
    if (*left < thickness) {
        return true;
    }
    *left -= thickness;
    return false;
}

void pm_reference_fly(const pm_intersector *world, const pm_ray *ray, pm_rng *rng, double *left,
                      pm_reference_meeting *at)
{
    bool met = pm_closest(world, ray, &at->hit);
    if (ray->medium != PM_NONE) {
        const pm_medium *medium = &world->scene->media[ray->medium];
        if (collides(medium, met ? at->hit.t : HUGE_VAL, rng, left)) {
            at->place = PM_REFERENCE_MEDIUM;
            at->position = pm_vec_along(ray->origin, ray->direction, *left / medium->sigma_t);
            return;
        }
    }
    at->place = met ? PM_REFERENCE_SURFACE : PM_REFERENCE_OUTSIDE;
    if (met) {
        at->position = at->hit.position;
        pm_material_lobes(world->scene, &at->hit, ray, &at->lobes);
    }
}

pm_ray pm_reference_beyond(const pm_ray *ray, const pm_reference_meeting *at)
{
    return pm_hit_ray(&at->hit, ray->direction, ray->wavelength, at->lobes.medium_beyond);
}

void pm_reference_colour(const pm_scene *scene, double share, pm_ray *ray, pm_spectrum *weight,
                         pm_reference_meeting *at)
{
    ray->wavelength = pm_wavelength_at(share);
    *weight = pm_spectrum_mul(*weight, pm_wavelength_weight(ray->wavelength));
    pm_material_lobes(scene, &at->hit, ray, &at->lobes);
}

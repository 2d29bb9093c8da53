// Which of many rays a picture shows, and where they start to be seen.
//
// Invariant: every light is thinned at the same rate and by itself. Lights take turns in a
// pass, so a step through all rays together could meet the same light again and again.
#ifndef PM_RAY_PICK_H
#define PM_RAY_PICK_H

#include "ray_file.h"

#include <stdbool.h>

/// A photon to be drawn.
typedef struct {
    const pm_ray_start *ray;
    pm_vec3 start; // the ray's origin; of light from outside, where it comes into the scene
    bool arrow;    // its way is shown, too
} pm_ray_shown;

/// What the photons of one light add up to, in the file.
typedef struct {
    uint64_t count;
    uint64_t past;     // of them from outside, and past the scene's bounds
    pm_spectrum power; // [W]
} pm_ray_sum;

/// Freed by pm_ray_pick_free().
typedef struct {
    pm_ray_shown *shown;
    uint64_t count, arrows;
    pm_ray_sum *light; // one a light
} pm_ray_choice;

/// Chooses, evenly, about `dots` rays and about `arrows` of those; no light that sends any that
/// can be seen has none. Rays past the scene are not chosen.
/// @param light   PM_NONE: all
/// @param choice  [out] refers to `rays`
/// @return PM_ENOMEM
pm_status pm_ray_pick(const pm_ray_set *rays, const pm_scene *scene, int light, uint64_t dots,
                      uint64_t arrows, pm_ray_choice *choice);
void pm_ray_pick_free(pm_ray_choice *choice);

#endif

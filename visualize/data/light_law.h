// How a light's power should be spread over directions: a density over the angle to an axis,
// the same all around it. What counted photons are held against.
//
// A curved lamp has no axis of its own: there the axis is the normal where a photon starts.
#ifndef PM_LIGHT_LAW_H
#define PM_LIGHT_LAW_H

#include "ray_file.h"

#include <stdbool.h>

typedef struct {
    const pm_scene *scene;
    const pm_light *light;
    pm_frame axis; // to draw about; for a curved lamp its n is any direction
    bool turned;   // the normal of each start takes the place of axis.n
    bool single;   // all photons go along axis.n: there is no density
    double reach;  // [rad] no photon is farther from the axis than this
} pm_light_law;

pm_light_law pm_light_law_of(const pm_scene *scene, int light);

/// Share of the light's power that should leave at `angle` [rad] to the axis [1/sr].
double pm_light_law_density(const pm_light_law *law, double angle);

/// Cuts 0 to `reach` into `count` bands of equal power.
/// @param border  [out] [rad] count + 1 of them, ascending
void pm_light_law_bands(const pm_light_law *law, int count, double *border);

/// The direction of a photon of this light in coordinates of which z is the axis.
pm_vec3 pm_light_law_local(const pm_light_law *law, const pm_ray_start *ray);

/// The angle [rad] of such a direction to the axis.
double pm_light_law_angle(pm_vec3 local);

/// The solid angle [sr] between two angles to the axis.
double pm_light_law_solid(double from, double to);

#endif

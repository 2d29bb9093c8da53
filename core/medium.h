// Fog, smoke, water: what a medium does to light on its way.
//
// Invariant: distances are drawn with the density sigma_t exp(-sigma_t t), so that a photon
// that gets through carries all its power, and one that collides goes on with the share
// `albedo`. Directions are ways of travel, before and after; g is the mean cosine between them.
#ifndef PM_MEDIUM_H
#define PM_MEDIUM_H

#include "intersect.h"
#include "rng.h"

/// Optical depth of `length` [m]: sigma_t * length; 0 in a medium that takes nothing, over any
/// length.
double pm_medium_depth(const pm_medium *medium, double length);

/// Share of light that gets through `length` [m]: exp(-depth).
double pm_medium_transmittance(const pm_medium *medium, double length);

/// The optical depth at which a path collides, from a uniform number in [0, 1).
double pm_medium_collision_depth(double u);

/// Henyey-Greenstein phase function [1/sr] at the cosine between the ways before and after;
/// also the density with which pm_medium_turn() draws.
/// @source Henyey and Greenstein, "Diffuse radiation in the galaxy", ApJ 93, 1941
double pm_medium_phase(const pm_medium *medium, double cosine);

/// A way to go on after a collision on the way `direction`; both unit.
pm_vec3 pm_medium_turn(const pm_medium *medium, pm_vec3 direction, pm_rng *rng);

/// Share of light that gets through `length` [m] of medium number `medium` of the scene;
/// all of it where that is PM_NONE.
double pm_medium_share(const pm_scene *scene, int medium, double length);

/// `ray` beyond the null surface that it met at `hit`: without end, in the medium there.
pm_ray pm_medium_beyond(const pm_scene *scene, const pm_ray *ray, const pm_hit *hit);

/// Share of light that gets along `ray` to its t_max: 0 where a surface other than null stands,
/// else what all media on the way let through.
double pm_medium_clear(const pm_intersector *world, const pm_ray *ray);

#endif

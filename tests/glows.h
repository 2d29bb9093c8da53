// Light scattered once into a ray, asked for again and again, and its integrals.
#ifndef PM_GLOWS_H
#define PM_GLOWS_H

#include "scenes.h"
#include "single.h"

/// Mean of many runs and the sd of this mean.
typedef struct {
    double mean, sd;
} pm_glows_answer;

/// pm_single() with `samples` places for each light; runs differ by their number.
pm_spectrum pm_glows_run(const pm_scenes *s, const pm_ray *along, uint32_t samples, int number);

/// The second channel of `runs` runs.
pm_glows_answer pm_glows_ask(const pm_scenes *s, const pm_ray *along, uint32_t samples,
                             int runs);

/// Holds both one place a run and 16 to `want` within 5 sd; 250 runs of 16 must be as sharp as
/// `sharp` of it.
void pm_glows_check(const pm_scenes *s, const pm_ray *along, double want, double sharp);

/// A ray in medium 0.
pm_ray pm_glows_ray(pm_vec3 from, pm_vec3 direction, double t_max);

/// Begins a scene of endless fog: medium 0, all around. `albedo` is that of the second channel.
void pm_glows_fog(pm_scenes *s, double sigma_t, double albedo, double g);

/// What is integrated along a ray in endless fog.
typedef struct {
    const pm_scenes *s;
    pm_ray along;
    double v[2]; // where on light number 0, if it is a lamp
    double t;
} pm_glows_integrand;

/// What light number 0 adds at `t` on the ray, per length; unshadowed.
/// @param integrand  a pm_glows_integrand
double pm_glows_scattered(double t, void *integrand);

#endif

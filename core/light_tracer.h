// Paths from the lights to the camera: they find what paths from the eye cannot, the light of
// lights without extent after smooth glass or mirrors.
//
// Invariant: a photon of power P [W] at a surface point x that the camera sees at the distance
// r adds, to the pixel that shows x,
//
//     P f cos(x) T / (r^2 cos^3(axis) A),  A = area of a pixel on the film at distance 1,
//
// where cos(x) is at the surface, cos(axis) between the axis of the camera and its ray, and T
// what media let through: the radiance P f cos(x) T / dx over the part of the film on which dx
// is seen. A collision in a medium adds the same with albedo * phase function for f cos(x).
// Over all photons emitted this is the mean radiance over the pixel that eye paths estimate
// too.
// @source Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997
#ifndef PM_LIGHT_TRACER_H
#define PM_LIGHT_TRACER_H

#include "caps.h"
#include "layer.h"
#include "trace.h"

typedef struct {
    const pm_intersector *world; // its scene has a camera
    pm_rng_source source;
    uint64_t count; // light paths
    pm_roulette_rule rule;
    pm_caps caps;
    bool everything; // all lights, and all paths with an event at which a camera can be met;
                     // else only lights without extent, and paths whose event next to the
                     // light is smooth
} pm_light_tracing;

/// Whether the light is a point or shines from one direction, so that no path from the eye
/// meets it by chance.
static inline bool pm_light_tracer_takes(const pm_light *light)
{
    return light->type == PM_LIGHT_POINT || light->type == PM_LIGHT_SPOT ||
           light->type == PM_LIGHT_DIRECTIONAL;
}

/// Traces the paths and adds the mean over them to the film.
///
/// Paths that reach the camera from a smooth lobe are missing: no pixel but one would do.
///
/// @param film  [in, out] radiance [W/(m^2 sr)] of width * height pixels, each PM_LAYER_COUNT
/// @param cut   [in, out] counts paths ended by a cap
/// @return PM_EINPUT when there are fewer paths than lights that send power; PM_ENOMEM;
///         PM_ESTOPPED on SIGINT. Then the film may hold a part of it.
pm_status pm_light_tracer_run(const pm_light_tracing *tracing, pm_spectrum *film,
                              uint64_t *cut);

#endif

// One path from the eye, and all that is found along it.
//
// Invariant: light is found in two ways, by a point drawn on each light and where the path
// itself meets one; for every lobe that can do both, and for every medium, the balance
// heuristic weighs them, so that both together count each path once. No chance of the roulette
// enters these weights: given the lobe, both ways know the same densities. A path collides in a
// medium with the chance that light does, so none of its weight is lost on the way.
// @source Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997
#ifndef PM_REFERENCE_PATH_H
#define PM_REFERENCE_PATH_H

#include "caps.h"
#include "layer.h"
#include "trace.h"

/// What all paths of a picture share.
typedef struct {
    const pm_intersector *world;
    pm_rng_source source;
    pm_roulette_rule rule;
    pm_caps caps;
    pm_spectrum sky; // pm_light_sky()
} pm_reference_eye;

/// What paths bring; sums over them.
typedef struct {
    pm_spectrum layer[PM_LAYER_COUNT]; // W/(m^2 sr)
    uint64_t hits;                     // paths that met a surface, null ones aside
    double depth;                      // [m] from the eye to there
    pm_vec3 normal;                    // there, on the eye's side
    bool emitter;                      // one met an emitter directly or after S events alone.
                                       // These three see through media, as if paths did not
                                       // collide on their last way
    uint64_t cut;                      // paths ended by a cap
} pm_reference_sum;

/// Adds one path.
///
/// @param index  places its random numbers: its n-th event draws at bounce n
/// @param hue    in [0, 1): share of the range of wavelengths for the first that it needs
/// @param sum    [in, out]
pm_status pm_reference_path(const pm_reference_eye *eye, const pm_ray *ray, uint64_t index,
                            double hue, pm_reference_sum *sum);

#endif

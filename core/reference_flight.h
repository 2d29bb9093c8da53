// How paths of the reference travel, those from the eye and those from the lights: from surface
// to surface, or to a collision in the medium between.
//
// Invariant: one optical depth is drawn for the way from an event to the next and used up
// through all media on it, so null surfaces between media change nothing. A path collides with
// the chance that light does, and what gets through keeps its weight.
#ifndef PM_REFERENCE_FLIGHT_H
#define PM_REFERENCE_FLIGHT_H

#include "material.h"

typedef enum {
    PM_REFERENCE_OUTSIDE, // the path left the scene
    PM_REFERENCE_SURFACE,
    PM_REFERENCE_MEDIUM,
} pm_reference_place;

/// Where a path comes to.
typedef struct {
    pm_reference_place place;
    pm_vec3 position; // on a surface or in a medium
    pm_hit hit;       // of a surface
    pm_lobes lobes;   // of a surface
} pm_reference_meeting;

/// The optical depth to begin a way with: none is drawn before the path is in a medium.
#define PM_REFERENCE_UNDRAWN (-1.0)

/// To the next surface, a null one too, or to a collision before it.
///
/// @param left  [in, out] optical depth that is left until the path collides
/// @param at    [out]
void pm_reference_fly(const pm_intersector *world, const pm_ray *ray, pm_rng *rng, double *left,
                      pm_reference_meeting *at);

/// The ray that goes straight on from a null surface.
pm_ray pm_reference_beyond(const pm_ray *ray, const pm_reference_meeting *at);

/// The path takes one wavelength where it meets glass that disperses: its weight and the lobes
/// become those of that wavelength.
///
/// @param share   in [0, 1), of the range of wavelengths
/// @param ray     [in, out]
/// @param weight  [in, out]
/// @param at      [in, out]
void pm_reference_colour(const pm_scene *scene, double share, pm_ray *ray, pm_spectrum *weight,
                         pm_reference_meeting *at);

#endif

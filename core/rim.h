// Where a medium ends beside a photon, or beside a place that photons are counted at.
//
// Invariant: what lies beyond the plane found neither gives light to this side nor takes any;
// for the part of a kernel that lies there, the part on this side counts the more. So flat
// walls have no dark rim, nothing shines through them, and media that touch are kept apart.
#ifndef PM_RIM_H
#define PM_RIM_H

#include "intersect.h"

/// A plane beside a place.
typedef struct {
    float normal[3]; // unit, from the place to the plane
    float distance;  // [m], or in another unit; INFINITY: there is none
} pm_rim;

/// No plane.
static const pm_rim pm_rim_none = {{0.0f, 0.0f, 0.0f}, INFINITY};

/// The nearest plane within `radius` [m] of `at`, of the surfaces that part media or let no
/// light pass: as six rays along the axes find them, so walls at any angle are found where they
/// are wider than the ball; of curved ones the tangent plane.
///
/// @param world  NULL: there is none
pm_rim pm_rim_find(const pm_intersector *world, pm_vec3 at, double radius);

/// Whether a place, as seen from the one beside the plane, is on its side.
static inline bool pm_rim_is_before(const pm_rim *rim, pm_vec3 away)
{
    pm_vec3 normal =
        pm_vec((double)rim->normal[0], (double)rim->normal[1], (double)rim->normal[2]);
    return pm_vec_dot(away, normal) <= (double)rim->distance;
}

#endif

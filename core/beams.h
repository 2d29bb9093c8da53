// The beam radiance estimate: one query for all photons near a ray through a medium, in place
// of many along it. Each photon is a ball; the ray sees it as a disc across.
//
// Invariant: photons count whose nearest point of the ray lies between its two ends, and whose
// distance d from it is below their radius r: with the kernel (3 / pi) (1 - d^2/r^2)^2 / r^2,
// whose integral over the disc is 1.
// @source Jarosz, Zwicker and Jensen, "The Beam Radiance Estimate for Volumetric Photon
// Mapping", CGF 27(2), 2008
#ifndef PM_BEAMS_H
#define PM_BEAMS_H

#include "estimate.h"

/// A volume map made ready for rays: boxes over the photons' balls, one a node of its tree.
/// Zero-initialised: none.
typedef struct {
    const pm_photon_map *map; // balanced, scaled; must outlive the beams
    float *radius;            // of each photon [m]
    float (*box)[6];          // low x y z, high x y z of each node and all below it
    uint32_t largest;         // the photon of the largest radius
} pm_beams;

/// Gives each photon of `map` a radius and builds the boxes, on all threads.
///
/// @param radius  [m] > 0 of every photon; INFINITY: each its own, by the distance of its
///                sqrt(k)-th neighbour widened to hold about k
/// @param out     [out] untouched unless PM_OK; free with pm_beams_free()
/// @return PM_EINPUT when the map is not a balanced and scaled volume map, the radius not > 0
///         or k is 0; PM_ENOMEM
pm_status pm_beams_make(const pm_photon_map *map, double radius, uint32_t k, pm_beams *out);
void pm_beams_free(pm_beams *beams);

/// What one query found.
typedef struct {
    pm_spectrum radiance; // [W/(m^2 sr)] arriving at the start of the ray
    uint32_t found;       // photons that counted
    double radius;        // [m] mean of theirs; 0 when there is none
} pm_beam;

/// Radiance that photons in `medium` send back along `along`, between its start and its t_max
/// (INFINITY: no end), attenuated on the way.
///
/// @param skip  photons with one of these flag bits are left out
pm_beam pm_beams_query(const pm_beams *beams, const pm_medium *medium, const pm_ray *along,
                       uint16_t skip);

#endif

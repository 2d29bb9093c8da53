// Irradiance at photon positions: estimated once at every few photons of the global map, so
// that a gather ray looks up one number where it would have searched for k photons.
// @source Christensen, "Faster Photon Map Global Illumination", JGT 4(3), 1999
#ifndef PM_IRRADIANCE_H
#define PM_IRRADIANCE_H

#include "estimate.h"
#include "intersect.h"

#define PM_IRRADIANCE_SPACING 4 // photons of the map for one place

/// Irradiance at every `spacing`-th photon of `global`, on the side that photon came from.
///
/// @param world     that the photons were traced in; asked for the exact normals
/// @param global    balanced and scaled
/// @param settings  of the estimates
/// @param spacing   >= 1
/// @param places    [out] a balanced map with exact values: power is the irradiance [W/m^2],
///                  direction the radius [m] of the estimate, the photons found by it, and
///                  its unevenness (fill.h); untouched unless PM_OK; freed by
///                  pm_photon_map_free()
/// @return PM_EINPUT as pm_estimate_irradiance(); PM_ENOMEM; PM_ESTOPPED on SIGINT
pm_status pm_irradiance_make(const pm_intersector *world, const pm_photon_map *global,
                             const pm_estimate_settings *settings, uint32_t spacing,
                             pm_photon_map *places);

/// The largest radius of any place's estimate [m]; 0 without places.
double pm_irradiance_reach(const pm_photon_map *places);

/// The irradiance of the nearest place on a surface that faces alike, among those whose own
/// disc covers the point.
///
/// @param settings  of the estimates: shape and flatness of their discs
/// @param reach     [m] from pm_irradiance_reach()
/// @param covered   [out] whether there is such a place
/// @param found     [out] its estimate, and its unevenness; untouched unless covered
/// @return PM_EINPUT as pm_balance_nearest()
pm_status pm_irradiance_find(const pm_photon_map *places, const pm_estimate_settings *settings,
                             double reach, const pm_estimate_point *point, bool *covered,
                             pm_estimate *found, double *unevenness);

#endif

// Irradiance at photon positions: estimated once at every few photons of the global map, so
// that a gather ray looks up one number where it would have searched for k photons.
// @source Christensen, "Faster Photon Map Global Illumination", JGT 4(3), 1999
#ifndef PM_IRRADIANCE_H
#define PM_IRRADIANCE_H

#include "estimate.h"

#define PM_IRRADIANCE_SPACING 4 // photons of the map for one place

/// Irradiance at every `spacing`-th photon of `global`, on the side that photon came from.
///
/// @param settings  of the estimates
/// @param places    [out] a balanced map whose exact power is an irradiance [W/m^2]; freed by
///                  pm_photon_map_free()
/// @return PM_EINPUT as pm_estimate_irradiance(); PM_ENOMEM; PM_ESTOPPED on SIGINT
pm_status pm_irradiance_make(const pm_photon_map *global, const pm_estimate_settings *settings,
                             uint32_t spacing, pm_photon_map *places);

/// Irradiance of the nearest place on a surface that faces alike, in the disc that estimates
/// use.
///
/// @param reach  [m] places farther off do not count
/// @return false, and nothing written, when there is none
bool pm_irradiance_find(const pm_photon_map *places, const pm_estimate_point *point,
                        double reach, pm_spectrum *irradiance, double *distance);

#endif

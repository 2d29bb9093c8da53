// One photon map from a program's options: traced, scaled and, if wanted, balanced.
#ifndef PM_MAP_MAKE_H
#define PM_MAP_MAKE_H

#include "options.h"
#include "photon_pass.h"
#include "projection.h"

/// Aims the scene's lights for the map of `kind`, unless the options have --projection off.
///
/// @param out  [out] free with pm_projection_free() when PM_OK
pm_status pm_map_aim(const pm_options *options, const pm_scene *scene, pm_map_kind kind,
                     pm_projections *out);

/// What the options say about a pass for the map of `kind`, but for where photons are sent.
pm_pass_settings pm_map_settings(const pm_options *options, pm_map_kind kind, uint32_t pass);

/// Aims, traces the map of `kind` and balances it. Passes of different numbers are independent.
///
/// @param map  [out] untouched unless PM_OK; free with pm_photon_map_free()
pm_status pm_map_make(const pm_options *options, const pm_intersector *world, pm_map_kind kind,
                      uint32_t pass, pm_photon_map *map);

/// "global", "caustic" or "volume".
const char *pm_map_name(pm_map_kind kind);

#endif

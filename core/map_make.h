// One photon map from a program's options: traced, scaled and, if wanted, balanced.
#ifndef PM_MAP_MAKE_H
#define PM_MAP_MAKE_H

#include "options.h"
#include "photon_pass.h"

/// What the options say about a pass for the map of `kind`.
pm_pass_settings pm_map_settings(const pm_options *options, pm_map_kind kind, uint32_t pass);

/// Traces the map of `kind` and balances it. Passes of different numbers are independent.
///
/// @param map  [out] untouched unless PM_OK; free with pm_photon_map_free()
pm_status pm_map_make(const pm_options *options, const pm_intersector *world, pm_map_kind kind,
                      uint32_t pass, pm_photon_map *map);

/// "global", "caustic" or "volume".
const char *pm_map_name(pm_map_kind kind);

#endif

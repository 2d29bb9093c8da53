// What the photon maps say of a vertex. Each path class is read from one map: which photons a
// lookup skips is decided here and nowhere else.
#ifndef PM_LOOKUP_H
#define PM_LOOKUP_H

#include "gather.h"

/// How `map` is asked: as `settings` say or, with a `reach` [m] > 0, for all its photons within
/// that. As many as it holds at most, so a search never stops at k; its list is written only as
/// far as photons are found.
pm_estimate_settings pm_lookup_settings(const pm_estimate_settings *settings, double reach,
                                        const pm_photon_map *map);

/// The same for a map of `gather`, which must have it.
pm_estimate_settings pm_lookup_asked(const pm_gather *gather, pm_map_kind kind);

/// What the end of a gather ray finds.
typedef struct {
    pm_estimate estimate; // its value is a radiance [W/(m^2 sr)]
    bool uneven;          // its photons do not fill their disc (fill.h)
} pm_lookup;

/// Everything that leaves a vertex by its D lobes, as the end of a gather ray: all photons of
/// the global map, or the irradiance of a place near by where there is one and the vertex is
/// Lambertian.
/// @param end  [out]
pm_status pm_lookup_global(pm_gather *gather, const pm_vertex *at, pm_lookup *end);

/// The global map seen directly: without LD, which shadow rays bring, and LS+D, which the
/// caustic layer has.
pm_status pm_lookup_indirect(pm_gather *gather, const pm_vertex *at, pm_spectrum *radiance);

/// LS+D from the caustic map.
pm_status pm_lookup_caustic(pm_gather *gather, const pm_vertex *at, pm_spectrum *radiance);

/// LS+D from the photons of the global map that are marked so, no farther than `reach` [m].
pm_status pm_lookup_marked(pm_gather *gather, const pm_vertex *at, double reach,
                           pm_spectrum *radiance);

/// Whether the global map has such photons.
bool pm_lookup_has_marked(const pm_gather *gather);

#endif

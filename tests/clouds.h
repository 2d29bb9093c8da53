// Photon maps with positions of every awkward kind, for tests of selecting, balancing and
// searching.
#ifndef PM_CLOUDS_H
#define PM_CLOUDS_H

#include "photon.h"

typedef enum {
    PM_CLOUD_RANDOM, // in the unit cube
    PM_CLOUD_SORTED, // along x; y and z random
    PM_CLOUD_REVERSED,
    PM_CLOUD_ORGAN_PIPE, // x rises to the middle and falls again, y and z constant
    PM_CLOUD_COINCIDENT,
    PM_CLOUD_COLLINEAR, // on the diagonal
    PM_CLOUD_COPLANAR,
    PM_CLOUD_WALLS,   // of the unit cube
    PM_CLOUD_LATTICE, // random points of a 4 x 4 x 4 lattice: many ties
    PM_CLOUD_SITES,   // few places, many photons each
    PM_CLOUD_COUNT,
} pm_cloud_kind;

const char *pm_cloud_name(pm_cloud_kind kind);

/// A map of `count` photons, times `scale`; photon i carries the power i + 1 in red. Free with
/// pm_photon_map_free().
pm_photon_map pm_cloud_make(pm_cloud_kind kind, uint32_t count, double scale, bool unpacked);

/// Position `i` of a random sequence in the unit cube, independent of the clouds.
pm_vec3 pm_cloud_query(uint64_t i);

#endif

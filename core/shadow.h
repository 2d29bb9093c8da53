// Shadow photons: a light's rays carried on through everything they meet leave "lit" on the
// first surface and "shadow" behind it. Where all around a point is lit, or all is shadow, no
// shadow ray needs asking.
// @source Jensen and Christensen, "Efficiently Rendering Shadows using the Photon Map", 1995
#ifndef PM_SHADOW_H
#define PM_SHADOW_H

#include "estimate.h"
#include "intersect.h"

#define PM_SHADOW_K 48 // photons asked about a point

typedef enum {
    PM_SHADOW_UNSURE, // mixed, or too few photons: shoot a ray
    PM_SHADOW_LIT,    // all of this light reaches the point
    PM_SHADOW_DARK,   // none does
} pm_shadow_answer;

/// One map a light, since a point may be lit by one and dark to another. A photon in it has
/// PM_PHOTON_FIRST where it is light, and not where it is shadow. Zero-initialised: none.
typedef struct {
    pm_photon_map *map;
    int light_count;
} pm_shadow_maps;

/// How many are sent, by which random numbers: other passes, others throughout.
typedef struct {
    uint32_t seed;
    uint32_t pass;
    uint64_t count;
} pm_shadow_run;

/// Sends the photons of `run` from the lights, shared equally among those with power, on
/// through everything but null surfaces (glass throws shadow: what it lets through is a
/// caustic). The same for any number of threads.
///
/// @param maps  [out] balanced; free with pm_shadow_free() when PM_OK
/// @return PM_ENOMEM; PM_ELIMIT when a map would be too large; PM_ESTOPPED on SIGINT
pm_status pm_shadow_make(const pm_intersector *world, const pm_shadow_run *run,
                         pm_shadow_maps *maps);
void pm_shadow_free(pm_shadow_maps *maps);

/// What the photons around a point say of light number `light`.
/// @param scratch  room for PM_SHADOW_K
pm_shadow_answer pm_shadow_ask(const pm_shadow_maps *maps, int light,
                               const pm_estimate_point *point, pm_neighbour *scratch);

#endif

// Projection maps: where a light's photons are worth sending, so that none is wasted on the
// dark. Made from bounding spheres alone, before any ray.
//
// Invariant: cells are conservative. No photon sent through a dark cell could meet what the map
// asks for first.
#ifndef PM_PROJECTION_H
#define PM_PROJECTION_H

#include "emit.h"
#include "photon.h"

/// The projection maps of all lights for one photon map. Zero-initialised: none; every light
/// sends everywhere.
typedef struct {
    pm_projection *light; // one a light (rows 0: this one sends everywhere), or NULL
    int light_count;
    uint64_t cells, active; // of all lights that have a projection
    pm_spectrum dark;       // [W] that is never sent
    double sent;            // share of the power of all lights that is sent, in [0, 1]
    uint32_t *storage;
    char why[160]; // one sentence without a full stop: what is aimed at, or why it does not pay
} pm_projections;

/// Aims the lights for the map of `kind`.
///
/// Caustic map: at shapes with an S lobe; what a medium turns on the way there is no caustic.
/// Other maps: point, spot and directional lights at whatever there is, surfaces that only
/// bound a medium too; but a light that stands in a medium sends everywhere, as its photons may
/// collide before they meet any shape. Lights whose directions hang on the place that they
/// start from (spheres, cylinders and meshes that shine) and the constant light send
/// everywhere. Where less than a quarter of all power would be saved, nothing is aimed.
///
/// @param out  [out] free with pm_projection_free() when PM_OK
/// @return PM_ENOMEM
pm_status pm_projection_make(const pm_scene *scene, pm_map_kind kind, pm_projections *out);
void pm_projection_free(pm_projections *projections);

/// What pm_emission and pm_pass_settings take: NULL where nothing is aimed.
static inline const pm_projection *pm_projection_of(const pm_projections *projections)
{
    return projections->light;
}

/// Photons that would have had to be sent besides, without projection maps, to have as many
/// where they count.
uint64_t pm_projection_saved(const pm_projections *projections, uint64_t emitted);

#endif

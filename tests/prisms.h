// Glass that disperses, for scenes made by hand: a slab, a prism, and what Snell says of them.
#ifndef PM_PRISMS_H
#define PM_PRISMS_H

#include "glass.h"
#include "scenes.h"
#include "wavelength.h"

/// A glass whose index is 1.5 at every wavelength.
extern const pm_glass pm_prisms_even;

/// Adds glass that disperses, in air of index 1.
int pm_prisms_glass(pm_scenes *s, const pm_glass *glass);

/// Adds two wide faces across z, at z = 0 and at -thick.
void pm_prisms_slab(pm_scenes *s, double thick, int material);

/// Adds an equilateral prism of side 1: its base lies across z at z = 0, its edges along y, its
/// apex above the origin.
void pm_prisms_prism(pm_scenes *s, int material);

/// Light in the plane y = 0 towards the middle of the prism's left face, at `incidence` [rad]
/// to its normal, from below it.
pm_ray pm_prisms_beam(double incidence);

/// How the beam leaves through the right face, by Snell's law alone.
typedef struct {
    pm_vec3 from;      // on the right face
    pm_vec3 direction; // unit
    double deviation;  // [rad]
    double through;    // share of the power that both faces let pass
} pm_prisms_way;

/// For a prism of this index; ends the test where the light does not go that way.
pm_prisms_way pm_prisms_snell(double incidence, double index);

/// The incidence at which light of this index deviates least: refracted alike at both faces.
double pm_prisms_least(double index);

/// The wavelength [nm] that a photon takes first.
double pm_prisms_wavelength(const pm_rng_source *source, uint64_t photon);

#endif

// One wavelength for a path through glass that disperses, and what it does to the path's three
// channels.
//
// Invariant: over wavelengths drawn evenly from the range, each channel's weight is never
// negative and has mean 1, so that energy is kept channel by channel; the hue of pure colours,
// some of which no screen can show, is approximate.
#ifndef PM_WAVELENGTH_H
#define PM_WAVELENGTH_H

#include "rng.h"
#include "spectrum.h"

#define PM_WAVELENGTH_LEAST 380.0 // [nm]
#define PM_WAVELENGTH_MOST 720.0

/// The wavelength [nm] at a share u in [0, 1) of the range.
static inline double pm_wavelength_at(double u)
{
    return PM_WAVELENGTH_LEAST + u * (PM_WAVELENGTH_MOST - PM_WAVELENGTH_LEAST);
}

/// What the power or radiance of a path is multiplied by when it takes this wavelength: the
/// linear sRGB matching curves without their negative parts, each scaled to mean 1.
pm_spectrum pm_wavelength_weight(double wavelength);

/// The share of the range for a photon's first wavelength: numbers of one pass are spread
/// evenly, whichever photons they belong to. Each by itself is uniform over passes and seeds.
/// @return u in [0, 1)
double pm_wavelength_spread(const pm_rng_source *source, uint64_t photon);

#endif

// Stub: filled in by its owner.
#include "wavelength.h"

pm_spectrum pm_wavelength_weight(double wavelength)
{
    (void)wavelength;
    return pm_gray(1.0);
}

double pm_wavelength_spread(const pm_rng_source *source, uint64_t photon)
{
    pm_rng rng = pm_rng_at(source, UINT64_MAX, 0);
    uint64_t shift = (uint64_t)(pm_rng_draw(&rng) * 0x1p53) << 11;
    uint64_t turns = shift + photon * 0x9E3779B97F4A7C15u; // golden section of 2^64
    return (double)(turns >> 11) * 0x1p-53;
}

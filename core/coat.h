// The dielectric coat of a plastic: how much light gets through it, to the diffuse ground below
// and out again. Light that the coat throws back from within meets the ground again and again;
// summed up, a ground of reflectance rho shows
//     rho through(wi) through(wo) / (pi n^2 (1 - inside))
// where n is the index of the coat and `inside` the share of diffuse light thrown back.
#ifndef PM_COAT_H
#define PM_COAT_H

#include "scene.h"

/// Fills in coat, coat_mean and coat_inside of a plastic.
void pm_coat_prepare(pm_material *material);

/// Share of light from outside at this cosine that gets through the coat, in [0, 1].
double pm_coat_through(const pm_material *material, double cosine);

/// Ratio of light that comes out after the ground to light that got in, for a white ground;
/// at most 1.
double pm_coat_gain(const pm_material *material);

#endif

// Glasses whose index of refraction falls with the wavelength, by Sellmeier's formula.
//
// Invariant: wavelengths are nanometres everywhere but inside glass.c, where the formula's
// coefficients want micrometres.
#ifndef PM_GLASS_H
#define PM_GLASS_H

#define PM_GLASS_D_LINE 587.5618 // [nm] the yellow helium line that catalogues quote n_d at

/// n^2 = 1 + sum of b_i w^2 / (w^2 - c_i), with the wavelength w and the roots of c in um.
///
/// Catalogues give n relative to air. It is taken for a material's int_ior as it stands, and
/// ext_ior is what the scene file says: a file that wants the catalogue's angles to the last
/// digit sets ext_ior to 1.
typedef struct {
    const char *name; // as a scene file spells it
    int terms;
    double b[4];
    double c[4]; // [um^2]
} pm_glass;

/// The glass of that name (bk7, sf10, sf11, n-sf11, fused-silica, diamond, water), or NULL.
const pm_glass *pm_glass_named(const char *name);

/// The name most like it.
const char *pm_glass_nearest(const char *name);

/// Index of refraction at a wavelength [nm].
double pm_glass_index(const pm_glass *glass, double wavelength);

/// Abbe number (n_d - 1) / (n_F - n_C): small for glass that disperses much.
double pm_glass_abbe(const pm_glass *glass);

#endif

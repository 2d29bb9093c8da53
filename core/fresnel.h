// How much light a smooth interface throws back, for unpolarised light. Cosines are those to
// the interface's normal, in [0, 1]; `eta` is the index on the side of the light over the index
// beyond, except for metals, whose index is relative to vacuum.
#ifndef PM_FRESNEL_H
#define PM_FRESNEL_H

/// Reflectance of a dielectric.
/// @param cos_t  [out] cosine of the refracted direction; 0 on total reflection
double pm_fresnel_dielectric(double cos_i, double eta, double *cos_t);

/// Reflectance of a pane: both its faces, and all the light that goes to and fro between them.
double pm_fresnel_pane(double cos_i, double eta);

/// Reflectance of a conductor of index eta + i k seen from vacuum, one channel.
double pm_fresnel_conductor(double cos_i, double eta, double k);

/// Share of diffuse light that gets through a dielectric interface: the mean of 1 - reflectance
/// weighed by the cosine.
double pm_fresnel_diffuse_through(double eta);

#endif

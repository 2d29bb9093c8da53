// Directions in which a diffuse surface looks for light, and what it makes of what it sees
// there: response = f cos / density, so that the mean of response times radiance is what leaves
// the surface.
#ifndef PM_LOOK_H
#define PM_LOOK_H

#include "material.h"

typedef struct {
    pm_vec3 wo;
    pm_spectrum response; // black when the draw went into the surface
} pm_look;

/// Sum of the mean albedos of the D lobes; 0: there is nothing to look for.
double pm_look_albedo(const pm_lobes *lobes);

/// By the cosine, from a point `u` of the unit square. Good for Lambertian surfaces, right for
/// all.
pm_look pm_look_by_cosine(const pm_lobes *lobes, const double u[2]);

/// By a D lobe, itself drawn by its mean albedo; the sum of these must be above 0.
pm_look pm_look_by_lobe(const pm_lobes *lobes, pm_rng *rng);

#endif

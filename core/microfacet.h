// Rough surfaces as many small mirrors: how their normals are spread, how much of them a
// direction sees, and normals drawn as a direction sees them. All in a frame whose z is the
// surface's normal; directions are unit, point away from the surface and have z >= 0.
//
// Smith: facets hide each other independently of their slope. Then all of masking lies in one
// function, the projected area s(w) = integral of D(m) max(0, w.m) over m, and with it
//     masking G1(w)             cos(w) / s(w)
//     density of visible m      D(m) max(0, w.m) / s(w)
//     bsdf of mirrors           F D(h) / (4 s(wi) s(wo))
//     density of wo             D(h) / (4 s(wi))
// None of these divides by a cosine, so they hold at grazing angles.
// @source Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs",
// JCGT 3(2), 2014
#ifndef PM_MICROFACET_H
#define PM_MICROFACET_H

#include "rng.h"
#include "scene.h"

/// The range of alpha in which every function below keeps its digits; what is smoother is a
/// mirror, and 1e-4 is also where Mitsuba stops.
#define PM_ALPHA_LEAST 1e-4
#define PM_ALPHA_MOST 10.0

typedef struct {
    pm_microfacet_kind kind;
    double alpha;
} pm_microfacet;

/// Microfacet area per surface area and solid angle of its normal, D [1/sr].
/// @param cos2, sin2  squares of the facet normal's cosine and sine to z
double pm_microfacet_density(pm_microfacet facets, double cos2, double sin2);

/// Microfacet area per surface area that a direction sees, >= its cosine, > 0.
double pm_microfacet_seen(pm_microfacet facets, double cosine);

/// A normal, distributed as `wi` sees the facets: always on its side.
pm_vec3 pm_microfacet_normal(pm_microfacet facets, pm_vec3 wi, pm_rng *rng);

#endif

// Slopes of both distributions scale with alpha. So normals are drawn for alpha 1, as seen from
// the direction stretched alike, and their slopes are scaled back.
// @source Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), 2018
#include "microfacet.h"

double pm_microfacet_density(pm_microfacet facets, double cos2, double sin2)
{
    double alpha2 = facets.alpha * facets.alpha;
    if (facets.kind == PM_MICROFACET_GGX) {
        double spread = alpha2 * cos2 + sin2;
        return alpha2 / (PM_PI * spread * spread);
    }
    double share = exp(-sin2 / (alpha2 * cos2));
    return share > 0.0 ? share / (PM_PI * alpha2 * cos2 * cos2) : 0.0;
}

double pm_microfacet_seen(pm_microfacet facets, double cosine)
{
    double sin2 = pm_most(0.0, (1.0 - cosine) * (1.0 + cosine)); // a cosine may round past 1
    double across = facets.alpha * sqrt(sin2);
    if (facets.kind == PM_MICROFACET_GGX) {
        return 0.5 * (cosine + sqrt(cosine * cosine + across * across));
    }
    if (across == 0.0) {
        return cosine;
    }
    double a = cosine / across;
    return 0.5 * (cosine * (1.0 + erf(a)) + across * exp(-a * a) / sqrt(PM_PI));
}

/// A slope pair of the Beckmann distribution of alpha 1.
static void draw_gaussian(pm_rng *rng, double slope[2])
{
    double u = pm_rng_draw(rng);
    double phi = 2.0 * PM_PI * pm_rng_draw(rng);
    double radius = sqrt(-log(1.0 - u));
    slope[0] = radius * cos(phi);
    slope[1] = radius * sin(phi);
}

/// A normal for alpha 1, of any length, as seen from (sine, 0, cosine). The density of its
/// slopes x (leaning that way) and y is max(0, cosine + x sine) exp(-x^2 - y^2), which lies
/// below (cosine + max(0, x) sine) exp(-x^2 - y^2): a Gaussian and a Rayleigh distribution
/// together, of which at least 3 in 4 draws are kept.
static pm_vec3 draw_beckmann(double sine, double cosine, pm_rng *rng)
{
    double gaussian = cosine * sqrt(PM_PI);
    double share = gaussian / (gaussian + 0.5 * sine);
    double slope[2] = {0.0, 0.0};
    for (bool kept = false; !kept;) {
        double which = pm_rng_draw(rng);
        draw_gaussian(rng, slope);
        if (which >= share) {
            slope[0] = sqrt(-log(1.0 - pm_rng_draw(rng)));
        }
        double bound = pm_rng_draw(rng) * cosine;
        kept = slope[0] >= 0.0 || bound < cosine + slope[0] * sine;
    }
    return pm_vec(slope[0], slope[1], 1.0);
}

/// The same for GGX: facets of alpha 1 are a hemisphere, and the point of it that is met by a
/// random ray along the direction has the normal wanted.
static pm_vec3 draw_ggx(double sine, double cosine, pm_rng *rng)
{
    double radius = sqrt(pm_rng_draw(rng));
    double phi = 2.0 * PM_PI * pm_rng_draw(rng);
    double y = radius * cos(phi);
    double chord = sqrt((1.0 - y) * (1.0 + y));
    // The disc across the direction shows a half disc and a half ellipse of the hemisphere.
    double up = 0.5 * ((1.0 - cosine) * chord + (1.0 + cosine) * radius * sin(phi));
    double along = sqrt(pm_most(0.0, (1.0 - y) * (1.0 + y) - up * up));
    double z = pm_most(0.0, along * cosine + up * sine);
    return pm_vec(along * sine - up * cosine, y, z);
}

pm_vec3 pm_microfacet_normal(pm_microfacet facets, pm_vec3 wi, pm_rng *rng)
{
    double flat = hypot(wi.x, wi.y);
    double stretched = hypot(facets.alpha * flat, wi.z);
    double sine = facets.alpha * flat / stretched;
    double cosine = wi.z / stretched;
    pm_vec3 seen = facets.kind == PM_MICROFACET_GGX ? draw_ggx(sine, cosine, rng)
                                                    : draw_beckmann(sine, cosine, rng);
    double along = facets.alpha * seen.x;
    double across = facets.alpha * seen.y;
    double x = flat > 0.0 ? wi.x / flat : 1.0;
    double y = flat > 0.0 ? wi.y / flat : 0.0;
    return pm_vec_normalize(pm_vec(along * x - across * y, along * y + across * x, seen.z));
}

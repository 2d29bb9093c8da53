// A smooth coat follows Fresnel; a rough one is summed over its microfacets once, when the
// scene is made, and looked up.
#include "coat.h"

#include "fresnel.h"
#include "microfacet.h"
#include "quadrature.h"

enum { RINGS = 24, SPOKES = 16, COSINES = 64 };

/// Where integrands are taken, worked out once.
typedef struct {
    double ring[RINGS], ring_share[RINGS];
    double spoke[SPOKES], spoke_share[SPOKES];
} nodes;

/// A rough interface as light at one cosine meets it.
typedef struct {
    const nodes *nodes;
    pm_microfacet facets;
    double eta; // index on this side over the index beyond
    double sine, cosine;
} interface;

/// Of the light that meets facets, what goes on to be seen on either side.
typedef struct {
    double met, reflected, through;
} shares;

static double square(double x)
{
    return x * x;
}

/// The share of G1 that leaves at this cosine; 0 when it points to the wrong side.
static double unmasked(pm_microfacet facets, double cosine)
{
    return cosine > 0.0 ? cosine / pm_microfacet_seen(facets, cosine) : 0.0;
}

/// Adds what facets with these slopes do; x leans towards the light.
static void add_facet(const interface *at, double slope_x, double slope_y, double weight,
                      shares *sum)
{
    double length = sqrt(1.0 + square(slope_x) + square(slope_y));
    double seen = at->cosine + slope_x * at->sine;
    double upright = 1.0 / length;
    double cos_i = pm_least(1.0, seen * upright);
    double cos_t;
    double fresnel = pm_fresnel_dielectric(cos_i, at->eta, &cos_t);
    double mirrored = 2.0 * cos_i * upright - at->cosine;
    double refracted = at->eta * at->cosine + (cos_t - at->eta * cos_i) * upright;
    sum->met += weight * seen;
    sum->reflected += weight * seen * fresnel * unmasked(at->facets, mirrored);
    sum->through += weight * seen * (1.0 - fresnel) * unmasked(at->facets, refracted);
}

/// Half a ring of facets of one steepness, as far as they face the light.
static void add_ring(const interface *at, double steep, double weight, shares *sum)
{
    double rim = -at->cosine / (at->sine * steep);
    double reach = rim > -1.0 ? acos(rim) : PM_PI;
    for (int i = 0; i < SPOKES; i++) {
        double phi = reach * at->nodes->spoke[i];
        double part = weight * reach * at->nodes->spoke_share[i];
        add_facet(at, steep * cos(phi), steep * sin(phi), part, sum);
    }
}

/// Facets whose slope over alpha lies between tan(from) and tan(to).
static void add_rings(const interface *at, double from, double to, shares *sum)
{
    for (int i = 0; i < RINGS; i++) {
        double angle = from + (to - from) * at->nodes->ring[i];
        double slope = tan(angle);
        double cos2 = square(cos(angle));
        double density = at->facets.kind == PM_MICROFACET_GGX
                             ? cos2 * slope
                             : exp(-square(slope)) * slope / cos2;
        add_ring(at, at->facets.alpha * slope, (to - from) * at->nodes->ring_share[i] * density,
                 sum);
    }
}

/// Means over the facets that light at `cosine` sees.
static shares facet_means(interface at, double cosine)
{
    at.cosine = cosine;
    at.sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    pm_microfacet facets = at.facets;
    // Beckmann's facets that are steeper than this do not count: exp(-36) = 2e-16.
    double end = facets.kind == PM_MICROFACET_GGX ? 0.5 * PM_PI : atan(6.0);
    // From here on some facets of a ring are turned away from the light.
    double turn = pm_least(end, atan2(cosine, facets.alpha * at.sine));
    shares sum = {0.0, 0.0, 0.0};
    add_rings(&at, 0.0, turn, &sum);
    if (turn < end) {
        add_rings(&at, turn, end, &sum);
    }
    return (shares){1.0, sum.reflected / sum.met, sum.through / sum.met};
}

/// 2 * integral of through(c) c over c, exactly, for the straight pieces of the table.
static double mean_of_table(const double *table)
{
    double step = 1.0 / (PM_COSINE_TABLE - 1);
    double sum = 0.0;
    for (int i = 0; i + 1 < PM_COSINE_TABLE; i++) {
        double low = i * step;
        double high = low + step;
        sum += step / 3.0 * (table[i] * (2.0 * low + high) + table[i + 1] * (low + 2.0 * high));
    }
    return sum;
}

/// Mitsuba's mean over evenly spaced cosines, both ends counted in full: 1 to 2 % below the
/// integral. Kept, because a scene file means what Mitsuba shows.
static double thrown_back(interface inside)
{
    double sum = 0.0;
    for (int i = 0; i < COSINES; i++) {
        double cosine = (double)i / (COSINES - 1);
        sum += 2.0 * cosine * facet_means(inside, cosine).reflected;
    }
    return sum / COSINES;
}

static void prepare_rough(pm_material *material)
{
    nodes places;
    pm_quadrature_nodes(RINGS, places.ring, places.ring_share);
    pm_quadrature_nodes(SPOKES, places.spoke, places.spoke_share);
    double n = material->int_ior / material->ext_ior;
    interface outside = {
        .nodes = &places,
        .facets = {material->microfacet, material->alpha},
        .eta = 1.0 / n,
    };
    interface inside = outside;
    inside.eta = n;
    for (int i = 0; i < PM_COSINE_TABLE; i++) {
        double cosine = (double)i / (PM_COSINE_TABLE - 1);
        // A coat of the index around it is not there, however rough; at nearly that index
        // rounding could let through more than comes.
        double through = n == 1.0 ? 1.0 : facet_means(outside, cosine).through;
        material->coat[i] = pm_least(1.0, through);
    }
    material->coat_mean = mean_of_table(material->coat);
    // What gets in on average gets out alike, over n^2. The rest, less what masking loses, is
    // thrown back; by quadrature alone it could be more, and the plastic would shine by itself.
    double most = 1.0 - material->coat_mean / square(n);
    material->coat_inside = n == 1.0 ? 0.0 : pm_least(thrown_back(inside), most);
}

void pm_coat_prepare(pm_material *material)
{
    if (material->type == PM_BSDF_ROUGH_PLASTIC) {
        prepare_rough(material);
        return;
    }
    double n = material->int_ior / material->ext_ior;
    material->coat_mean = pm_fresnel_diffuse_through(1.0 / n);
    material->coat_inside = 1.0 - material->coat_mean / square(n);
}

double pm_coat_through(const pm_material *material, double cosine)
{
    if (material->type == PM_BSDF_PLASTIC) {
        double eta = material->ext_ior / material->int_ior;
        double cos_t;
        return 1.0 - pm_fresnel_dielectric(cosine, eta, &cos_t);
    }
    double place = pm_least(cosine, 1.0) * (PM_COSINE_TABLE - 1);
    int i = place < PM_COSINE_TABLE - 2 ? (int)place : PM_COSINE_TABLE - 2;
    double part = place - i;
    return (1.0 - part) * material->coat[i] + part * material->coat[i + 1];
}

double pm_coat_gain(const pm_material *material)
{
    double n = material->int_ior / material->ext_ior;
    double out = material->coat_mean / square(n);
    double kept = 1.0 - material->coat_inside; // not below `out`, but for rounding at a high n
    return kept > out ? out / kept : 1.0;
}

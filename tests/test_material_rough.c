// Rough metals and plastics: what is sampled, its density, its value and its albedo agree.
#include "chance.h"
#include "material.h"
#include "microfacet.h"
#include "scenes.h"
#include "test.h"

static const pm_rng_source source = {.seed = 8, .stream = PM_STREAM_TEST};
static const double alphas[4] = {0.01, 0.1, 0.3, 1.0};
static const double cosines[4] = {0.999, 0.6, 0.1, 1e-3};

enum { CELLS = 8, FINE = 10, DRAWS = 4000, LOST = CELLS * CELLS };

static pm_microfacet facets_of(const pm_lobes *lobes)
{
    return (pm_microfacet){lobes->material->microfacet, lobes->material->alpha};
}

// --- one glossy lobe, cell by cell of half-way vectors

/// The half-way vector at an angle from the plane of wi, where a share rest^2 of the surface
/// has steeper facets.
static pm_vec3 facet_at(const pm_lobes *lobes, double rest, double phi)
{
    pm_microfacet facets = facets_of(lobes);
    double slope = facets.alpha * (facets.kind == PM_MICROFACET_GGX
                                       ? sqrt((1.0 - rest) * (1.0 + rest)) / rest
                                       : sqrt(-2.0 * log(rest)));
    double x = slope * cos(phi);
    double y = slope * sin(phi);
    return pm_vec_normalize(pm_vec(0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y, 1.0));
}

static int cell_of(const pm_lobes *lobes, pm_vec3 wo)
{
    pm_microfacet facets = facets_of(lobes);
    pm_vec3 h = pm_vec_normalize(pm_vec_add(lobes->wi, wo));
    double slope2 = (h.x * h.x + h.y * h.y) / (h.z * h.z * facets.alpha * facets.alpha);
    double rest =
        facets.kind == PM_MICROFACET_GGX ? 1.0 / sqrt(1.0 + slope2) : exp(-0.5 * slope2);
    double turn = fabs(atan2(0.6 * h.y - 0.8 * h.x, 0.6 * h.x + 0.8 * h.y)) / PM_PI;
    int row = (int)fmin(rest * CELLS, CELLS - 1);
    return row * CELLS + (int)fmin(turn * CELLS, CELLS - 1);
}

/// Integrals over all wo above the surface.
typedef struct {
    double cell[CELLS * CELLS + 1]; // of the density; the last one: of what is lost below
    double albedo;                  // of value * cosine, first channel
    double square;                  // of (value * cosine)^2 / density
} integrals;

/// Adds the direction that the facet mirrors, if there is one; `share` is that of the surface
/// whose facets face this way.
static void add_direction(const pm_lobes *lobes, int which, pm_vec3 facet, double share,
                          double *cell, integrals *sum)
{
    double cos_i = pm_vec_dot(lobes->wi, facet);
    pm_vec3 wo = pm_vec_reflect(lobes->wi, facet);
    if (cos_i <= 0.0 || wo.z <= 0.0) {
        return;
    }
    double c2 = facet.z * facet.z;
    double density = pm_microfacet_density(facets_of(lobes), c2, 1.0 - c2);
    double solid_angle = share * 4.0 * cos_i / (density * facet.z); // of wo
    double pdf = pm_material_pdf(lobes, which, wo);
    double value = pm_material_value(lobes, which, wo).c[0] * wo.z;
    *cell += pdf * solid_angle;
    sum->albedo += value * solid_angle;
    sum->square += value * value / pdf * solid_angle;
}

static integrals integrate(const pm_lobes *lobes, int which)
{
    enum { STEPS = CELLS * FINE };
    integrals sum = {.cell = {0.0}};
    for (int i = 0; i < STEPS; i++) {
        double rest = (i + 0.5) / STEPS;
        double share = 2.0 * rest / (STEPS * STEPS);
        for (int j = 0; j < STEPS; j++) {
            pm_vec3 facet = facet_at(lobes, rest, PM_PI * (j + 0.5) / STEPS);
            double *cell = &sum.cell[i / FINE * CELLS + j / FINE];
            add_direction(lobes, which, facet, share, cell, &sum);
        }
    }
    sum.cell[LOST] = 1.0;
    for (int i = 0; i < LOST; i++) {
        sum.cell[LOST] -= sum.cell[i];
    }
    return sum;
}

/// Cells that expect too few draws for chi-square go into the fullest one.
static void join_small(const double *share, double *expected, int *into)
{
    int most = 0;
    for (int i = 0; i <= LOST; i++) {
        most = share[i] > share[most] ? i : most;
    }
    expected[most] = DRAWS;
    for (int i = 0; i <= LOST; i++) {
        into[i] = share[i] * DRAWS > 20.0 ? i : most;
        if (i != most) {
            expected[i] = into[i] == i ? share[i] * DRAWS : 0.0;
            expected[most] -= expected[i];
        }
    }
}

static void check_draw(const pm_lobes *lobes, int which, const pm_scatter *turn)
{
    double pdf = pm_material_pdf(lobes, which, turn->wo);
    pm_spectrum value = pm_material_value(lobes, which, turn->wo);
    CHECK_NEAR(pm_vec_length(turn->wo), 1.0, 1e-14);
    CHECK_NEAR(turn->pdf, pdf, 0.0);
    for (int c = 0; c < 3; c++) {
        double carried = lobes->lobe[which].albedo.c[c] * turn->weight.c[c];
        CHECK_NEAR(carried, value.c[c] * turn->wo.z / pdf, 1e-7 * carried);
    }
}

static void check_glossy(const pm_lobes *lobes)
{
    int which = (int)(pm_scenes_lobe(lobes, PM_LOBE_GLOSSY) - lobes->lobe);
    integrals want = integrate(lobes, which);
    double expected[CELLS * CELLS + 1];
    uint64_t counts[CELLS * CELLS + 1] = {0};
    int into[CELLS * CELLS + 1];
    join_small(want.cell, expected, into);
    double sum = 0.0;
    for (uint64_t i = 0; i < DRAWS; i++) {
        pm_rng rng = pm_rng_at(&source, i, 1);
        pm_scatter turn;
        pm_material_sample(lobes, which, &rng, &turn);
        CHECK(turn.wo.z > 0.0);
        bool lost = pm_spectrum_is_black(turn.weight);
        counts[into[lost ? LOST : cell_of(lobes, turn.wo)]]++;
        sum += lobes->lobe[which].albedo.c[0] * turn.weight.c[0];
        if (!lost) {
            check_draw(lobes, which, &turn);
        }
    }
    CHECK_FIT(counts, expected, CELLS * CELLS + 1);
    double variance = pm_most(0.0, want.square - want.albedo * want.albedo);
    CHECK_NEAR(sum / DRAWS, want.albedo, pm_chance_bound(variance, DRAWS) + 2e-3 * want.albedo);
    CHECK(want.albedo <= 1.0 + 1e-3);
}

static void check_at_angles(int alpha, const pm_scenes *s)
{
    for (int c = 0; c < 4; c++) {
        pm_lobes lobes = pm_scenes_lobes(s, pm_scenes_slant(cosines[c]));
        const pm_lobe *lobe = pm_scenes_lobe(&lobes, PM_LOBE_GLOSSY);
        CHECK(lobe != NULL && lobe->specular == (alphas[alpha] <= 0.1));
        check_glossy(&lobes);
    }
}

static void mirrors_sample_their_pdf(void)
{
    for (int a = 0; a < 4; a++) {
        for (int kind = 0; kind < 2; kind++) {
            pm_scenes s;
            pm_scenes_begin(&s);
            int rough = pm_scenes_rough_mirror(&s, (pm_microfacet_kind)kind, alphas[a]);
            pm_scenes_sheet(&s, rough, rough);
            check_at_angles(a, &s);
            pm_scenes_free(&s);
        }
    }
}

static void coats_and_metals_sample_their_pdf(void)
{
    for (int a = 0; a < 4; a++) {
        pm_scenes s;
        pm_scenes_begin(&s);
        int metal =
            pm_scenes_rough_metal(&s, pm_rgb(0.2, 0.9, 1.1), pm_rgb(3.9, 2.4, 2.2), alphas[a]);
        pm_scenes_sheet(&s, metal, metal);
        check_at_angles(a, &s);
        pm_scenes_free(&s);
        pm_scenes_begin(&s);
        int plastic = pm_scenes_rough_plastic(&s, pm_rgb(0.8, 0.5, 0.0), 1.5,
                                              PM_MICROFACET_BECKMANN, alphas[a]);
        pm_scenes_sheet(&s, plastic, plastic);
        check_at_angles(a, &s);
        pm_scenes_free(&s);
    }
}

PM_TESTS({"material.20", "rough mirrors sample their density, and f cos / pdf is what they say",
          mirrors_sample_their_pdf},
         {"material.21", "so do rough metals and rough coats",
          coats_and_metals_sample_their_pdf})

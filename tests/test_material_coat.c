// Plastics: the ground under a coat, smooth or rough, and the power both together carry on.
#include "chance.h"
#include "coat.h"
#include "fresnel.h"
#include "material.h"
#include "microfacet.h"
#include "scenes.h"
#include "test.h"

static const pm_rng_source source = {.seed = 9, .stream = PM_STREAM_TEST};
static const pm_spectrum ground = {{0.9, 0.4, 0.0}};

enum { PLASTICS = 6 };

/// A sheet of plastic: smooth, rough, of high index, thinner than the air around it.
static void begin(pm_scenes *s, int which)
{
    static const double index[PLASTICS] = {1.5, 1.5, 1.5, 2.4, 0.8, 1.01};
    static const double alpha[PLASTICS] = {0.0, 0.05, 0.4, 1.0, 0.3, 0.0};
    pm_scenes_begin(s);
    int plastic = alpha[which] == 0.0
                      ? pm_scenes_plastic(s, ground, index[which])
                      : pm_scenes_rough_plastic(s, ground, index[which],
                                                (pm_microfacet_kind)(which % 2), alpha[which]);
    pm_scenes_sheet(s, plastic, plastic);
}

static int coated_of(const pm_lobes *lobes)
{
    const pm_lobe *lobe = pm_scenes_lobe(lobes, PM_LOBE_COATED);
    CHECK(lobe != NULL && !lobe->specular && lobes->diffuse);
    return (int)(lobe - lobes->lobe);
}

static void smooth_by_hand(void)
{
    // 1 - F on both ways, over pi n^2 (1 - inside); n^2 (1 - inside) is what gets in on
    // average.
    pm_scenes s;
    begin(&s, 0);
    double in_mean = pm_fresnel_diffuse_through(1.0 / 1.5);
    for (int j = 1; j <= 100; j++) {
        pm_vec3 wi = pm_scenes_slant(0.01 * j);
        pm_lobes lobes = pm_scenes_lobes(&s, wi);
        double cos_t;
        double fresnel = pm_fresnel_dielectric(wi.z, 1.0 / 1.5, &cos_t);
        CHECK_NEAR(pm_scenes_reflected(&lobes), fresnel, 1e-15);
        CHECK(pm_scenes_lobe(&lobes, PM_LOBE_REFLECT)->specular);
        CHECK_NEAR(lobes.lobe[coated_of(&lobes)].albedo.c[0], 0.9 * (1.0 - fresnel), 1e-14);
        double out = 1.0 - pm_fresnel_dielectric(0.5, 1.0 / 1.5, &cos_t);
        pm_spectrum f = pm_material_evaluate(&lobes, pm_scenes_slant(0.5));
        double want = 0.9 / PM_PI * (1.0 - fresnel) * out / in_mean;
        CHECK_NEAR(f.c[0], want, 1e-14);
        CHECK_NEAR(f.c[1], want * 4.0 / 9.0, 1e-14);
        CHECK_NEAR(f.c[2], 0.0, 0.0);
        CHECK_NEAR(pm_material_evaluate(&lobes, pm_scenes_slant(-0.5)).c[0], 0.0, 0.0);
    }
    pm_scenes_free(&s);
}

/// Integrals of value * cosine and of its square over the density, for white light: values of
/// the ground hang on the cosine only.
static void sum_ground(const pm_lobes *lobes, int which, double *albedo, double *square)
{
    enum { STEPS = 2000 };
    *albedo = 0.0;
    *square = 0.0;
    for (int i = 0; i < STEPS; i++) {
        double cosine = (i + 0.5) / STEPS;
        double f = pm_material_value(lobes, which, pm_scenes_slant(cosine)).c[0];
        *albedo += 2.0 * PM_PI / STEPS * cosine * f;
        *square += 2.0 * PM_PI / STEPS * cosine * f * f * PM_PI;
    }
}

static void check_ground(const pm_lobes *lobes)
{
    enum { DRAWS = 2000 };
    int which = coated_of(lobes);
    double given = lobes->lobe[which].albedo.c[0];
    double albedo;
    double square;
    sum_ground(lobes, which, &albedo, &square);
    CHECK_NEAR(albedo, given, 2e-6);
    double sum = 0.0;
    for (uint64_t k = 0; k < DRAWS; k++) {
        pm_rng rng = pm_rng_at(&source, k, 1);
        pm_scatter turn;
        pm_material_sample(lobes, which, &rng, &turn);
        CHECK_NEAR(turn.pdf, turn.wo.z / PM_PI, 1e-15);
        double f = pm_material_value(lobes, which, turn.wo).c[0];
        CHECK_NEAR(f * PM_PI, given * turn.weight.c[0], 1e-14);
        sum += given * turn.weight.c[0];
    }
    double variance = pm_most(0.0, square - albedo * albedo);
    CHECK_NEAR(sum / DRAWS, albedo, pm_chance_bound(variance, DRAWS) + 2e-6);
}

static void ground_keeps_its_albedo(void)
{
    for (int i = 0; i < PLASTICS; i++) {
        pm_scenes s;
        begin(&s, i);
        for (int j = 0; j <= 10; j += 2) {
            pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(0.1 * j));
            check_ground(&lobes);
        }
        pm_scenes_free(&s);
    }
}

static void nothing_shines_by_itself(void)
{
    for (int i = 0; i < PLASTICS; i++) {
        pm_scenes s;
        begin(&s, i);
        s.materials[0].reflectance = pm_gray(1.0);
        for (int j = 0; j <= 200; j++) {
            pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(j / 200.0));
            double sum = 0.0;
            for (int k = 0; k < lobes.count; k++) {
                sum += pm_spectrum_max(lobes.lobe[k].albedo);
            }
            CHECK(sum <= 1.0 + 1e-14);
            // A smooth coat over white loses nothing.
            CHECK(s.materials[0].type != PM_BSDF_PLASTIC || sum >= 1.0 - 1e-14);
        }
        pm_scenes_free(&s);
    }
}

static void no_coat_is_lambert(void)
{
    for (int rough = 0; rough < 2; rough++) {
        pm_scenes s;
        pm_scenes_begin(&s);
        int plastic = rough ? pm_scenes_rough_plastic(&s, ground, 1.0, PM_MICROFACET_GGX, 0.5)
                            : pm_scenes_plastic(&s, ground, 1.0);
        pm_scenes_sheet(&s, plastic, plastic);
        for (int j = 0; j <= 100; j++) {
            pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(0.01 * j));
            CHECK_NEAR(lobes.lobe[coated_of(&lobes)].albedo.c[0], 0.9, 1e-13);
            for (int k = 1; k <= 100; k++) {
                pm_spectrum f = pm_material_evaluate(&lobes, pm_scenes_slant(0.01 * k));
                CHECK_NEAR(f.c[0], 0.9 / PM_PI, 1e-13);
                CHECK_NEAR(f.c[1], 0.4 / PM_PI, 1e-13);
            }
        }
        pm_scenes_free(&s);
    }
}

/// However high the index: nothing divides by what no digit holds.
static void gain_is_a_share(void)
{
    for (int i = 0; i < 2; i++) {
        for (int power = -200; power <= 200; power++) {
            pm_material material = {
                .type = i == 0 ? PM_BSDF_PLASTIC : PM_BSDF_ROUGH_PLASTIC,
                .int_ior = pow(10.0, 0.5 * power),
                .ext_ior = 1.0,
                .microfacet = PM_MICROFACET_GGX,
                .alpha = 0.3,
            };
            pm_material_prepare(&material);
            double gain = pm_coat_gain(&material);
            CHECK_THAT(gain >= 0.0 && gain <= 1.0, "index %g: gain %g", material.int_ior, gain);
        }
    }
}

static void rough_tends_to_smooth(void)
{
    for (int kind = 0; kind < 2; kind++) {
        pm_material rough = {.type = PM_BSDF_ROUGH_PLASTIC,
                             .int_ior = 1.5,
                             .ext_ior = 1.0,
                             .microfacet = (pm_microfacet_kind)kind,
                             .alpha = PM_ALPHA_LEAST};
        pm_material_prepare(&rough);
        for (int j = 10; j <= 100; j++) {
            double cos_t;
            double fresnel = pm_fresnel_dielectric(0.01 * j, 1.0 / 1.5, &cos_t);
            CHECK_NEAR(pm_coat_through(&rough, 0.01 * j), 1.0 - fresnel, 1e-3);
        }
        CHECK_NEAR(rough.coat_mean, pm_fresnel_diffuse_through(1.0 / 1.5), 2e-3);
    }
}

static void rough_tables_by_drawing(void)
{
    enum { DRAWS = 20000 };
    pm_microfacet facets = {PM_MICROFACET_GGX, 0.5};
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_rough_plastic(&s, ground, 1.5, facets.kind, facets.alpha);
    for (int j = 0; j < PM_COSINE_TABLE; j += 16) {
        double cosine = (double)j / (PM_COSINE_TABLE - 1);
        pm_vec3 wi = pm_vec(sqrt(1.0 - cosine * cosine), 0.0, cosine);
        double sum = 0.0;
        double sum2 = 0.0;
        for (uint64_t i = 0; i < DRAWS; i++) {
            pm_rng rng = pm_rng_at(&source, i, 3);
            pm_vec3 m = pm_microfacet_normal(facets, wi, &rng);
            double cos_i = pm_vec_dot(wi, m);
            double cos_t;
            double through = 1.0 - pm_fresnel_dielectric(cos_i, 1.0 / 1.5, &cos_t);
            double down = (cos_t - cos_i / 1.5) * m.z + cosine / 1.5;
            through *= down > 0.0 ? down / pm_microfacet_seen(facets, down) : 0.0;
            sum += through;
            sum2 += through * through;
        }
        double mean = sum / DRAWS;
        CHECK_NEAR(s.materials[0].coat[j], mean,
                   pm_chance_bound(sum2 / DRAWS - mean * mean, DRAWS) + 1e-5);
    }
    pm_scenes_free(&s);
}

PM_TESTS({"material.30", "smooth plastic is Fresnel over a ground, as worked out by hand",
          smooth_by_hand},
         {"material.31", "the ground's values, draws and albedo agree, under any coat",
          ground_keeps_its_albedo},
         {"material.32", "coat and white ground together carry on no more than arrives",
          nothing_shines_by_itself},
         {"material.33", "a coat of index 1 is not there, rough or smooth", no_coat_is_lambert},
         {"material.34", "the smoothest rough coat lets through what a smooth one does",
          rough_tends_to_smooth},
         {"material.35", "what a rough coat lets through is the mean over drawn facets",
          rough_tables_by_drawing},
         {"material.39", "a plastic's gain is a share at any index", gain_is_a_share})

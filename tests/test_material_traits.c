// Rules that hold for every material: reciprocity, no NaN, S and D, what is told of them.
#include "caps.h"
#include "material.h"
#include "microfacet.h"
#include "scenes.h"
#include "test.h"

static const pm_rng_source source = {.seed = 10, .stream = PM_STREAM_TEST};

/// Every material that has values, of this roughness.
static void begin(pm_scenes *s, double alpha)
{
    pm_scenes_begin(s);
    pm_scenes_diffuse(s, pm_rgb(0.8, 0.5, 0.1));
    pm_scenes_plastic(s, pm_rgb(0.8, 0.5, 0.1), 1.5);
    pm_scenes_rough_mirror(s, PM_MICROFACET_BECKMANN, alpha);
    pm_scenes_rough_mirror(s, PM_MICROFACET_GGX, alpha);
    pm_scenes_rough_metal(s, pm_rgb(0.2, 0.9, 1.1), pm_rgb(3.9, 2.4, 2.2), alpha);
    pm_scenes_rough_plastic(s, pm_rgb(0.8, 0.5, 0.0), 1.5, PM_MICROFACET_BECKMANN, alpha);
    pm_scenes_rough_plastic(s, pm_gray(1.0), 0.7, PM_MICROFACET_GGX, alpha);
    pm_scenes_rough_plastic(s, pm_gray(1.0), 1.0, PM_MICROFACET_GGX, alpha);
    pm_scenes_sheet(s, 0, PM_NONE);
}

static pm_vec3 any_direction(pm_rng *rng)
{
    double cosine = pm_rng_draw(rng);
    double phi = 2.0 * PM_PI * pm_rng_draw(rng);
    double sine = sqrt(1.0 - cosine * cosine);
    return pm_vec(sine * cos(phi), sine * sin(phi), cosine);
}

static void values_are_reciprocal(void)
{
    static const double alphas[3] = {1e-3, 0.1, 1.0};
    for (int a = 0; a < 3; a++) {
        pm_scenes s;
        begin(&s, alphas[a]);
        for (uint64_t i = 0; i < 4000; i++) {
            pm_rng rng = pm_rng_at(&source, i, 1);
            s.shapes[0].material[0] = (int)(i % (uint64_t)s.scene.material_count);
            pm_vec3 wi = any_direction(&rng);
            pm_vec3 wo = any_direction(&rng);
            pm_lobes there = pm_scenes_lobes(&s, wi);
            pm_lobes back = pm_scenes_lobes(&s, wo);
            CHECK(there.count == back.count);
            for (int k = 0; k < there.count; k++) {
                pm_spectrum f = pm_material_value(&there, k, wo);
                pm_spectrum g = pm_material_value(&back, k, wi);
                for (int c = 0; c < 3; c++) {
                    CHECK(f.c[c] >= 0.0);
                    CHECK_NEAR(f.c[c], g.c[c], 1e-12 * f.c[c]);
                }
            }
        }
        pm_scenes_free(&s);
    }
}

static void check_extreme(const pm_lobes *lobes, int which)
{
    for (uint64_t i = 0; i < 50; i++) {
        pm_rng rng = pm_rng_at(&source, i, 2);
        pm_scatter turn;
        pm_material_sample(lobes, which, &rng, &turn);
        CHECK_NEAR(pm_vec_length(turn.wo), 1.0, 1e-14);
        CHECK(pm_vec_dot(turn.wo, lobes->normal) >= 0.0);
        CHECK(pm_spectrum_is_finite(turn.weight) && isfinite(turn.pdf) && turn.pdf >= 0.0);
        CHECK(turn.weight.c[0] >= 0.0 && turn.weight.c[1] >= 0.0);
        pm_vec3 wo = i % 2 ? turn.wo : any_direction(&rng);
        CHECK(pm_spectrum_is_finite(pm_material_value(lobes, which, wo)));
        CHECK(isfinite(pm_material_pdf(lobes, which, wo)));
    }
}

static void extremes(void)
{
    static const double alphas[4] = {PM_ALPHA_LEAST, 0.1, 1.0, PM_ALPHA_MOST};
    static const double cosines[7] = {1.0, 1.0 - 1e-16, 0.5, 1e-3, 1e-9, 1e-200, 0.0};
    for (int a = 0; a < 4; a++) {
        pm_scenes s;
        begin(&s, alphas[a]);
        for (int i = 0; i < 7 * s.scene.material_count; i++) {
            s.shapes[0].material[0] = i / 7;
            pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(cosines[i % 7]));
            double sum = 0.0;
            for (int k = 0; k < lobes.count; k++) {
                CHECK(pm_spectrum_is_finite(lobes.lobe[k].albedo));
                sum += pm_spectrum_max(lobes.lobe[k].albedo);
                check_extreme(&lobes, k);
            }
            CHECK(sum <= 1.0 + 1e-14);
        }
        pm_scenes_free(&s);
    }
}

static void check_narrow(pm_scenes *s, int which, bool narrow)
{
    s->shapes[0].material[0] = which;
    pm_lobes lobes = pm_scenes_lobes(s, pm_scenes_slant(0.5));
    CHECK(pm_scenes_lobe(&lobes, PM_LOBE_GLOSSY)->specular == narrow);
    pm_material_traits traits = pm_material_traits_of(&s->materials[which]);
    CHECK(traits.specular == narrow && !traits.delta);
    CHECK(traits.diffuse == lobes.diffuse);
    CHECK(!pm_material_is_lambertian(&lobes) || !lobes.diffuse);
    // Only D lobes are evaluated.
    bool shines = !pm_spectrum_is_black(
        pm_material_evaluate(&lobes, pm_vec_reflect(lobes.wi, lobes.normal)));
    CHECK(shines == traits.reflecting && shines == traits.diffuse);
}

static void narrow_is_specular(void)
{
    static const double alphas[2] = {0.1, 0.1000001};
    for (int i = 0; i < 2; i++) {
        pm_scenes s;
        begin(&s, alphas[i]);
        for (int which = 2; which < s.scene.material_count - 1; which++) {
            check_narrow(&s, which, i == 0);
        }
        pm_scenes_free(&s);
    }
}

/// What a rough mirror reflects of light from all around, by drawing.
static double reflected(pm_microfacet_kind kind, double alpha, double cosine)
{
    enum { DRAWS = 2000 };
    pm_scenes s;
    pm_scenes_begin(&s);
    int mirror = pm_scenes_rough_mirror(&s, kind, alpha);
    pm_scenes_sheet(&s, mirror, mirror);
    pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(cosine));
    double sum = 0.0;
    for (uint64_t i = 0; i < DRAWS; i++) {
        pm_rng rng = pm_rng_at(&source, i, 3);
        pm_scatter turn;
        pm_material_sample(&lobes, 0, &rng, &turn);
        sum += turn.weight.c[0];
    }
    pm_scenes_free(&s);
    return sum / DRAWS;
}

static void white_furnace(void)
{
    for (int k = 0; k < 2; k++) {
        pm_microfacet_kind kind = (pm_microfacet_kind)k;
        CHECK_NEAR(reflected(kind, PM_ALPHA_LEAST, 0.5), 1.0, 1e-6);
        CHECK_NEAR(reflected(kind, PM_ALPHA_LEAST, 1.0), 1.0, 1e-6);
        CHECK_NEAR(reflected(kind, 0.01, 0.5), 1.0, 1e-3);
        // Rough ones lose what their facets throw at each other, but never gain.
        double rough = reflected(kind, 1.0, 0.5);
        CHECK_THAT(rough < 0.9 && rough > 0.3, "%g", rough);
    }
}

static void check_traits(const pm_material *material, bool diffuse, bool reflecting,
                         bool specular, bool delta)
{
    pm_material_traits t = pm_material_traits_of(material);
    CHECK_THAT(t.diffuse == diffuse && t.reflecting == reflecting && t.specular == specular &&
                   t.delta == delta,
               "%s %g: %d %d %d %d", material->id, material->alpha, t.diffuse, t.reflecting,
               t.specular, t.delta);
}

static void traits(void)
{
    pm_scenes s;
    begin(&s, 0.2);
    pm_material *m = s.materials;
    check_traits(&m[0], true, true, false, false);
    check_traits(&m[1], true, true, true, true);
    check_traits(&m[2], true, true, false, false);
    check_traits(&m[7], true, true, false, false);
    m[0].reflectance = m[1].reflectance = m[5].reflectance = pm_gray(0.0);
    check_traits(&m[0], true, false, false, false);
    check_traits(&m[1], true, false, true, true);
    check_traits(&m[5], true, true, false, false);
    m[1].specular_reflectance = m[2].specular_reflectance = pm_gray(0.0);
    check_traits(&m[1], true, false, false, false);
    check_traits(&m[2], true, false, false, false);
    check_traits(&m[pm_scenes_null(&s)], false, false, false, false);
    check_traits(&m[pm_scenes_pane(&s, 1.5)], false, false, true, true);
    check_traits(&m[pm_scenes_glass(&s, 1.5)], false, false, true, true);
    check_traits(&m[pm_scenes_mirror(&s, pm_gray(0.5))], false, false, true, true);
    pm_scenes_free(&s);
}

/// The cap on events in a scene of this one material.
static uint32_t cap_of(pm_material material)
{
    pm_scene scene = {.materials = &material, .material_count = 1};
    pm_material_prepare(&material);
    return pm_caps_of(&scene, 0).bounces;
}

static void white_things_are_capped(void)
{
    pm_material plastic = {.type = PM_BSDF_PLASTIC,
                           .reflectance = pm_gray(1.0),
                           .specular_reflectance = pm_gray(1.0),
                           .int_ior = 1.5,
                           .ext_ior = 1.0};
    CHECK(cap_of(plastic) == 10000);
    plastic.reflectance = pm_gray(0.99);
    CHECK(cap_of(plastic) == UINT32_MAX);
    pm_material metal = {.type = PM_BSDF_ROUGH_CONDUCTOR,
                         .specular_reflectance = pm_gray(1.0),
                         .perfect_mirror = true,
                         .alpha = 0.3};
    CHECK(cap_of(metal) == 10000);
    metal.alpha = 0.1; // S: the other cap has it
    CHECK(cap_of(metal) == UINT32_MAX);
}

PM_TESTS({"material.40", "values are alike when the two directions change places",
          values_are_reciprocal},
         {"material.41", "smoothest, roughest, grazing: finite, above the surface, at most 1",
          extremes},
         {"material.42", "a lobe of alpha 0.1 is S, a rougher one D", narrow_is_specular},
         {"material.43", "a white furnace loses nothing to a mirror with almost no roughness",
          white_furnace},
         {"material.44", "materials tell what they can do, black ones too", traits},
         {"material.45", "what could keep light for ever has a cap", white_things_are_capped})

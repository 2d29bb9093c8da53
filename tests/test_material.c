// Lobes of smooth glass, metal, mirrors and diffuse surfaces: Fresnel against complex
// arithmetic, directions, densities, sides.
#include "material.h"

#include "chance.h"
#include "scenes.h"
#include "test.h"

#include <complex.h>

static const pm_rng_source source = {.seed = 3, .stream = PM_STREAM_TEST};

/// A scene of one square across z with these materials; shape 0 has medium 1 inside, 0 outside.
static void sheet(pm_scenes *s, int front, int back)
{
    pm_shape shape = pm_scenes_square(2.0, 0.0, false);
    shape.exterior = 0;
    shape.interior = 1;
    pm_scenes_add(s, shape, front, back);
    pm_scenes_ready(s);
}

static void glass_sheet(pm_scenes *s, double ior)
{
    pm_scenes_begin(s);
    int glass = pm_scenes_glass(s, ior);
    sheet(s, glass, glass);
}

/// The lobes of shape 0 for light from `wi`.
static pm_lobes lobes_towards(const pm_scenes *s, pm_vec3 wi)
{
    pm_hit hit = {.normal = pm_vec(0.0, 0.0, 1.0), .inner = {0}, .offset = 0x1p-19};
    pm_lobes lobes;
    pm_material_lobes(&s->scene, &hit, wi, 0.0, &lobes);
    return lobes;
}

/// Unit direction at this cosine to +z; a negative one comes from behind.
static pm_vec3 at_cosine(double cosine)
{
    double sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    return pm_vec(sine * 0.6, sine * 0.8, cosine);
}

static const pm_lobe *lobe_of(const pm_lobes *lobes, pm_lobe_type type)
{
    for (int i = 0; i < lobes->count; i++) {
        if (lobes->lobe[i].type == type) {
            return &lobes->lobe[i];
        }
    }
    return NULL;
}

static double reflected(const pm_lobes *lobes)
{
    const pm_lobe *lobe = lobe_of(lobes, PM_LOBE_REFLECT);
    return lobe == NULL ? 0.0 : lobe->albedo.c[0];
}

static double transmitted(const pm_lobes *lobes)
{
    const pm_lobe *lobe = lobe_of(lobes, PM_LOBE_TRANSMIT);
    return lobe == NULL ? 0.0 : lobe->albedo.c[0];
}

/// Fresnel's amplitudes in complex numbers: light in vacuum meets index eta + i k (or, for
/// eta_i other than 1, in glass of that index).
static double complex_reflectance(double cosine, double eta_i, double complex eta_t)
{
    double complex relative = eta_t / eta_i;
    double complex cos_t = csqrt(1.0 - (1.0 - cosine * cosine) / (relative * relative));
    double complex r_s = (cosine - relative * cos_t) / (cosine + relative * cos_t);
    double complex r_p = (relative * cosine - cos_t) / (relative * cosine + cos_t);
    double s = cabs(r_s);
    double p = cabs(r_p);
    return 0.5 * (s * s + p * p);
}

/// n + i k, without the imaginary unit of <complex.h>, which is a float.
static double complex index_of(double n, double k)
{
    union {
        double parts[2];
        double complex whole;
    } index = {{n, k}};
    return index.whole;
}

static const double indices[] = {1.0, 1.0 + 1e-7, 1.000277, 1.333, 1.5, 2.4, 4.0, 1e3, 0.7};
enum { INDICES = sizeof indices / sizeof indices[0], STEPS = 1000 };

static void glass_keeps_power(void)
{
    for (int i = 0; i < INDICES; i++) {
        pm_scenes s;
        glass_sheet(&s, indices[i]);
        for (int j = -STEPS; j <= STEPS; j++) {
            pm_lobes lobes = lobes_towards(&s, at_cosine((double)j / STEPS));
            double r = reflected(&lobes);
            CHECK(r >= 0.0 && r <= 1.0);
            CHECK_NEAR(r + transmitted(&lobes), 1.0, 1e-15);
            CHECK(!lobes.diffuse && !lobes.passes);
        }
        pm_scenes_free(&s);
    }
}

static void glass_follows_fresnel(void)
{
    for (int i = 0; i < INDICES; i++) {
        pm_scenes s;
        glass_sheet(&s, indices[i]);
        for (int j = 1; j <= STEPS; j++) {
            double cosine = (double)j / STEPS;
            pm_lobes outside = lobes_towards(&s, at_cosine(cosine));
            pm_lobes inside = lobes_towards(&s, at_cosine(-cosine));
            CHECK_NEAR(reflected(&outside), complex_reflectance(cosine, 1.0, indices[i]), 1e-9);
            CHECK_NEAR(reflected(&inside), complex_reflectance(cosine, indices[i], 1.0), 1e-9);
        }
        pm_scenes_free(&s);
    }
}

static void glass_straight_on(void)
{
    // ((n - 1) / (n + 1))^2, from both sides.
    static const double known[4][2] = {
        {1.5, 0.04}, {1.5168, 0.042165}, {1.0, 0.0}, {3.0, 0.25}};
    for (int i = 0; i < 4; i++) {
        pm_scenes s;
        glass_sheet(&s, known[i][0]);
        pm_lobes outside = lobes_towards(&s, at_cosine(1.0));
        pm_lobes inside = lobes_towards(&s, at_cosine(-1.0));
        double tolerance = i == 1 ? 5e-7 : 1e-15;
        CHECK_NEAR(reflected(&outside), known[i][1], tolerance);
        CHECK_NEAR(reflected(&inside), reflected(&outside), 1e-15);
        pm_scenes_free(&s);
    }
}

static void critical_angle(void)
{
    // From 200 units in the last place inside the critical angle to 200 outside.
    for (int i = 0; i < 5000; i++) {
        double ior = 1.0 + 0.0005 * (i + 1);
        pm_scenes s;
        glass_sheet(&s, ior);
        double critical = sqrt((ior - 1.0) * (ior + 1.0)) / ior;
        for (int j = -200; j <= 200; j += 20) {
            double cosine = critical * (1.0 + j * 0x1p-52);
            pm_lobes lobes = lobes_towards(&s, at_cosine(-cosine));
            double r = reflected(&lobes);
            CHECK_THAT(r <= 1.0 && r > 0.99, "index %.17g, cosine %.17g: %.17g", ior, cosine,
                       r);
            CHECK(lobes.cos_beyond >= 0.0 && lobes.cos_beyond < 1e-4);
            CHECK(j >= -20 || r == 1.0);
        }
        pm_scenes_free(&s);
    }
}

static void total_reflection_has_one_lobe(void)
{
    pm_scenes s;
    glass_sheet(&s, 1.5);
    for (double degrees = 41.82; degrees < 90.0; degrees += 0.01) {
        pm_lobes lobes = lobes_towards(&s, at_cosine(-cos(degrees * PM_PI / 180.0)));
        CHECK(lobes.count == 1 && reflected(&lobes) == 1.0);
    }
    pm_lobes before = lobes_towards(&s, at_cosine(-cos(41.80 * PM_PI / 180.0)));
    CHECK(before.count == 2 && reflected(&before) < 1.0);
    pm_scenes_free(&s);
}

static void grazing_light(void)
{
    pm_scenes s;
    glass_sheet(&s, 1.5);
    // 1 - 2 c (n + 1/n) n / sqrt(n^2 - 1) to first order in the cosine c.
    pm_lobes lobes = lobes_towards(&s, at_cosine(1e-9));
    CHECK_NEAR(reflected(&lobes), 1.0 - 2e-9 * (1.5 + 1.0 / 1.5) * 1.5 / sqrt(1.25), 1e-15);
    lobes = lobes_towards(&s, at_cosine(0.0));
    CHECK_NEAR(reflected(&lobes), 1.0, 0.0);
    pm_scenes_free(&s);
}

static void index_one_is_not_there(void)
{
    static const double cosines[6] = {1.0, 0.3, 1e-4, 1e-9, 1e-200, 0.0};
    pm_scenes s;
    glass_sheet(&s, 1.0);
    for (int i = 0; i < 6; i++) {
        for (int side = -1; side <= 1; side += 2) {
            pm_vec3 wi = at_cosine(side * cosines[i]);
            pm_lobes lobes = lobes_towards(&s, wi);
            CHECK_NEAR(reflected(&lobes), 0.0, 0.0);
            CHECK(lobes.count == 1 && transmitted(&lobes) == 1.0);
            pm_rng rng = pm_rng_at(&source, 0, 0);
            pm_scatter turn;
            pm_material_sample(&lobes, 0, &rng, &turn);
            CHECK_NEAR(pm_vec_length(pm_vec_add(turn.wo, wi)), 0.0, 1e-15);
        }
    }
    pm_scenes_free(&s);
}

// --- metal

static void metal_follows_fresnel(void)
{
    // Gold-like, silver-like, aluminium-like; a weak absorber; glass as a metal without k.
    static const double values[5][2] = {
        {0.143, 3.983}, {0.041, 4.803}, {1.657, 9.224}, {1.5, 1e-3}, {1.5, 0.0}};
    for (int i = 0; i < 5; i++) {
        pm_scenes s;
        pm_scenes_begin(&s);
        double eta = values[i][0];
        double k = values[i][1];
        int metal = pm_scenes_metal(&s, pm_rgb(eta, 2.0, 3.0), pm_rgb(k, 0.5, 1.0));
        sheet(&s, metal, metal);
        for (int j = 0; j <= STEPS; j++) {
            double cosine = (double)j / STEPS;
            pm_lobes lobes = lobes_towards(&s, at_cosine(j % 2 ? -cosine : cosine));
            const pm_lobe *lobe = lobe_of(&lobes, PM_LOBE_REFLECT);
            CHECK(lobes.count == 1 && lobe->specular);
            CHECK_NEAR(lobe->albedo.c[0], complex_reflectance(cosine, 1.0, index_of(eta, k)),
                       1e-12);
            CHECK_NEAR(lobe->albedo.c[1], complex_reflectance(cosine, 1.0, index_of(2.0, 0.5)),
                       1e-12);
            CHECK_NEAR(lobe->albedo.c[2], complex_reflectance(cosine, 1.0, index_of(3.0, 1.0)),
                       1e-12);
        }
        pm_scenes_free(&s);
    }
}

static void metal_of_index_one(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int metal = pm_scenes_metal(&s, pm_gray(1.0), pm_gray(0.0));
    sheet(&s, metal, metal);
    CHECK(lobes_towards(&s, at_cosine(0.0)).count == 0);
    CHECK(lobes_towards(&s, at_cosine(1e-9)).count == 0);
    CHECK(lobes_towards(&s, at_cosine(1.0)).count == 0);
    pm_scenes_free(&s);
}

// --- directions

static pm_scatter sampled(const pm_lobes *lobes, pm_lobe_type type)
{
    pm_rng rng = pm_rng_at(&source, 0, 0);
    pm_scatter scatter;
    pm_material_sample(lobes, (int)(lobe_of(lobes, type) - lobes->lobe), &rng, &scatter);
    CHECK_NEAR(pm_vec_length(scatter.wo), 1.0, 1e-15);
    CHECK(scatter.pdf == 0.0 && pm_spectrum_mean(scatter.weight) == 1.0);
    return scatter;
}

static void light_bends_by_snell(void)
{
    pm_scenes s;
    glass_sheet(&s, 1.5);
    for (int j = 1; j <= STEPS; j++) {
        pm_vec3 wi = at_cosine((double)j / STEPS);
        pm_lobes outside = lobes_towards(&s, wi);
        pm_vec3 mirrored = sampled(&outside, PM_LOBE_REFLECT).wo;
        CHECK_NEAR(mirrored.x + wi.x, 0.0, 1e-15);
        CHECK_NEAR(mirrored.y + wi.y, 0.0, 1e-15);
        CHECK_NEAR(mirrored.z - wi.z, 0.0, 1e-15);
        pm_vec3 bent = sampled(&outside, PM_LOBE_TRANSMIT).wo;
        CHECK(bent.z < 0.0);
        CHECK_NEAR(bent.x, -wi.x / 1.5, 1e-15);
        CHECK_NEAR(bent.y, -wi.y / 1.5, 1e-15);
        pm_lobes inside = lobes_towards(&s, bent);
        CHECK_NEAR(reflected(&inside), reflected(&outside), 1e-9);
        pm_vec3 back = sampled(&inside, PM_LOBE_TRANSMIT).wo;
        CHECK_NEAR(pm_vec_length(pm_vec_sub(back, wi)), 0.0, 1e-9);
    }
    pm_scenes_free(&s);
}

static void media_and_radiance_by_side(void)
{
    pm_scenes s;
    glass_sheet(&s, 1.5);
    pm_lobes outside = lobes_towards(&s, at_cosine(0.8));
    CHECK(outside.medium_here == 0 && outside.medium_beyond == 1);
    CHECK(sampled(&outside, PM_LOBE_REFLECT).medium == 0);
    CHECK_NEAR(sampled(&outside, PM_LOBE_REFLECT).radiance, 1.0, 0.0);
    pm_scatter in = sampled(&outside, PM_LOBE_TRANSMIT);
    CHECK(in.medium == 1);
    CHECK_NEAR(in.radiance, 1.0 / 2.25, 1e-15);
    pm_lobes inside = lobes_towards(&s, in.wo);
    CHECK(inside.medium_here == 1 && inside.medium_beyond == 0);
    pm_scatter out = sampled(&inside, PM_LOBE_TRANSMIT);
    CHECK(out.medium == 0);
    CHECK_NEAR(in.radiance * out.radiance, 1.0, 1e-15);
    pm_scenes_free(&s);
}

static void mirror_tints_and_mirrors(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int mirror = pm_scenes_mirror(&s, pm_rgb(0.9, 0.5, 0.0));
    sheet(&s, mirror, mirror);
    pm_vec3 wi = at_cosine(-0.3);
    pm_lobes lobes = lobes_towards(&s, wi);
    CHECK(lobes.count == 1 && !lobes.diffuse && lobes.normal.z == -1.0);
    CHECK_NEAR(lobes.lobe[0].albedo.c[0], 0.9, 0.0);
    CHECK_NEAR(lobes.lobe[0].albedo.c[2], 0.0, 0.0);
    CHECK_NEAR(sampled(&lobes, PM_LOBE_REFLECT).wo.z, -0.3, 1e-15);
    CHECK_NEAR(pm_spectrum_max(pm_material_evaluate(&lobes, at_cosine(-0.3))), 0.0, 0.0);
    CHECK_NEAR(pm_material_pdf(&lobes, 0, at_cosine(-0.3)), 0.0, 0.0);
    pm_scenes_free(&s);
}

// --- diffuse

static void diffuse_sheet(pm_scenes *s)
{
    pm_scenes_begin(s);
    int red = pm_scenes_diffuse(s, pm_rgb(0.8, 0.2, 0.0));
    sheet(s, red, red);
}

static void diffuse_samples_its_pdf(void)
{
    enum { COUNT = 200000, FINE = 16 };
    pm_scenes s;
    diffuse_sheet(&s);
    for (int side = -1; side <= 1; side += 2) {
        uint64_t cells[FINE * FINE] = {0};
        pm_lobes lobes = lobes_towards(&s, at_cosine(0.4 * side));
        CHECK(lobes.count == 1 && lobes.diffuse && !lobes.lobe[0].specular);
        for (uint64_t i = 0; i < COUNT; i++) {
            pm_rng rng = pm_rng_at(&source, i, 1);
            pm_scatter turn;
            pm_material_sample(&lobes, 0, &rng, &turn);
            double cosine = side * turn.wo.z;
            CHECK_NEAR(turn.pdf, cosine / PM_PI, 1e-15);
            CHECK_NEAR(pm_material_pdf(&lobes, 0, turn.wo), turn.pdf, 0.0);
            pm_spectrum f = pm_material_evaluate(&lobes, turn.wo);
            CHECK_NEAR(f.c[0] * cosine / turn.pdf, 0.8 * turn.weight.c[0], 1e-14);
            CHECK_NEAR(f.c[1] * cosine / turn.pdf, 0.2 * turn.weight.c[1], 1e-14);
            // The share of the density below a cosine is its square.
            double around = atan2(turn.wo.y, turn.wo.x) / (2.0 * PM_PI) + 0.5;
            int row = (int)fmin(cosine * cosine * FINE, FINE - 1);
            cells[row * FINE + (int)fmin(around * FINE, FINE - 1)]++;
        }
        CHECK_EVEN(cells, FINE * FINE);
    }
    pm_scenes_free(&s);
}

static void diffuse_is_reciprocal_and_bounded(void)
{
    pm_scenes s;
    diffuse_sheet(&s);
    pm_spectrum albedo = pm_gray(0.0);
    double density = 0.0;
    pm_lobes from_a = lobes_towards(&s, at_cosine(0.7));
    for (int j = 0; j < STEPS; j++) {
        double cosine = (j + 0.5) / STEPS;
        pm_vec3 b = at_cosine(cosine);
        pm_lobes from_b = lobes_towards(&s, b);
        pm_spectrum there = pm_material_evaluate(&from_a, b);
        pm_spectrum back = pm_material_evaluate(&from_b, at_cosine(0.7));
        CHECK_NEAR(there.c[0], back.c[0], 0.0);
        CHECK_NEAR(there.c[1], back.c[1], 0.0);
        albedo =
            pm_spectrum_add(albedo, pm_spectrum_scale(there, 2.0 * PM_PI * cosine / STEPS));
        density += pm_material_pdf(&from_a, 0, b) * 2.0 * PM_PI / STEPS;
        pm_vec3 below = at_cosine(-cosine);
        CHECK_NEAR(pm_spectrum_max(pm_material_evaluate(&from_a, below)), 0.0, 0.0);
        CHECK_NEAR(pm_material_pdf(&from_a, 0, below), 0.0, 0.0);
    }
    CHECK_NEAR(albedo.c[0], 0.8, 1e-12);
    CHECK_NEAR(albedo.c[1], 0.2, 1e-12);
    CHECK_NEAR(density, 1.0, 1e-12);
    pm_scenes_free(&s);
}

// --- sides

static void sides_wear_their_own(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int black = pm_scenes_diffuse(&s, pm_gray(0.0));
    sheet(&s, black, PM_NONE);
    pm_lobes front = lobes_towards(&s, at_cosine(0.5));
    CHECK(front.diffuse && front.count == 1); // a black floor still holds photons
    CHECK(front.normal.z == 1.0);
    pm_lobes back = lobes_towards(&s, at_cosine(-0.5));
    CHECK(!back.diffuse && back.count == 0 && !back.passes);
    pm_scenes_free(&s);

    pm_scenes_begin(&s);
    int none = pm_scenes_null(&s);
    int mirror = pm_scenes_mirror(&s, pm_gray(1.0));
    sheet(&s, mirror, none);
    CHECK(!lobes_towards(&s, at_cosine(0.5)).passes);
    pm_lobes passing = lobes_towards(&s, at_cosine(-0.5));
    CHECK(passing.passes && passing.count == 0 && !passing.diffuse);
    CHECK(passing.medium_here == 1 && passing.medium_beyond == 0);
    pm_scenes_free(&s);
}

PM_TESTS({"material.1", "what glass reflects and transmits adds up to 1 at every angle",
          glass_keeps_power},
         {"material.2", "glass reflects as complex Fresnel says, from both sides",
          glass_follows_fresnel},
         {"material.3", "straight on, glass of 1.5 reflects 0.04", glass_straight_on},
         {"material.4", "at the critical angle reflection is total and never NaN",
          critical_angle},
         {"material.5", "beyond the critical angle only reflection is left",
          total_reflection_has_one_lobe},
         {"material.6", "grazing light is reflected, to the ninth digit", grazing_light},
         {"material.7", "glass of index 1 reflects nothing and bends nothing at any angle",
          index_one_is_not_there},
         {"material.8", "metal reflects as complex Fresnel says", metal_follows_fresnel},
         {"material.9", "metal of index 1 reflects nothing", metal_of_index_one},
         {"material.10", "light bends by Snell's law and comes back the way it went",
          light_bends_by_snell},
         {"material.11", "sides know their media, and radiance through a slab is unchanged",
          media_and_radiance_by_side},
         {"material.12", "a mirror tints, mirrors, and has no density",
          mirror_tints_and_mirrors},
         {"material.13", "a diffuse surface samples its density, and f cos / pdf is its albedo",
          diffuse_samples_its_pdf},
         {"material.14", "a diffuse surface is reciprocal and reflects its albedo in all",
          diffuse_is_reciprocal_and_bounded},
         {"material.15", "each side of a shape wears its own material", sides_wear_their_own})

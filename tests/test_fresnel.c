// How much glass and metal reflect: Fresnel's formulas against complex arithmetic, at the
// angles where digits are easily lost.
#include "fresnel.h"

#include "material.h"
#include "scenes.h"
#include "test.h"

#include <complex.h>

static const pm_rng_source source = {.seed = 3, .stream = PM_STREAM_TEST};

static double transmitted(const pm_lobes *lobes)
{
    const pm_lobe *lobe = pm_scenes_lobe(lobes, PM_LOBE_TRANSMIT);
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
        pm_scenes_glass_sheet(&s, indices[i]);
        for (int j = -STEPS; j <= STEPS; j++) {
            pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant((double)j / STEPS));
            double r = pm_scenes_reflected(&lobes);
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
        pm_scenes_glass_sheet(&s, indices[i]);
        for (int j = 1; j <= STEPS; j++) {
            double cosine = (double)j / STEPS;
            pm_lobes outside = pm_scenes_lobes(&s, pm_scenes_slant(cosine));
            pm_lobes inside = pm_scenes_lobes(&s, pm_scenes_slant(-cosine));
            CHECK_NEAR(pm_scenes_reflected(&outside),
                       complex_reflectance(cosine, 1.0, indices[i]), 1e-9);
            CHECK_NEAR(pm_scenes_reflected(&inside),
                       complex_reflectance(cosine, indices[i], 1.0), 1e-9);
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
        pm_scenes_glass_sheet(&s, known[i][0]);
        pm_lobes outside = pm_scenes_lobes(&s, pm_scenes_slant(1.0));
        pm_lobes inside = pm_scenes_lobes(&s, pm_scenes_slant(-1.0));
        double tolerance = i == 1 ? 5e-7 : 1e-15;
        CHECK_NEAR(pm_scenes_reflected(&outside), known[i][1], tolerance);
        CHECK_NEAR(pm_scenes_reflected(&inside), pm_scenes_reflected(&outside), 1e-15);
        pm_scenes_free(&s);
    }
}

static void critical_angle(void)
{
    // From 200 units in the last place inside the critical angle to 200 outside.
    for (int i = 0; i < 5000; i++) {
        double ior = 1.0 + 0.0005 * (i + 1);
        pm_scenes s;
        pm_scenes_glass_sheet(&s, ior);
        double critical = sqrt((ior - 1.0) * (ior + 1.0)) / ior;
        for (int j = -200; j <= 200; j += 20) {
            double cosine = critical * (1.0 + j * 0x1p-52);
            pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(-cosine));
            double r = pm_scenes_reflected(&lobes);
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
    pm_scenes_glass_sheet(&s, 1.5);
    for (int i = 4182; i < 9000; i++) {
        double degrees = 0.01 * i;
        pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(-cos(degrees * PM_PI / 180.0)));
        CHECK(lobes.count == 1 && pm_scenes_reflected(&lobes) == 1.0);
    }
    pm_lobes before = pm_scenes_lobes(&s, pm_scenes_slant(-cos(41.80 * PM_PI / 180.0)));
    CHECK(before.count == 2 && pm_scenes_reflected(&before) < 1.0);
    pm_scenes_free(&s);
}

static void grazing_light(void)
{
    pm_scenes s;
    pm_scenes_glass_sheet(&s, 1.5);
    // 1 - 2 c (n + 1/n) n / sqrt(n^2 - 1) to first order in the cosine c.
    pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(1e-9));
    CHECK_NEAR(pm_scenes_reflected(&lobes), 1.0 - 2e-9 * (1.5 + 1.0 / 1.5) * 1.5 / sqrt(1.25),
               1e-15);
    lobes = pm_scenes_lobes(&s, pm_scenes_slant(0.0));
    CHECK_NEAR(pm_scenes_reflected(&lobes), 1.0, 0.0);
    pm_scenes_free(&s);
}

static void index_one_is_not_there(void)
{
    static const double cosines[6] = {1.0, 0.3, 1e-4, 1e-9, 1e-200, 0.0};
    pm_scenes s;
    pm_scenes_glass_sheet(&s, 1.0);
    for (int i = 0; i < 6; i++) {
        for (int side = -1; side <= 1; side += 2) {
            pm_vec3 wi = pm_scenes_slant(side * cosines[i]);
            pm_lobes lobes = pm_scenes_lobes(&s, wi);
            CHECK_NEAR(pm_scenes_reflected(&lobes), 0.0, 0.0);
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
        pm_scenes_sheet(&s, metal, metal);
        for (int j = 0; j <= STEPS; j++) {
            double cosine = (double)j / STEPS;
            pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(j % 2 ? -cosine : cosine));
            const pm_lobe *lobe = pm_scenes_lobe(&lobes, PM_LOBE_REFLECT);
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
    pm_scenes_sheet(&s, metal, metal);
    CHECK(pm_scenes_lobes(&s, pm_scenes_slant(0.0)).count == 0);
    CHECK(pm_scenes_lobes(&s, pm_scenes_slant(1e-9)).count == 0);
    CHECK(pm_scenes_lobes(&s, pm_scenes_slant(1.0)).count == 0);
    pm_scenes_free(&s);
}

// --- panes and diffuse light

static void panes(void)
{
    for (int i = 0; i < INDICES; i++) {
        for (int j = 0; j <= STEPS; j++) {
            double cosine = (double)j / STEPS;
            double cos_t;
            double face = pm_fresnel_dielectric(cosine, 1.0 / indices[i], &cos_t);
            // Light that is thrown to and fro between the two faces.
            double sum = face;
            double inside = (1.0 - face) * (1.0 - face) * face;
            for (int k = 0; k < 1000; k++) {
                sum += inside;
                inside *= face * face;
            }
            double rest = face < 1.0 ? inside / ((1.0 - face) * (1.0 + face)) : 0.0;
            CHECK_NEAR(pm_fresnel_pane(cosine, 1.0 / indices[i]), sum + rest, 1e-12);
        }
        CHECK_NEAR(pm_fresnel_pane(0.0, 1.0 / indices[i]), indices[i] == 1.0 ? 0.0 : 1.0, 0.0);
    }
    CHECK_NEAR(pm_fresnel_pane(1.0, 1.0 / 1.5), 0.08 / 1.04, 1e-15);
}

static void pane_goes_straight_on(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int pane = pm_scenes_pane(&s, 1.5);
    s.materials[pane].specular_reflectance = pm_rgb(1.0, 0.5, 0.0);
    s.materials[pane].specular_transmittance = pm_rgb(0.25, 1.0, 1.0);
    pm_scenes_sheet(&s, pane, pane);
    for (int j = -STEPS; j <= STEPS; j++) {
        pm_vec3 wi = pm_scenes_slant((double)j / STEPS);
        pm_lobes lobes = pm_scenes_lobes(&s, wi);
        double r = pm_fresnel_pane(fabs(wi.z), 1.0 / 1.5);
        CHECK_NEAR(pm_scenes_reflected(&lobes), r, 1e-15);
        const pm_lobe *through = pm_scenes_lobe(&lobes, PM_LOBE_STRAIGHT);
        CHECK(lobes.lobe[0].specular && !lobes.diffuse && !lobes.passes);
        if (through == NULL) {
            CHECK(j == 0 && lobes.count == 1);
            continue;
        }
        CHECK(lobes.count == 2 && through->specular);
        CHECK_NEAR(through->albedo.c[0], 0.25 * (1.0 - r), 1e-15);
        CHECK_NEAR(through->albedo.c[2], 1.0 - r, 1e-15);
        pm_rng rng = pm_rng_at(&source, 0, 0);
        pm_scatter turn;
        pm_material_sample(&lobes, (int)(through - lobes.lobe), &rng, &turn);
        CHECK_NEAR(pm_vec_length(pm_vec_add(turn.wo, wi)), 0.0, 0.0);
        CHECK_NEAR(turn.radiance, 1.0, 0.0);
        CHECK(turn.pdf == 0.0 && turn.medium == (j > 0));
    }
    pm_scenes_free(&s);
}

/// Mean reflectance for diffuse light from the thinner side, n > 1, in closed form (Walsh).
static double walsh(double n)
{
    double n2 = n * n;
    double n4 = n2 * n2;
    double sum = 0.5 + (n - 1.0) * (3.0 * n + 1.0) / (6.0 * (n + 1.0) * (n + 1.0));
    sum += n2 * pow(n2 - 1.0, 2.0) / pow(n2 + 1.0, 3.0) * log((n - 1.0) / (n + 1.0));
    sum -= 2.0 * n2 * n * (n2 + 2.0 * n - 1.0) / ((n2 + 1.0) * (n4 - 1.0));
    return sum + 8.0 * n4 * (n4 + 1.0) / ((n2 + 1.0) * pow(n4 - 1.0, 2.0)) * log(n);
}

static void diffuse_light(void)
{
    for (int i = 0; i < 60; i++) {
        double n = 1.05 * pow(1.05, i);
        CHECK_NEAR(pm_fresnel_diffuse_through(1.0 / n), 1.0 - walsh(n), 1e-8);
        CHECK_NEAR(pm_fresnel_diffuse_through(n), (1.0 - walsh(n)) / (n * n), 1e-8);
    }
    CHECK_NEAR(walsh(1.5), 0.0918, 5e-5);
    CHECK_NEAR(pm_fresnel_diffuse_through(1.0), 1.0, 1e-14);
    // Both sides by plain sums; total reflection beyond asin(1 / 1.5) and all.
    double sum = 0.0;
    for (int i = 0; i < 100000; i++) {
        double cosine = (i + 0.5) / 100000;
        double cos_t;
        sum += 2e-5 * cosine * (1.0 - pm_fresnel_dielectric(cosine, 1.5, &cos_t));
    }
    CHECK_NEAR(pm_fresnel_diffuse_through(1.5), sum, 1e-6);
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
         {"fresnel.1", "a pane reflects all that its two faces throw to and fro", panes},
         {"fresnel.2", "light goes straight through a pane, and tints apply",
          pane_goes_straight_on},
         {"fresnel.3", "diffuse light gets through as Walsh's closed form says", diffuse_light})

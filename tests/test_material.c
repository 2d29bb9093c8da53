// Where surfaces send light: directions, densities, values, and which side does what.
#include "material.h"

#include "chance.h"
#include "scenes.h"
#include "test.h"

enum { STEPS = 1000 };
static const pm_rng_source source = {.seed = 3, .stream = PM_STREAM_TEST};

// --- directions

static pm_scatter sampled(const pm_lobes *lobes, pm_lobe_type type)
{
    pm_rng rng = pm_rng_at(&source, 0, 0);
    pm_scatter scatter;
    pm_material_sample(lobes, (int)(pm_scenes_lobe(lobes, type) - lobes->lobe), &rng, &scatter);
    CHECK_NEAR(pm_vec_length(scatter.wo), 1.0, 1e-15);
    CHECK(scatter.pdf == 0.0 && pm_spectrum_mean(scatter.weight) == 1.0);
    return scatter;
}

static void light_bends_by_snell(void)
{
    pm_scenes s;
    pm_scenes_glass_sheet(&s, 1.5);
    for (int j = 1; j <= STEPS; j++) {
        pm_vec3 wi = pm_scenes_slant((double)j / STEPS);
        pm_lobes outside = pm_scenes_lobes(&s, wi);
        pm_vec3 mirrored = sampled(&outside, PM_LOBE_REFLECT).wo;
        CHECK_NEAR(mirrored.x + wi.x, 0.0, 1e-15);
        CHECK_NEAR(mirrored.y + wi.y, 0.0, 1e-15);
        CHECK_NEAR(mirrored.z - wi.z, 0.0, 1e-15);
        pm_vec3 bent = sampled(&outside, PM_LOBE_TRANSMIT).wo;
        CHECK(bent.z < 0.0);
        CHECK_NEAR(bent.x, -wi.x / 1.5, 1e-15);
        CHECK_NEAR(bent.y, -wi.y / 1.5, 1e-15);
        pm_lobes inside = pm_scenes_lobes(&s, bent);
        CHECK_NEAR(pm_scenes_reflected(&inside), pm_scenes_reflected(&outside), 1e-9);
        pm_vec3 back = sampled(&inside, PM_LOBE_TRANSMIT).wo;
        CHECK_NEAR(pm_vec_length(pm_vec_sub(back, wi)), 0.0, 1e-9);
    }
    pm_scenes_free(&s);
}

static void media_and_radiance_by_side(void)
{
    pm_scenes s;
    pm_scenes_glass_sheet(&s, 1.5);
    pm_lobes outside = pm_scenes_lobes(&s, pm_scenes_slant(0.8));
    CHECK(outside.medium_here == 0 && outside.medium_beyond == 1);
    CHECK(sampled(&outside, PM_LOBE_REFLECT).medium == 0);
    CHECK_NEAR(sampled(&outside, PM_LOBE_REFLECT).radiance, 1.0, 0.0);
    pm_scatter in = sampled(&outside, PM_LOBE_TRANSMIT);
    CHECK(in.medium == 1);
    CHECK_NEAR(in.radiance, 1.0 / 2.25, 1e-15);
    pm_lobes inside = pm_scenes_lobes(&s, in.wo);
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
    pm_scenes_sheet(&s, mirror, mirror);
    pm_vec3 wi = pm_scenes_slant(-0.3);
    pm_lobes lobes = pm_scenes_lobes(&s, wi);
    CHECK(lobes.count == 1 && !lobes.diffuse && lobes.normal.z == -1.0);
    CHECK_NEAR(lobes.lobe[0].albedo.c[0], 0.9, 0.0);
    CHECK_NEAR(lobes.lobe[0].albedo.c[2], 0.0, 0.0);
    CHECK_NEAR(sampled(&lobes, PM_LOBE_REFLECT).wo.z, -0.3, 1e-15);
    CHECK_NEAR(pm_spectrum_max(pm_material_evaluate(&lobes, pm_scenes_slant(-0.3))), 0.0, 0.0);
    CHECK_NEAR(pm_material_pdf(&lobes, 0, pm_scenes_slant(-0.3)), 0.0, 0.0);
    pm_scenes_free(&s);
}

// --- diffuse

static void diffuse_sheet(pm_scenes *s)
{
    pm_scenes_begin(s);
    int red = pm_scenes_diffuse(s, pm_rgb(0.8, 0.2, 0.0));
    pm_scenes_sheet(s, red, red);
}

static void diffuse_samples_its_pdf(void)
{
    enum { COUNT = 200000, FINE = 16 };
    pm_scenes s;
    diffuse_sheet(&s);
    for (int side = -1; side <= 1; side += 2) {
        uint64_t cells[FINE * FINE] = {0};
        pm_lobes lobes = pm_scenes_lobes(&s, pm_scenes_slant(0.4 * side));
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
    pm_lobes from_a = pm_scenes_lobes(&s, pm_scenes_slant(0.7));
    for (int j = 0; j < STEPS; j++) {
        double cosine = (j + 0.5) / STEPS;
        pm_vec3 b = pm_scenes_slant(cosine);
        pm_lobes from_b = pm_scenes_lobes(&s, b);
        pm_spectrum there = pm_material_evaluate(&from_a, b);
        pm_spectrum back = pm_material_evaluate(&from_b, pm_scenes_slant(0.7));
        CHECK_NEAR(there.c[0], back.c[0], 0.0);
        CHECK_NEAR(there.c[1], back.c[1], 0.0);
        albedo =
            pm_spectrum_add(albedo, pm_spectrum_scale(there, 2.0 * PM_PI * cosine / STEPS));
        density += pm_material_pdf(&from_a, 0, b) * 2.0 * PM_PI / STEPS;
        pm_vec3 below = pm_scenes_slant(-cosine);
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
    pm_scenes_sheet(&s, black, PM_NONE);
    pm_lobes front = pm_scenes_lobes(&s, pm_scenes_slant(0.5));
    CHECK(front.diffuse && front.count == 1); // a black floor still holds photons
    CHECK(front.normal.z == 1.0);
    pm_lobes back = pm_scenes_lobes(&s, pm_scenes_slant(-0.5));
    CHECK(!back.diffuse && back.count == 0 && !back.passes);
    pm_scenes_free(&s);

    pm_scenes_begin(&s);
    int none = pm_scenes_null(&s);
    int mirror = pm_scenes_mirror(&s, pm_gray(1.0));
    pm_scenes_sheet(&s, mirror, none);
    CHECK(!pm_scenes_lobes(&s, pm_scenes_slant(0.5)).passes);
    pm_lobes passing = pm_scenes_lobes(&s, pm_scenes_slant(-0.5));
    CHECK(passing.passes && passing.count == 0 && !passing.diffuse);
    CHECK(passing.medium_here == 1 && passing.medium_beyond == 0);
    pm_scenes_free(&s);
}

PM_TESTS({"material.10", "light bends by Snell's law and comes back the way it went",
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

// Direct light from the constant light, which only directions drawn by the surface find.
#include "direct.h"

#include "receivers.h"
#include "scenes.h"
#include "shapes.h"
#include "tally.h"
#include "test.h"

static void open_floor_gets_pi_l(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(20.0, 0.0, false), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_sky(&s, pm_gray(3.0));
    pm_scenes_ready(&s);
    pm_hit hit;
    pm_lobes lobes;
    pm_receivers_meet(&s, pm_scenes_slant(0.6), &hit, &lobes);
    CHECK_NEAR(pm_receivers_direct(&s, &hit, &lobes, 16, 0), 0.5 * 3.0, 1e-14); // E = pi L
    pm_scenes_free(&s);
}

static void a_disk_hides_its_share_of_the_sky(void)
{
    // E / (pi L) = 1 - R^2 / (R^2 + h^2); a null disk hides nothing, a lamp adds its light.
    for (int kind = 0; kind < 3; kind++) {
        pm_scenes s;
        pm_scenes_begin(&s);
        int gray = pm_scenes_diffuse(&s, pm_gray(0.5));
        int material = kind == 1 ? pm_scenes_null(&s) : gray;
        pm_scenes_wear(&s, pm_scenes_square(20.0, 0.0, false), gray);
        pm_shape disk = pm_shapes_disk(pm_vec(0.0, 0.0, 1.0), pm_vec(0.0, 0.0, -1.0), 0.75);
        int hung = pm_scenes_wear(&s, disk, material);
        pm_scenes_sky(&s, pm_gray(2.0));
        if (kind == 2) {
            pm_scenes_lamp(&s, hung, pm_gray(5.0));
        }
        pm_scenes_ready(&s);
        pm_hit hit;
        pm_lobes lobes;
        pm_receivers_meet(&s, pm_scenes_slant(0.6), &hit, &lobes);
        double hidden = 0.36;
        double want = kind == 1 ? 2.0 : 2.0 * (1.0 - hidden) + (kind == 2 ? 5.0 * hidden : 0.0);
        CHECK_NEAR(pm_receivers_direct(&s, &hit, &lobes, 40000, 1), 0.5 * want, 3e-4 * want);
        pm_scenes_free(&s);
    }
}

/// A surface of `material` alone under a sky of 1: the lobes' own mean, part by part.
static void check_under_sky(int (*make)(pm_scenes *s), int lobe_count)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(20.0, 0.0, false), make(&s));
    pm_scenes_sky(&s, pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_hit hit;
    pm_lobes lobes;
    pm_receivers_meet(&s, pm_scenes_slant(0.4), &hit, &lobes);
    CHECK(lobes.count == lobe_count);
    pm_tally direct = {0};
    pm_tally brute = {0};
    for (uint64_t run = 0; run < 3000; run++) {
        pm_rng rng = pm_rng_at(&pm_receivers_source, run, 3);
        double sum = 0.0;
        for (int i = 0; i < lobes.count; i++) {
            pm_scatter scatter;
            pm_material_sample(&lobes, i, &rng, &scatter);
            double one = lobes.lobe[i].albedo.c[0] * scatter.weight.c[0];
            sum += lobes.lobe[i].specular ? 0.0 : one;
        }
        pm_tally_take(&brute, sum);
        pm_tally_take(&direct, pm_receivers_direct(&s, &hit, &lobes, 2, run));
    }
    pm_tally_same("under the sky", &direct, &brute);
    pm_scenes_free(&s);
}

static int make_rough_plastic(pm_scenes *s)
{
    return pm_scenes_rough_plastic(s, pm_gray(0.5), 1.5, PM_MICROFACET_GGX, 0.3);
}

static int make_rough_mirror(pm_scenes *s)
{
    return pm_scenes_rough_mirror(s, PM_MICROFACET_BECKMANN, 0.5);
}

static int make_plastic(pm_scenes *s)
{
    return pm_scenes_plastic(s, pm_gray(0.5), 1.5);
}

static void sky_on_every_surface(void)
{
    check_under_sky(make_rough_plastic, 2);
    check_under_sky(make_rough_mirror, 1);
    check_under_sky(make_plastic, 2); // its smooth lobe is not asked for
}

PM_TESTS({"direct_sky.1", "an open floor under the constant light gets pi L",
          open_floor_gets_pi_l},
         {"direct_sky.2", "a disk hides its share of the sky, a null one nothing",
          a_disk_hides_its_share_of_the_sky},
         {"direct_sky.3", "every D lobe gets its part of the constant light",
          sky_on_every_surface})

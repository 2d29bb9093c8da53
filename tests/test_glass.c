// Glasses by the numbers they are sold by, and what a dielectric makes of them.
#include "glass.h"

#include "scenes.h"
#include "test.h"

#include <string.h>

/// Index at the d line, Abbe number, and the index at 400 and 700 nm, as catalogues print them.
typedef struct {
    const char *name;
    double index, abbe, blue, red;
} entry;

static const entry catalogue[] = {
    {"bk7", 1.51680, 64.17, 1.53085, 1.51306},
    {"sf10", 1.72825, 28.41, 1.77826, 1.71729},
    {"sf11", 1.78472, 25.76, 1.84512, 1.77181},
    {"n-sf11", 1.78472, 25.68, 1.84542, 1.77175},
    {"fused-silica", 1.45846, 67.82, 1.47012, 1.45529},
    {"diamond", 2.41749, 55.30, 2.46413, 2.40624},
    {"water", 1.33340, 55.76, 1.34356, 1.33052},
};

enum { GLASSES = sizeof catalogue / sizeof catalogue[0] };

static const double half_digit = 0.5e-5 * 1.001; // of the catalogue's fifth place

static void glasses_are_as_sold(void)
{
    for (int i = 0; i < GLASSES; i++) {
        const pm_glass *glass = pm_glass_named(catalogue[i].name);
        CHECK_THAT(glass != NULL, "no glass %s", catalogue[i].name);
        CHECK(strcmp(glass->name, catalogue[i].name) == 0);
        CHECK_NEAR(pm_glass_index(glass, PM_GLASS_D_LINE), catalogue[i].index, half_digit);
        CHECK_NEAR(pm_glass_abbe(glass), catalogue[i].abbe, 0.5e-2 * 1.001);
    }
}

static void ends_of_the_range_are_as_sold(void)
{
    for (int i = 0; i < GLASSES; i++) {
        const pm_glass *glass = pm_glass_named(catalogue[i].name);
        CHECK_NEAR(pm_glass_index(glass, 400.0), catalogue[i].blue, half_digit);
        CHECK_NEAR(pm_glass_index(glass, 700.0), catalogue[i].red, half_digit);
    }
}

static void index_falls_with_the_wavelength(void)
{
    for (int i = 0; i < GLASSES; i++) {
        const pm_glass *glass = pm_glass_named(catalogue[i].name);
        double before = pm_glass_index(glass, 380.0);
        for (double nm = 381.0; nm <= 720.0; nm += 1.0) {
            double now = pm_glass_index(glass, nm);
            CHECK_THAT(now < before && now > 1.0, "%s at %g nm: %g", glass->name, nm, now);
            before = now;
        }
    }
}

static void unknown_names_have_a_nearest_one(void)
{
    static const char *const wrong[][2] = {
        {"bk-7", "bk7"},        {"n-sf1", "n-sf11"}, {"fused silica", "fused-silica"},
        {"diamant", "diamond"}, {"BK7", "bk7"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        CHECK_THAT(pm_glass_named(wrong[i][0]) == NULL, "%s is a glass", wrong[i][0]);
        CHECK_CONTAINS(pm_glass_nearest(wrong[i][0]), wrong[i][1]);
    }
}

// --- in a dielectric

static pm_lobes lobes_at(pm_scenes *s, pm_vec3 wi, double wavelength)
{
    pm_vec3 from = pm_vec_scale(wi, 2.0);
    pm_ray ray = {from, pm_vec_negate(wi), HUGE_VAL, wavelength, PM_NONE};
    pm_hit hit;
    pm_lobes lobes;
    CHECK(pm_closest(&s->world, &ray, &hit));
    pm_material_lobes(&s->scene, &hit, &ray, &lobes);
    return lobes;
}

static void a_ray_has_the_index_of_its_wavelength(void)
{
    pm_scenes s;
    pm_scenes_glass_sheet(&s, 1.3);
    s.materials[0].glass = pm_glass_named("sf11");
    s.materials[0].ext_ior = 1.1;
    for (double nm = 380.0; nm <= 720.0; nm += 20.0) {
        double n = pm_glass_index(s.materials[0].glass, nm);
        pm_lobes above = lobes_at(&s, pm_scenes_slant(0.6), nm);
        pm_lobes below = lobes_at(&s, pm_scenes_slant(-0.9), nm);
        CHECK_NEAR(above.eta, 1.1 / n, 1e-15);
        CHECK_NEAR(below.eta, n / 1.1, 1e-15);
        // Snell: the sine within, from the cosine that the lobes hold.
        double sine = sqrt(1.0 - above.cos_beyond * above.cos_beyond);
        CHECK_NEAR(sine, 0.8 * 1.1 / n, 1e-14);
        CHECK(!above.disperses && !below.disperses);
    }
    pm_scenes_free(&s);
}

static void a_ray_without_one_has_the_d_line(void)
{
    pm_scenes s;
    pm_scenes_glass_sheet(&s, 1.3);
    s.materials[0].glass = pm_glass_named("bk7");
    pm_lobes lobes = lobes_at(&s, pm_scenes_slant(0.6), 0.0);
    CHECK(lobes.disperses && !lobes.diffuse);
    CHECK_NEAR(lobes.eta, 1.0 / 1.5168, 1e-6);
    pm_scenes_free(&s);
}

static void nothing_but_glass_disperses(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int made[] = {pm_scenes_diffuse(&s, pm_gray(0.5)),
                  pm_scenes_mirror(&s, pm_gray(0.9)),
                  pm_scenes_glass(&s, 1.5),
                  pm_scenes_pane(&s, 1.5),
                  pm_scenes_null(&s),
                  pm_scenes_plastic(&s, pm_gray(0.5), 1.5)};
    pm_scenes_wear(&s, pm_scenes_square(1.0, 0.0, false), made[0]);
    pm_scenes_ready(&s);
    for (size_t i = 0; i < sizeof made / sizeof made[0]; i++) {
        s.shapes[0].material[0] = made[i];
        pm_lobes plain = lobes_at(&s, pm_scenes_slant(0.6), 0.0);
        pm_lobes blue = lobes_at(&s, pm_scenes_slant(0.6), 400.0);
        CHECK(!plain.disperses && !blue.disperses);
        CHECK(plain.count == blue.count &&
              memcmp(&plain.eta, &blue.eta, sizeof plain.eta) == 0);
    }
    pm_scenes_free(&s);
}

PM_TESTS({"glass.1", "each glass has the n_d and the Abbe number that it is sold by",
          glasses_are_as_sold},
         {"glass.2", "each glass has the catalogue's index at 400 and 700 nm",
          ends_of_the_range_are_as_sold},
         {"glass.3", "the index falls from blue to red", index_falls_with_the_wavelength},
         {"glass.4", "a name that is no glass has a nearest one",
          unknown_names_have_a_nearest_one},
         {"glass.5", "a ray is refracted by the index at its wavelength over that outside",
          a_ray_has_the_index_of_its_wavelength},
         {"glass.6", "a ray of all channels is told that glass disperses, and sees the d line",
          a_ray_without_one_has_the_d_line},
         {"glass.7", "no other material minds the wavelength", nothing_but_glass_disperses})

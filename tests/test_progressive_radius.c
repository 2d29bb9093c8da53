// Radii of progressive pictures: their schedule against its product, and where the first one
// comes from.
#include "balance.h"
#include "first_radius.h"
#include "progressive.h"
#include "test.h"

// --- the schedule ----------------------------------------------------------------------------

static void radii_follow_the_product(void)
{
    double left = 1.0; // of the square, or the cube
    for (uint64_t pass = 1; pass <= 70000; pass++) {
        bool look = pass < 200 || (pass > 65500 && pass < 65600) || pass == 70000;
        if (look) {
            double r = pm_progressive_radius(pass, 2);
            double ball = pm_progressive_radius(pass, 3);
            CHECK_NEAR(r * r / left, 1.0, 2e-12);
            CHECK_NEAR(ball * ball * ball / left, 1.0, 2e-12);
        }
        left *= ((double)pass + 2.0 / 3.0) / ((double)pass + 1.0);
    }
}

/// The first ratio is (1 + a) / 2: begun at 0 it would be a, and all radii too small for ever.
static void the_second_pass_has_five_sixths(void)
{
    CHECK_NEAR(pm_progressive_radius(1, 2), 1.0, 0.0);
    CHECK_NEAR(pm_progressive_radius(1, 3), 1.0, 0.0);
    CHECK_NEAR(pow(pm_progressive_radius(2, 2), 2.0), 5.0 / 6.0, 1e-15);
    CHECK_NEAR(pow(pm_progressive_radius(100, 2), 2.0), 0.2384, 5e-5);
}

static void radii_fall_as_a_power_of_the_pass(void)
{
    double limit = 1.0 / tgamma(5.0 / 3.0);
    for (double pass = 1e4; pass < 3e8; pass *= 10.0) {
        double r = pm_progressive_radius((uint64_t)pass, 2);
        CHECK_NEAR(r * r * cbrt(pass) / limit, 1.0, 0.2 / pass);
    }
}

static void beams_are_discs_and_steps_are_balls(void)
{
    pm_render_settings settings = pm_render_defaults();
    CHECK(pm_progressive_dimensions(&settings, PM_MAP_VOLUME) == 2);
    settings.light.media = PM_MEDIA_MARCH;
    CHECK(pm_progressive_dimensions(&settings, PM_MAP_VOLUME) == 3);
    CHECK(pm_progressive_dimensions(&settings, PM_MAP_GLOBAL) == 2);
    CHECK(pm_progressive_dimensions(&settings, PM_MAP_CAUSTIC) == 2);
}

// --- the first radius ------------------------------------------------------------------------

/// Photons on a line, a metre apart, all facing up.
static pm_photon_map line_of_photons(pm_photon *photons, uint32_t count)
{
    pm_photon_map map = {.kind = PM_MAP_VOLUME, .photons = photons, .count = count};
    for (uint32_t i = 0; i < count; i++) {
        photons[i] = (pm_photon){.position = {(float)i, 0.0f, 0.0f}};
        photons[i].flags = (uint16_t)(0xfffu << PM_PHOTON_NORMAL_SHIFT);
    }
    CHECK_OK(pm_balance_build(&map));
    return map;
}

static void the_first_radius_is_the_mean_distance(void)
{
    pm_photon photons[100];
    double radius;
    pm_photon_map map = line_of_photons(photons, 100);
    // The fourth lies 2 m away, but 3 m and 4 m for those at the ends.
    CHECK_OK(pm_first_radius(&map, 4, 0, &radius));
    CHECK_NEAR(radius, (96.0 * 2.0 + 2.0 * 3.0 + 2.0 * 4.0) / 100.0, 1e-12);
    map = line_of_photons(photons, 3); // fewer than k: the last stands for it
    CHECK_OK(pm_first_radius(&map, 50, 0, &radius));
    CHECK_NEAR(radius, 5.0 / 3.0, 1e-12);
    map = line_of_photons(photons, 1);
    CHECK_OK(pm_first_radius(&map, 4, 0, &radius));
    CHECK_NEAR(radius, 0.0, 0.0);
    map = (pm_photon_map){0};
    CHECK_OK(pm_first_radius(&map, 4, 0, &radius));
    CHECK_NEAR(radius, 0.0, 0.0);
    CHECK_FAILS(pm_first_radius(&map, 0, 0, &radius), PM_EINPUT, "k must be");
}

static void the_first_radius_leaves_out_what_is_not_asked(void)
{
    pm_photon photons[100];
    double radius;
    pm_photon_map map = line_of_photons(photons, 100);
    for (uint32_t i = 0; i < 100; i++) {
        bool odd = ((int)photons[i].position[0] & 1) != 0;
        photons[i].flags |= odd ? PM_PHOTON_FIRST : 0;
    }
    CHECK_OK(pm_first_radius(&map, 2, PM_PHOTON_FIRST, &radius));
    CHECK_NEAR(radius, (48.0 * 2.0 + 2.0 * 4.0) / 50.0, 1e-12);
}

PM_TESTS({"progressive_radius.1",
          "radii are the product of their ratios, and beyond 65536 its series",
          radii_follow_the_product},
         {"progressive_radius.2", "the second pass has 5/6 of the first one's area",
          the_second_pass_has_five_sixths},
         {"progressive_radius.3", "the area falls as the cube root of the pass",
          radii_fall_as_a_power_of_the_pass},
         {"progressive_radius.4", "beams shrink as discs, steps of a march as balls",
          beams_are_discs_and_steps_are_balls},
         {"progressive_radius.5", "the first radius is the mean distance of the k-th photon",
          the_first_radius_is_the_mean_distance},
         {"progressive_radius.6",
          "the first radius leaves out photons that are not asked about",
          the_first_radius_leaves_out_what_is_not_asked})

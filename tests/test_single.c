// Light pm_glows_scattered once into a ray: closed forms under a sun, quadrature for point and
// spot, what stands in the way, and extremes. Bounds are 5 sd of the runs' own variance.
#include "single.h"

#include "glows.h"
#include "integrals.h"
#include "medium.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

// --- points and spots -----------------------------------------------------------------------

static const double asymmetries[3] = {0.0, 0.7, -0.5};

static void points_in_endless_fog(void)
{
    for (int i = 0; i < 18; i++) {
        double t_max = i / 3 % 2 == 0 ? HUGE_VAL : 2.5;
        double aside = i / 6 == 0 ? 0.02 : i / 6 == 1 ? 0.5 : 3.0;
        pm_scenes s;
        pm_glows_fog(&s, 0.6, 0.8, asymmetries[i % 3]);
        pm_scenes_point(&s, pm_vec(aside, 0.0, 1.5), pm_gray(4.0));
        pm_scenes_ready(&s);
        pm_glows_integrand in = {
            &s, pm_glows_ray(pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), t_max), {0.0}, 0.0};
        double want = pm_integral(pm_glows_scattered, &in, 0.0, 1.5);
        want += pm_integral(pm_glows_scattered, &in, 1.5, t_max);
        pm_glows_check(&s, &in.along, want, 0.02);
        pm_spectrum one = pm_glows_run(&s, &in.along, 1, 0); // in the albedo's colour
        CHECK(one.c[0] == 0.5 * one.c[1] && one.c[2] == 0.0);
        pm_scenes_free(&s);
    }
}

static void spots_in_endless_fog(void)
{
    // Narrow, wide, and wider than a half-space; across the ray and towards its start.
    static const double cones[3][2] = {{0.01, 0.02}, {0.3, 0.6}, {1.0, 2.5}};
    for (int i = 0; i < 6; i++) {
        pm_scenes s;
        pm_glows_fog(&s, 0.6, 0.8, 0.4);
        pm_vec3 way = i < 3 ? pm_vec(-1.0, 0.0, 0.2) : pm_vec(-0.4, 0.01, -1.0);
        pm_scenes_spot(&s, pm_vec(0.7, 0.0, 3.0), way, cones[i % 3], pm_gray(4.0));
        pm_scenes_ready(&s);
        pm_glows_integrand in = {
            &s, pm_glows_ray(pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), 9.0), {0.0}, 0.0};
        double want = 0.0;
        for (int piece = 0; piece < 900; piece++) { // the cone's edges are kinks
            want += pm_integral(pm_glows_scattered, &in, 0.01 * piece, 0.01 * (piece + 1));
        }
        pm_glows_check(&s, &in.along, want, 0.004);
        pm_scenes_free(&s);
    }
}

// --- suns -----------------------------------------------------------------------------------

/// A slab of fog from z = 0 to 1, and a sun that shines down at this cosine.
static void begin_slab(pm_scenes *s, double sigma_t, double cosine)
{
    pm_scenes_begin(s);
    int fog = pm_scenes_medium(s, sigma_t, pm_gray(0.5), 0.3);
    pm_scenes_bound(s, pm_scenes_square(16.0, 0.0, true), fog, PM_NONE);
    pm_scenes_bound(s, pm_scenes_square(16.0, 1.0, false), fog, PM_NONE);
    pm_scenes_sun(s, pm_vec(sqrt(1.0 - cosine * cosine), 0.0, -cosine), pm_gray(3.0));
    pm_scenes_ready(s);
}

static void suns_through_slabs(void)
{
    static const double densities[5] = {1e-6, 0.5, 4.0, 1e3, 1e6};
    for (int i = 0; i < 15; i++) {
        double cosine = 1.0 - 0.3 * (i / 5);
        double sigma_t = densities[i % 5];
        pm_scenes s;
        begin_slab(&s, sigma_t, cosine);
        // Looking down from the top: the two ways grow together; up from below: one for the
        // other.
        pm_vec3 top = pm_vec(0.0, 0.0, 1.0 - 1e-12);
        pm_ray down = pm_glows_ray(top, pm_vec(0.0, 0.0, -1.0), 1.0);
        pm_ray up = pm_glows_ray(pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), 1.0);
        const pm_medium *fog = &s.media[0];
        double both = 1.0 + 1.0 / cosine;
        double want = 1.5 * pm_medium_phase(fog, -cosine) * -expm1(-sigma_t * both) / both;
        pm_glows_check(&s, &down, want, 0.02);
        double over = 1.0 / cosine - 1.0;
        want = 1.5 * pm_medium_phase(fog, cosine) * exp(-sigma_t / cosine) *
               (over == 0.0 ? sigma_t : expm1(sigma_t * over) / over);
        if (sigma_t < 10.0) {
            pm_glows_check(&s, &up, want, 0.08);
        }
        pm_scenes_free(&s);
    }
}

static void level_views_have_no_noise(void)
{
    // The sun's way to every place is the same, so places drawn by transmittance are exact.
    pm_scenes s;
    begin_slab(&s, 0.7, 1.0);
    pm_ray level = pm_glows_ray(pm_vec(0.0, 0.0, 0.25), pm_vec(1.0, 0.0, 0.0), HUGE_VAL);
    double want = 1.5 * pm_medium_phase(&s.media[0], 0.0) * exp(-0.7 * 0.75);
    CHECK_NEAR(pm_glows_run(&s, &level, 1, 3).c[0], want, 1e-5 * want);
    level.t_max = 2.0;
    CHECK_NEAR(pm_glows_run(&s, &level, 1, 4).c[0], want * -expm1(-1.4), 1e-5 * want);
    pm_scenes_free(&s);
}

// --- what stands in the way -----------------------------------------------------------------

/// A ray that passes below a point, in a ball of fog around both, with `thing` between.
static double with_thing(pm_shape thing, int wear)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_medium(&s, 0.4, pm_gray(0.5), 0.0);
    pm_scenes_medium(&s, 2.0, pm_gray(0.5), 0.0);
    pm_scenes_bound(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 5.0), 0, PM_NONE);
    int glass = pm_scenes_glass(&s, 1.5);
    if (wear == 0) {
        pm_scenes_wear(&s, thing, glass);
    } else {
        pm_scenes_bound(&s, thing, wear == 1 ? 0 : wear == 2 ? PM_NONE : 1, 0);
    }
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(4.0));
    pm_scenes_ready(&s);
    pm_ray along = pm_glows_ray(pm_vec(-0.1, 0.0, 0.0), pm_vec(1.0, 0.0, 0.0), 0.2);
    double mean = pm_glows_ask(&s, &along, 64, 20).mean;
    pm_scenes_free(&s);
    return mean;
}

static void things_between_take_their_share(void)
{
    pm_shape aside = pm_shapes_sphere(pm_vec(3.0, 0.0, 0.5), 0.3);
    pm_shape between = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.5), 0.3);
    double open = with_thing(aside, 0);
    CHECK_NEAR(with_thing(between, 0), 0.0, 0.0);          // glass: a caustic's affair
    CHECK_NEAR(with_thing(between, 1), open, 1e-4 * open); // the same fog
    double air = with_thing(between, 2);                   // no fog, and more of it
    double more = with_thing(between, 3);
    CHECK_NEAR(air, open * exp(0.4 * 0.6), 0.005 * open);
    CHECK_NEAR(more, open * exp((0.4 - 2.0) * 0.6), 0.005 * open);
}

static void lattice_parts_make_one(void)
{
    pm_scenes s;
    pm_glows_fog(&s, 0.6, 0.8, 0.0);
    pm_scenes_point(&s, pm_vec(0.3, 0.0, 1.5), pm_gray(4.0));
    pm_scenes_ready(&s);
    pm_ray along = pm_glows_ray(pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), HUGE_VAL);
    pm_direct_query all = {.world = &s.world, .samples = 100, .step = 1, .shift = {0.3, 0.7}};
    double whole = pm_single(&all, &along).c[1];
    double parts = 0.0;
    for (uint32_t first = 0; first < 4; first++) {
        pm_direct_query part = all;
        part.samples = 25;
        part.first = first;
        part.step = 4;
        parts += pm_single(&part, &along).c[1] / 4.0;
    }
    CHECK(whole > 0.0);
    CHECK_NEAR(parts, whole, 1e-13 * whole);
    pm_scenes_free(&s);
}

// --- extremes -------------------------------------------------------------------------------

static void extremes_are_numbers(void)
{
    // The light on the ray, hardly off it, at its start, behind it; all densities and lengths.
    static const double densities[5] = {0.0, 1e-300, 1e-6, 1.0, 1e6};
    static const double lengths[4] = {1e-300, 1e-9, 2.0, HUGE_VAL};
    static const double aheads[4] = {-0.5, 0.0, 1e-9, 1.0};
    static const double asides[4] = {0.0, 1e-100, 1e-17, 1e-3};
    for (int i = 0; i < 5 * 4 * 4 * 4; i++) {
        pm_scenes s;
        pm_glows_fog(&s, densities[i % 5], 0.8, 0.9);
        pm_scenes_point(&s, pm_vec(asides[i / 80], 0.0, aheads[i / 20 % 4]), pm_gray(4.0));
        pm_scenes_ready(&s);
        pm_ray along =
            pm_glows_ray(pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), lengths[i / 5 % 4]);
        for (int number = 0; number < 20; number++) {
            pm_spectrum one = pm_glows_run(&s, &along, 3, number);
            CHECK(pm_spectrum_is_finite(one) && one.c[1] >= 0.0);
            CHECK(densities[i % 5] > 0.0 || one.c[1] == 0.0);
        }
        pm_scenes_free(&s);
    }
}

static void units_cancel(void)
{
    // Lengths times 2^m, flux times 2^2m, extinction times 2^-m: the same bits.
    double first = 0.0;
    for (int m = -20; m <= 20; m += 10) {
        double unit = ldexp(1.0, m);
        pm_scenes s;
        pm_glows_fog(&s, 0.6 / unit, 0.8, 0.3);
        pm_scenes_point(&s, pm_vec(0.3 * unit, 0.0, 1.5 * unit), pm_gray(4.0 * unit * unit));
        pm_scenes_ready(&s);
        pm_ray along = pm_glows_ray(pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), 2.0 * unit);
        double one = pm_glows_run(&s, &along, 5, 0).c[1];
        first = m == -20 ? one : first;
        CHECK(one > 0.0);
        CHECK_NEAR(one, first, 0.0);
        pm_scenes_free(&s);
    }
}

PM_TESTS({"single.1", "a point light's glow in endless fog is that of the integral",
          points_in_endless_fog},
         {"single.2", "a spot's beam in endless fog is that of the integral",
          spots_in_endless_fog},
         {"single.3", "a slab under the sun glows by its closed form, however thick",
          suns_through_slabs},
         {"single.4", "where the sun is the same all along the ray there is no noise",
          level_views_have_no_noise},
         {"single.5", "glass blocks, other fog takes by its depth",
          things_between_take_their_share},
         {"single.6", "shares of one lattice add up to it", lattice_parts_make_one},
         {"single.7", "lights on the ray, no density and no length give numbers",
          extremes_are_numbers},
         {"single.8", "units cancel to the last bit", units_cancel})

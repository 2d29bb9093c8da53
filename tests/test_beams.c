// Beams against numbers that can be had by hand: the kernel, what lies behind the eye, an even
// field; and their extremes.
#include "beams.h"
#include "clouds.h"
#include "fields.h"
#include "photon_map.h"
#include "shapes.h"
#include "test.h"

#include <omp.h>

static const pm_medium fog = {.sigma_t = 0.5, .albedo = {{0.9, 0.5, 0.25}}, .g = 0.0};

static pm_ray ray_along(pm_vec3 from, pm_vec3 direction, double t_max)
{
    return (pm_ray){.origin = from, .direction = direction, .t_max = t_max};
}

/// A map of one photon of 1 W that flies down at the origin.
static pm_photon_map one_photon(void)
{
    pm_photon_map map = {.kind = PM_MAP_VOLUME, .unpacked = true};
    pm_fields_push(&map, pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, 0.0), 1.0);
    pm_fields_finish(&map);
    return map;
}

// --- one photon -----------------------------------------------------------------------------

static void the_kernel_integrates_to_one(void)
{
    static const double radii[] = {0.125, 0.3, 40.0};
    const int steps = 4000;
    pm_photon_map map = one_photon();
    pm_medium clear = {.sigma_t = 0.0, .albedo = pm_gray(1.0)};
    for (int i = 0; i < 3; i++) {
        pm_beams beams;
        CHECK_OK(pm_beams_make(NULL, &map, radii[i], 1, 0, &beams));
        double r = (double)(float)radii[i];
        double sum = 0.0;
        for (int s = 0; s < steps; s++) {
            double d = 1.2 * r * (s + 0.5) / steps;
            pm_ray ray = ray_along(pm_vec(d, 0.0, -r), pm_vec(0.0, 0.0, 1.0), 3.0 * r);
            double radiance = pm_beams_query(&beams, &clear, &ray).radiance.c[0];
            sum += 2.0 * PM_PI * d * radiance * 1.2 * r / steps;
        }
        CHECK_NEAR(sum * 4.0 * PM_PI, 1.0, 1e-6);
        pm_beams_free(&beams);
    }
    pm_photon_map_free(&map);
}

static void one_photon_by_hand(void)
{
    // Half a radius off: (1 - 1/4)^2 = 9/16. It flies down, is seen from 2 m away by a ray
    // that goes up at 60 degrees to it: light turns by the angle between down and the ray's
    // way back.
    const pm_medium milk = {.sigma_t = 0.75, .albedo = {{0.9, 0.5, 0.25}}, .g = 0.6};
    pm_photon_map map = one_photon();
    pm_beams beams;
    CHECK_OK(pm_beams_make(NULL, &map, 0.5, 1, 0, &beams));
    double cosine = 0.5;
    pm_vec3 direction = pm_vec(sqrt(0.75), 0.0, cosine);
    pm_vec3 from = pm_vec(-2.0 * direction.x, 0.25, -2.0 * direction.z);
    pm_ray ray = ray_along(from, direction, HUGE_VAL);
    pm_beam beam = pm_beams_query(&beams, &milk, &ray);
    double base = 1.0 + 0.36 - 1.2 * cosine; // down on the way back: the cosine is +1/2
    double phase = (1.0 - 0.36) / (4.0 * PM_PI * base * sqrt(base));
    double kernel = 3.0 / PM_PI * (9.0 / 16.0) / 0.25;
    for (int c = 0; c < 3; c++) {
        double want = kernel * phase * exp(-0.75 * 2.0) * milk.albedo.c[c];
        CHECK_NEAR(beam.radiance.c[c], want, 1e-12 * want);
    }
    CHECK(beam.found == 1);
    CHECK_NEAR(beam.radius, 0.5, 1e-15);
    pm_beams_free(&beams);
    pm_photon_map_free(&map);
}

static void only_what_lies_between_the_ends_counts(void)
{
    static const double places[] = {-1.0, -0.05, 0.05, 1.0, 1.95, 2.05, 3.0};
    pm_photon_map map = {.kind = PM_MAP_VOLUME, .unpacked = true};
    for (int i = 0; i < 7; i++) {
        pm_fields_push(&map, pm_vec(places[i], 0.01, 0.0), pm_vec(0.0, 0.0, 0.0), 1.0);
    }
    pm_fields_finish(&map);
    pm_beams beams;
    CHECK_OK(pm_beams_make(NULL, &map, 0.25, 1, 0, &beams));
    pm_ray ray = ray_along(pm_vec(0.0, 0.0, 0.0), pm_vec(1.0, 0.0, 0.0), 2.0);
    CHECK(pm_beams_query(&beams, &fog, &ray).found == 3);
    ray.t_max = HUGE_VAL;
    CHECK(pm_beams_query(&beams, &fog, &ray).found == 5);
    ray.origin = pm_vec(-40.0, 0.0, 0.0);
    CHECK(pm_beams_query(&beams, &fog, &ray).found == 7);
    ray.t_max = 38.0;
    CHECK(pm_beams_query(&beams, &fog, &ray).found == 0);
    ray.direction = pm_vec(-1.0, 0.0, 0.0);
    CHECK(pm_beams_query(&beams, &fog, &ray).found == 0);
    pm_beams_free(&beams);
    pm_photon_map_free(&map);
}

// --- extremes -------------------------------------------------------------------------------

static void few_photons_are_no_accident(void)
{
    pm_photon_map map = {.kind = PM_MAP_VOLUME};
    pm_beams beams;
    pm_ray ray = ray_along(pm_vec(0.0, 0.0, -1.0), pm_vec(0.0, 0.0, 1.0), HUGE_VAL);
    CHECK_OK(pm_beams_make(NULL, &map, HUGE_VAL, 100, 0, &beams));
    CHECK(pm_beams_query(&beams, &fog, &ray).found == 0);
    pm_beams_free(&beams);
    map = one_photon();
    CHECK_OK(pm_beams_make(NULL, &map, HUGE_VAL, 100, 0, &beams));
    pm_beam alone = pm_beams_query(&beams, &fog, &ray);
    CHECK(alone.found == 0 && alone.radiance.c[0] == 0.0 && alone.radius == 0.0);
    pm_beams_free(&beams);
    pm_photon_map_free(&map);
    CHECK(pm_beams_query(&(pm_beams){0}, &fog, &ray).found == 0);
}

static void coincident_photons_stay_finite(void)
{
    static const double places[] = {0.0, 0.75, 1e-30};
    for (int i = 0; i < 3; i++) {
        pm_photon_map map = {.kind = PM_MAP_VOLUME, .unpacked = true};
        for (int n = 0; n < 40; n++) {
            pm_fields_push(&map, pm_vec(0.0, 0.0, places[i]), pm_vec(0.0, 0.0, 0.0), 1.0);
        }
        pm_fields_push(&map, pm_vec(0.0, 2.0, 0.0), pm_vec(0.0, 0.0, 0.0), 1.0);
        pm_fields_finish(&map);
        pm_beams beams;
        CHECK_OK(pm_beams_make(NULL, &map, HUGE_VAL, 9, 0, &beams));
        double x = (double)(float)places[i];
        pm_ray ray = ray_along(pm_vec(-1.0, 0.0, x), pm_vec(1.0, 0.0, 0.0), 3.0);
        pm_beam beam = pm_beams_query(&beams, &fog, &ray);
        CHECK(beam.found == 40 || beam.found == 41);
        CHECK(isfinite(beam.radiance.c[0]) && beam.radiance.c[0] > 0.0);
        pm_beams_free(&beams);
        pm_photon_map_free(&map);
    }
}

/// One query in a cloud of lengths times `f`, powers times f^2.
static pm_beam ask_scaled(double f)
{
    pm_photon_map map = {.kind = PM_MAP_VOLUME};
    for (uint64_t i = 0; i < 500; i++) {
        pm_vec3 at = pm_vec_scale(pm_cloud_query(i), f);
        pm_fields_push(&map, at, pm_vec(0.0, 0.0, 0.0), f * f);
    }
    pm_fields_finish(&map);
    pm_medium medium = fog;
    medium.sigma_t /= f;
    pm_vec3 direction = pm_vec_normalize(pm_vec(0.7, 0.5, 0.3));
    pm_ray ray = ray_along(pm_vec_scale(pm_vec(0.1, 0.2, 0.3), f), direction, 0.8 * f);
    pm_beams beams;
    CHECK_OK(pm_beams_make(NULL, &map, HUGE_VAL, 100, 0, &beams));
    pm_beam beam = pm_beams_query(&beams, &medium, &ray);
    pm_beams_free(&beams);
    pm_photon_map_free(&map);
    return beam;
}

static void the_size_of_the_world_is_no_matter(void)
{
    pm_beam want = ask_scaled(1.0);
    CHECK(want.found > 10);
    for (int e = -20; e <= 20; e += 20) {
        pm_beam got = ask_scaled(ldexp(1.0, e));
        CHECK(got.found == want.found);
        CHECK(got.radiance.c[1] == want.radiance.c[1]);
        CHECK(got.radius == ldexp(want.radius, e));
    }
    pm_beam huge = ask_scaled(0x1p80); // where squares leave the range of a float
    CHECK(huge.found == want.found && isfinite(huge.radiance.c[0]));
}

static void threads_make_no_difference(void)
{
    pm_photon_map map = pm_cloud_make(PM_CLOUD_RANDOM, 3000, 1.0, true);
    map.kind = PM_MAP_VOLUME;
    for (uint32_t i = 0; i < map.count; i += 3) {
        map.photons[i].flags |= PM_PHOTON_FIRST;
    }
    pm_fields_finish(&map);
    pm_beams one;
    pm_beams three;
    omp_set_num_threads(1);
    CHECK_OK(pm_beams_make(NULL, &map, HUGE_VAL, 100, PM_PHOTON_FIRST, &one));
    omp_set_num_threads(3);
    CHECK_OK(pm_beams_make(NULL, &map, HUGE_VAL, 100, PM_PHOTON_FIRST, &three));
    CHECK(one.count == 2000 && three.count == 2000);
    for (uint32_t i = 0; i < 2000; i++) {
        const pm_beam_leaf *a = &one.leaf[i / PM_BEAMS_LEAF];
        const pm_beam_leaf *b = &three.leaf[i / PM_BEAMS_LEAF];
        CHECK(a->radius[i % PM_BEAMS_LEAF] == b->radius[i % PM_BEAMS_LEAF]);
        CHECK(a->at[0][i % PM_BEAMS_LEAF] == b->at[0][i % PM_BEAMS_LEAF]);
        CHECK(one.light[i].power[0] == three.light[i].power[0]);
    }
    pm_beams_free(&one);
    pm_beams_free(&three);
    pm_photon_map_free(&map);
}

// --- even fields ----------------------------------------------------------------------------

enum { EVEN = 1000 };

/// EVEN photons of 1 W at random in a cube of half side 1.5, seen along 2 m in its middle.
static pm_moments ask_even(double radius, uint32_t k, int trials)
{
    pm_ray ray = ray_along(pm_vec(-1.0, 0.1, 0.0), pm_vec(1.0, 0.0, 0.0), 2.0);
    double sum = 0.0;
    double sum2 = 0.0;
    omp_set_num_threads(1); // the runner keeps the other cores busy
    for (int t = 0; t < trials; t++) {
        pm_rng rng = pm_shapes_rng((uint64_t)t, 5);
        pm_photon_map map = {.kind = PM_MAP_VOLUME, .unpacked = true};
        for (int i = 0; i < EVEN; i++) {
            pm_fields_push(&map, pm_shapes_inside(&rng, 1.5), pm_vec(0.0, 0.0, 0.0), 1.0);
        }
        pm_fields_finish(&map);
        pm_beams beams;
        CHECK_OK(pm_beams_make(NULL, &map, radius, k, 0, &beams));
        double value = pm_beams_query(&beams, &fog, &ray).radiance.c[0];
        sum += value;
        sum2 += value * value;
        pm_beams_free(&beams);
        pm_photon_map_free(&map);
    }
    return pm_fields_moments(sum, sum2, trials);
}

static void an_even_field_has_its_radiance(void)
{
    // density times albedo times phase times the integral of exp(-sigma t); the kernel's square
    // integrates to 9 / (5 pi r^2), and EVEN photons scatter less than an endless number would.
    const int trials = 200;
    const double radius = 0.3;
    double density = EVEN / 27.0;
    double each = fog.albedo.c[0] / (4.0 * PM_PI);
    double mean = density * each * (1.0 - exp(-fog.sigma_t * 2.0)) / fog.sigma_t;
    double squares = (1.0 - exp(-2.0 * fog.sigma_t * 2.0)) / (2.0 * fog.sigma_t);
    double variance = density * each * each * 9.0 / (5.0 * PM_PI * radius * radius) * squares -
                      mean * mean / EVEN;
    pm_moments fixed = ask_even(radius, 1, trials);
    CHECK_NEAR(fixed.mean, mean, 5.0 * sqrt(variance / trials));
    CHECK_NEAR(fixed.sd / sqrt(variance), 1.0, 5.0 / sqrt(2.0 * trials));
    // Radii by neighbours keep the mean for any k: no photon is left out, no factor is due.
    pm_moments few = ask_even(HUGE_VAL, 4, 60);
    CHECK_NEAR(few.mean, mean, 5.0 * few.sd / sqrt(60));
    pm_moments many = ask_even(HUGE_VAL, 49, 60);
    CHECK_NEAR(many.mean, mean, 5.0 * many.sd / sqrt(60));
}

// --- refusals -------------------------------------------------------------------------------

static void wrong_maps_and_radii_are_refused(void)
{
    pm_photon_map map = one_photon();
    pm_beams beams = {0};
    CHECK_FAILS(pm_beams_make(NULL, &map, 0.0, 1, 0, &beams), PM_EINPUT,
                "a beam's radius must be > 0 as a float, got 0");
    CHECK_FAILS(pm_beams_make(NULL, &map, (double)NAN, 1, 0, &beams), PM_EINPUT, "got nan");
    CHECK_FAILS(pm_beams_make(NULL, &map, 1e-60, 1, 0, &beams), PM_EINPUT, "got 1e-60");
    CHECK_FAILS(pm_beams_make(NULL, &map, HUGE_VAL, 0, 0, &beams), PM_EINPUT,
                "k must be at least 1, got 0");
    map.kind = PM_MAP_GLOBAL;
    CHECK_FAILS(pm_beams_make(NULL, &map, 1.0, 1, 0, &beams), PM_EINPUT,
                "beams are made from a volume map");
    map.kind = PM_MAP_VOLUME;
    map.balanced = false;
    CHECK_FAILS(pm_beams_make(NULL, &map, 1.0, 1, 0, &beams), PM_EINPUT,
                "must be balanced and scaled");
    CHECK(beams.node == NULL && beams.levels == 0);
    pm_photon_map_free(&map);
}

PM_TESTS({"beams.1", "a photon's kernel integrates to 1 over the disc, for any radius",
          the_kernel_integrates_to_one},
         {"beams.2", "one photon brings its power, kernel, phase, albedo and what gets through",
          one_photon_by_hand},
         {"beams.3", "photons behind the eye or beyond the ray's end do not count",
          only_what_lies_between_the_ends_counts},
         {"beams.4", "no photon and a single one give no light", few_photons_are_no_accident},
         {"beams.5", "photons in one place give finite light", coincident_photons_stay_finite},
         {"beams.6", "lengths times a power of two leave the bytes as they are",
          the_size_of_the_world_is_no_matter},
         {"beams.7", "beams are the same for any number of threads",
          threads_make_no_difference},
         {"beams.8", "an even field has its radiance and its noise, for any k",
          an_even_field_has_its_radiance},
         {"beams.9", "wrong maps, radii and k are refused with the rule",
          wrong_maps_and_radii_are_refused})

// The march of balls along a ray: against an even field of known radiance, against a fine
// quadrature of the same estimates, and at its edges.
#include "media.h"

#include "fields.h"
#include "medium.h"
#include "photon_map.h"
#include "render.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <string.h>

enum { EVEN = 1000, ROOM = 1200 };

static const pm_medium fog = {.sigma_t = 0.5, .albedo = {{0.9, 0.5, 0.25}}, .g = 0.0};

/// A march over `map`, of k neighbours or of all within a radius.
static pm_march march_over(const pm_photon_map *map, double radius, uint32_t k, double step,
                           pm_neighbour *scratch)
{
    pm_march march = {.map = map, .step = step, .scratch = scratch};
    march.estimate = pm_estimate_defaults();
    march.estimate.k = k;
    march.estimate.radius = radius;
    pm_photon_map_box(map, &march.low, &march.high);
    CHECK(k <= ROOM);
    return march;
}

static double go(const pm_march *march, const pm_medium *medium, const pm_ray *ray,
                 uint64_t jitter)
{
    pm_rng rng = pm_shapes_rng(jitter, 9);
    pm_spectrum radiance;
    CHECK_OK(pm_media_march(march, medium, ray, &rng, &radiance));
    return radiance.c[0];
}

/// EVEN photons of 1 W at random in a cube of half side 1.5 times `f`.
static pm_photon_map even_field(uint64_t trial, double f)
{
    pm_rng rng = pm_shapes_rng(trial, 5);
    pm_photon_map map = {.kind = PM_MAP_VOLUME, .unpacked = true};
    for (int i = 0; i < EVEN; i++) {
        pm_vec3 at = pm_vec_scale(pm_shapes_inside(&rng, 1.5), f);
        pm_fields_push(&map, at, pm_vec(0.0, 0.0, 0.0), 1.0);
    }
    pm_fields_finish(&map);
    return map;
}

/// Along 1.6 m in the middle.
static pm_ray inner_ray(void)
{
    return (pm_ray){.origin = pm_vec(-0.8, 0.1, 0.0),
                    .direction = pm_vec(1.0, 0.0, 0.0),
                    .t_max = 1.6,
                    .medium = 0};
}

// --- even fields ----------------------------------------------------------------------------

/// Lengths times `f`, the medium as thick.
static pm_moments ask_even(double radius, uint32_t k, double f, int trials)
{
    pm_neighbour scratch[ROOM];
    pm_medium medium = fog;
    medium.sigma_t /= f;
    pm_ray ray = inner_ray();
    ray.origin = pm_vec_scale(ray.origin, f);
    ray.t_max *= f;
    double sum = 0.0;
    double sum2 = 0.0;
    for (int t = 0; t < trials; t++) {
        pm_photon_map map = even_field((uint64_t)t, f);
        pm_march march = march_over(&map, radius * f, k, 0.2 * f, scratch);
        double value = go(&march, &medium, &ray, (uint64_t)t);
        sum += value;
        sum2 += value * value;
        pm_photon_map_free(&map);
    }
    return pm_fields_moments(sum, sum2, trials);
}

static double even_radiance(void)
{
    double length = inner_ray().t_max;
    double density = EVEN / 27.0;
    return density * fog.albedo.c[0] / (4.0 * PM_PI) * (1.0 - exp(-fog.sigma_t * length)) /
           fog.sigma_t;
}

static void an_even_field_has_its_radiance(void)
{
    // All photons in the ball; the k nearest, one left out; few in a short reach.
    static const double radius[] = {0.4, HUGE_VAL, 0.25};
    static const uint32_t k[] = {ROOM, 12, 4};
    for (int i = 0; i < 3; i++) {
        pm_moments got = ask_even(radius[i], k[i], 1.0, 120);
        CHECK_NEAR(got.mean, even_radiance(), 5.0 * got.sd / sqrt(120));
        CHECK(got.sd < 0.5 * got.mean);
    }
}

static void lengths_count_as_cubes(void)
{
    // The same photons in a room four times as large: per square metre a sixteenth.
    pm_moments small = ask_even(0.4, ROOM, 1.0, 5);
    pm_moments large = ask_even(0.4, ROOM, 4.0, 5);
    CHECK(large.mean * 16.0 == small.mean);
}

static void a_channel_goes_by_its_albedo(void)
{
    pm_neighbour scratch[ROOM];
    pm_photon_map map = even_field(1, 1.0);
    pm_march march = march_over(&map, 0.4, ROOM, 0.2, scratch);
    pm_ray ray = inner_ray();
    pm_rng rng = pm_shapes_rng(1, 9);
    pm_spectrum got;
    CHECK_OK(pm_media_march(&march, &fog, &ray, &rng, &got));
    CHECK(got.c[0] > 0.0);
    for (int c = 1; c < 3; c++) {
        double share = fog.albedo.c[c] / fog.albedo.c[0];
        CHECK_NEAR(got.c[c], got.c[0] * share, 1e-12 * got.c[c]);
    }
    pm_photon_map_free(&map);
}

// --- steps ----------------------------------------------------------------------------------

/// The integral that the march samples, by many steps without chance.
static double integral(const pm_march *march, const pm_medium *medium, const pm_ray *ray)
{
    const int steps = 20000;
    double sum = 0.0;
    for (int i = 0; i < steps; i++) {
        double t = ray->t_max * (i + 0.5) / steps;
        pm_vec3 at = pm_vec_along(ray->origin, ray->direction, t);
        pm_estimate estimate;
        CHECK_OK(pm_estimate_volume(march->map, &march->estimate, at, medium,
                                    pm_vec_negate(ray->direction), march->scratch, &estimate));
        sum += estimate.value.c[0] * exp(-medium->sigma_t * t) * ray->t_max / steps;
    }
    return sum;
}

/// Mean and scatter of marches that differ in chance alone.
static pm_moments jittered(pm_march *march, const pm_medium *medium, double step, int runs)
{
    pm_ray ray = inner_ray();
    double sum = 0.0;
    double sum2 = 0.0;
    march->step = step;
    for (int i = 0; i < runs; i++) {
        double value = go(march, medium, &ray, (uint64_t)i);
        sum += value;
        sum2 += value * value;
    }
    return pm_fields_moments(sum, sum2, runs);
}

static void no_step_is_biased(void)
{
    // Thick, so that places at the ends of steps would be off by far.
    const pm_medium thick = {.sigma_t = 3.0, .albedo = pm_gray(1.0), .g = 0.6};
    pm_neighbour scratch[ROOM];
    pm_photon_map map = even_field(3, 1.0);
    pm_march march = march_over(&map, 0.4, ROOM, 1.0, scratch);
    pm_ray ray = inner_ray();
    double want = integral(&march, &thick, &ray);
    pm_moments coarse = jittered(&march, &thick, 0.7, 400);
    CHECK_NEAR(coarse.mean, want, 5.0 * coarse.sd / 20.0);
    double before = HUGE_VAL;
    // 1.6 m are no whole number of these.
    for (int i = 0; i < 4; i++) {
        double step = ldexp(0.23, -i);
        pm_moments got = jittered(&march, &thick, step, 400);
        CHECK_NEAR(got.mean, want, 5.0 * got.sd / 20.0);
        CHECK_THAT(got.sd < 0.6 * before, "step %g: %g after %g", step, got.sd, before);
        before = got.sd;
    }
    pm_photon_map_free(&map);
}

static void a_step_by_default_fits_both_rules(void)
{
    pm_march march = {.low = pm_vec(-1.0, -1.0, 0.0), .high = pm_vec(1.0, 3.0, 0.5)};
    pm_medium medium = {.sigma_t = 2.0};
    CHECK(pm_media_step(&march, &medium) == 0.1);
    medium.sigma_t = 20.0;
    CHECK(pm_media_step(&march, &medium) == 0.025);
    medium.sigma_t = 0.0;
    CHECK(pm_media_step(&march, &medium) == 0.1);
}

// --- ends -----------------------------------------------------------------------------------

/// A ball of photons of radius 0.1 around 1, 0, 0.
static pm_photon_map clump(void)
{
    pm_photon_map map = {.kind = PM_MAP_VOLUME, .unpacked = true};
    for (uint64_t i = 0; i < 200; i++) {
        pm_rng rng = pm_shapes_rng(i, 6);
        pm_vec3 at = pm_vec_scale(pm_shapes_direction(&rng), 0.1 * pm_rng_draw(&rng));
        at.x += 1.0;
        pm_fields_push(&map, at, pm_vec(0.0, 0.0, 0.0), 1.0);
    }
    pm_fields_finish(&map);
    return map;
}

static void it_runs_where_photons_are_in_reach(void)
{
    pm_neighbour scratch[ROOM];
    pm_photon_map map = clump();
    pm_march march = march_over(&map, 0.2, ROOM, 0.01, scratch);
    pm_ray ray = {.direction = pm_vec(1.0, 0.0, 0.0), .t_max = HUGE_VAL};
    double whole = go(&march, &fog, &ray, 1);
    CHECK(isfinite(whole) && whole > 0.0);
    // All within 0.31 of the middle: a ray that ends behind it, or begins before, sees all.
    ray.t_max = 1.5;
    double cut = go(&march, &fog, &ray, 1);
    CHECK_NEAR(cut, whole, 1e-12 * whole);
    ray.t_max = 0.65;
    CHECK(go(&march, &fog, &ray, 1) == 0.0);
    ray.t_max = HUGE_VAL;
    ray.direction = pm_vec(-1.0, 0.0, 0.0);
    CHECK(go(&march, &fog, &ray, 1) == 0.0);
    ray.direction = pm_vec(0.0, 1.0, 0.0);
    CHECK(go(&march, &fog, &ray, 1) == 0.0);
    pm_photon_map_free(&map);
}

static void steps_on_the_way_to_photons_are_no_work(void)
{
    // One draw a step: 0.6 m of box and reach, though the clump is 1 km away.
    pm_neighbour scratch[ROOM];
    pm_photon_map map = clump();
    pm_march march = march_over(&map, 0.2, ROOM, 0.1, scratch);
    pm_ray ray = {.origin = pm_vec(-1000.0, 0.0, 0.0),
                  .direction = pm_vec(1.0, 0.0, 0.0),
                  .t_max = HUGE_VAL};
    pm_rng rng = pm_shapes_rng(1, 9);
    pm_rng after = rng;
    pm_spectrum radiance;
    CHECK_OK(pm_media_march(&march, &fog, &ray, &rng, &radiance));
    int draws = 0;
    while (memcmp(&after, &rng, sizeof rng) != 0 && draws < 100) {
        (void)pm_rng_draw(&after);
        draws++;
    }
    CHECK(draws == 6);
    pm_photon_map_free(&map);
}

static void photons_of_marks_to_skip_are_skipped(void)
{
    pm_neighbour scratch[ROOM];
    pm_photon_map map = clump();
    pm_march march = march_over(&map, 0.4, ROOM, 0.05, scratch);
    pm_ray ray = {.direction = pm_vec(1.0, 0.0, 0.0), .t_max = HUGE_VAL};
    double all = go(&march, &fog, &ray, 1);
    for (uint32_t i = 0; i < map.count; i++) {
        map.photons[i].flags |= PM_PHOTON_FIRST;
    }
    CHECK(go(&march, &fog, &ray, 1) == all);
    march.estimate.skip = PM_PHOTON_FIRST;
    CHECK(go(&march, &fog, &ray, 1) == 0.0);
    march.estimate.skip = PM_PHOTON_CAUSTIC;
    march.estimate.only = PM_PHOTON_FIRST;
    CHECK(go(&march, &fog, &ray, 1) == all);
    pm_photon_map_free(&map);
}

/// Photons within reach belong to a medium beside that scatters.
static void a_clear_medium_takes_no_photons(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_medium(&s, 0.0, pm_gray(0.9), 0.0);
    pm_scenes_medium(&s, 2.0, pm_gray(0.0), 0.0);
    pm_scenes_medium(&s, 2.0, pm_gray(0.9), 0.0);
    pm_scenes_ready(&s);
    pm_photon_map map = even_field(3, 1.0);
    pm_neighbour scratch[ROOM];
    pm_compose compose = {.world = &s.world};
    pm_gather gather = {.map[PM_MAP_VOLUME] = &map, .scratch = scratch};
    gather.settings = pm_render_defaults().light;
    gather.settings.media = PM_MEDIA_MARCH;
    pm_gather_sources(&gather, &compose);
    for (int medium = 0; medium < 3; medium++) {
        pm_stretch along = {.ray = inner_ray()};
        along.ray.medium = medium;
        pm_spectrum radiance;
        CHECK_OK(pm_media_seen(&gather, &along, &radiance));
        CHECK(pm_spectrum_is_black(radiance) == (medium < 2));
    }
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

static void steps_without_end_are_refused(void)
{
    pm_photon_map map = clump();
    pm_neighbour scratch[ROOM];
    pm_march march = march_over(&map, 0.2, ROOM, 0.0, scratch);
    pm_ray ray = inner_ray();
    pm_rng rng = pm_shapes_rng(0, 0);
    pm_spectrum radiance;
    CHECK_FAILS(pm_media_march(&march, &fog, &ray, &rng, &radiance), PM_EINPUT,
                "a march's step must be > 0, got 0");
    march.step = (double)NAN;
    CHECK_FAILS(pm_media_march(&march, &fog, &ray, &rng, &radiance), PM_EINPUT, "got nan");
    march.step = 1e-12;
    CHECK_FAILS(pm_media_march(&march, &fog, &ray, &rng, &radiance), PM_ELIMIT,
                "at most 2^32 - 1");
    pm_photon_map_free(&map);
}

PM_TESTS({"media_march.1", "an even field has its radiance, by a radius, by k or by both",
          an_even_field_has_its_radiance},
         {"media_march.2", "a room four times as large is a sixteenth as bright",
          lengths_count_as_cubes},
         {"media_march.3", "each channel goes by the albedo", a_channel_goes_by_its_albedo},
         {"media_march.4", "no step is biased, and halving it takes noise away",
          no_step_is_biased},
         {"media_march.5", "the step is half a free path, or a fortieth of the photons' box",
          a_step_by_default_fits_both_rules},
         {"media_march.6", "the march ends where no photon is in reach",
          it_runs_where_photons_are_in_reach},
         {"media_march.7", "it begins there, too", steps_on_the_way_to_photons_are_no_work},
         {"media_march.8", "marks leave photons out", photons_of_marks_to_skip_are_skipped},
         {"media_march.9", "steps of no length and steps without end are refused",
          steps_without_end_are_refused},
         {"media_march.10", "a medium that scatters nothing takes no photons of its neighbour",
          a_clear_medium_takes_no_photons})

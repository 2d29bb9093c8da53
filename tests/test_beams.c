// Beams against a sum over all photons that knows nothing of boxes, and against numbers that
// can be had by hand: the kernel, what lies behind the eye, an even field.
#include "beams.h"
#include "clouds.h"
#include "fields.h"
#include "medium.h"
#include "photon_map.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

#include <omp.h>
#include <stdlib.h>

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

// --- all photons, one by one ----------------------------------------------------------------

/// Distances to all others that are kept, sorted; the `n`-th.
static int by_size(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return x < y ? -1 : x > y ? 1 : 0;
}

static pm_vec3 position_of(const pm_photon_map *map, uint32_t i)
{
    return pm_store_unpack(map, i).position;
}

static bool is_kept(const pm_photon_map *map, uint32_t i)
{
    return (map->photons[i].flags & PM_PHOTON_FIRST) == 0;
}

static double nth_distance(const pm_photon_map *map, uint32_t of, uint32_t n)
{
    double *all = calloc(map->count, sizeof *all);
    uint32_t count = 0;
    for (uint32_t i = 0; i < map->count; i++) {
        if (i != of && is_kept(map, i)) {
            all[count++] = pm_vec_length(pm_vec_sub(position_of(map, i), position_of(map, of)));
        }
    }
    qsort(all, count, sizeof *all, by_size);
    double distance = all[n - 1];
    free(all);
    return distance;
}

/// The radii of the contract; 0 of photons that do not count.
static void radii_of(const pm_photon_map *map, double radius, uint32_t k, double *radii)
{
    uint32_t kept = 0;
    for (uint32_t i = 0; i < map->count; i++) {
        kept += is_kept(map, i) ? 1 : 0;
    }
    uint32_t others = kept > 0 ? kept - 1 : 0;
    uint32_t n = (uint32_t)lround(sqrt(k < others ? k : others));
    for (uint32_t i = 0; i < map->count; i++) {
        double reach = pm_vec_reach(position_of(map, i));
        double least = (double)nextafterf((float)reach, INFINITY) - reach;
        bool counts = is_kept(map, i) && (isfinite(radius) || n > 0);
        double own = !counts            ? 0.0
                     : isfinite(radius) ? radius
                                        : fmax(nth_distance(map, i, n), least);
        radii[i] = (double)(float)own;
    }
}

static pm_beam sum_all(const pm_photon_map *map, const double *radii, const pm_medium *medium,
                       const pm_ray *along)
{
    pm_beam beam = {0};
    for (uint32_t i = 0; i < map->count; i++) {
        pm_photon_view photon = pm_store_unpack(map, i);
        double t = pm_vec_dot(pm_vec_sub(photon.position, along->origin), along->direction);
        pm_vec3 nearest = pm_vec_along(along->origin, along->direction, t);
        double d = pm_vec_length(pm_vec_sub(photon.position, nearest));
        if (!(t > 0.0 && t < along->t_max && d < radii[i])) {
            continue;
        }
        double u = d * d / (radii[i] * radii[i]);
        double kernel = 3.0 / PM_PI * (1.0 - u) * (1.0 - u) / (radii[i] * radii[i]);
        double cosine = -pm_vec_dot(photon.direction, along->direction);
        double weight =
            kernel * pm_medium_phase(medium, cosine) * pm_medium_transmittance(medium, t);
        pm_spectrum light = pm_spectrum_mul(photon.power, medium->albedo);
        beam.radiance = pm_spectrum_add(beam.radiance, pm_spectrum_scale(light, weight));
        beam.found++;
        beam.radius += radii[i];
    }
    beam.radius /= beam.found > 0 ? beam.found : 1;
    return beam;
}

/// A cloud whose every third photon came straight from a light.
static pm_photon_map make_cloud(pm_cloud_kind kind, uint32_t count)
{
    pm_photon_map map = pm_cloud_make(kind, count, 1.0, count % 2 == 0);
    map.kind = PM_MAP_VOLUME;
    for (uint32_t i = 0; i < count; i += 3) {
        map.photons[i].flags |= PM_PHOTON_FIRST;
    }
    CHECK_OK(pm_store_scale(&map, 7));
    CHECK_OK(pm_balance_build(&map));
    return map;
}

/// Rays from inside and outside; every fourth along an axis, every third one long.
static pm_ray some_ray(uint64_t i)
{
    pm_rng rng = pm_shapes_rng(i, 3);
    pm_vec3 from = pm_vec_add(pm_shapes_inside(&rng, 1.0), pm_vec(0.5, 0.5, 0.5));
    pm_vec3 direction = pm_shapes_direction(&rng);
    double length = 2.0 * pm_rng_draw(&rng);
    if (i % 4 == 0) {
        double way = i % 8 == 0 ? 1.0 : -1.0;
        direction = i % 3 == 0   ? pm_vec(way, 0.0, 0.0)
                    : i % 3 == 1 ? pm_vec(0.0, way, -0.0)
                                 : pm_vec(-0.0, 0.0, way);
    } else if (i % 2 == 0) {
        pm_vec3 centre = pm_vec(0.5, 0.5, 0.5);
        direction = pm_vec_normalize(pm_vec_sub(centre, from));
    }
    return ray_along(from, direction, i % 3 == 0 ? HUGE_VAL : length);
}

static void check_cloud(pm_cloud_kind kind, uint32_t count, double radius, uint32_t k,
                        uint64_t rays)
{
    pm_medium medium = fog;
    medium.g = count % 2 == 0 ? 0.6 : 0.0;
    pm_photon_map map = make_cloud(kind, count);
    double *radii = calloc((size_t)count + 1, sizeof *radii);
    radii_of(&map, radius, k, radii);
    pm_beams beams;
    CHECK_OK(pm_beams_make(NULL, &map, radius, k, PM_PHOTON_FIRST, &beams));
    for (uint64_t i = 0; i < rays; i++) {
        pm_ray ray = some_ray(i);
        pm_beam got = pm_beams_query(&beams, &medium, &ray);
        pm_beam want = sum_all(&map, radii, &medium, &ray);
        CHECK_THAT(got.found == want.found, "%u photons (%s), ray %d: found %u, not %u", count,
                   pm_cloud_name(kind), (int)i, got.found, want.found);
        CHECK_NEAR(got.radius, want.radius, 1e-7 * want.radius);
        for (int c = 0; c < 3; c++) {
            CHECK_NEAR(got.radiance.c[c], want.radiance.c[c], 3e-6 * want.radiance.c[c]);
        }
    }
    pm_beams_free(&beams);
    pm_photon_map_free(&map);
    free(radii);
}

static void small_trees_lose_no_photon(void)
{
    for (uint32_t count = 0; count <= 64; count++) {
        check_cloud(PM_CLOUD_RANDOM, count, HUGE_VAL, 100, 40);
        check_cloud(PM_CLOUD_RANDOM, count, 0.2, 100, 40);
        check_cloud(PM_CLOUD_RANDOM, count, HUGE_VAL, 1, 40);
    }
}

static void large_trees_lose_no_photon(void)
{
    check_cloud(PM_CLOUD_RANDOM, 4000, 0.03, 1, 200);
    check_cloud(PM_CLOUD_RANDOM, 1025, HUGE_VAL, 100, 200);
    check_cloud(PM_CLOUD_RANDOM, 700, 1000.0, 1, 50);
    check_cloud(PM_CLOUD_RANDOM, 700, 1e-9, 1, 50);
}

static void awkward_clouds_lose_no_photon(void)
{
    for (pm_cloud_kind kind = 0; kind < PM_CLOUD_COUNT; kind++) {
        check_cloud(kind, 300, 0.1, 50, 100);
        check_cloud(kind, 301, HUGE_VAL, 50, 100);
    }
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
    pm_ray ray = some_ray(2);
    ray.origin = pm_vec_scale(ray.origin, f);
    ray.t_max *= f;
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
    pm_photon_map map = make_cloud(PM_CLOUD_RANDOM, 3000);
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
    CHECK_FAILS(pm_beams_make(NULL, &map, NAN, 1, 0, &beams), PM_EINPUT, "got nan");
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
         {"beams.4", "maps of 0 to 64 photons are summed as one by one",
          small_trees_lose_no_photon},
         {"beams.5", "maps of thousands, and of very large and small balls, too",
          large_trees_lose_no_photon},
         {"beams.6", "photons on lines, planes, lattices or one place, too",
          awkward_clouds_lose_no_photon},
         {"beams.7", "no photon and a single one give no light", few_photons_are_no_accident},
         {"beams.8", "photons in one place give finite light", coincident_photons_stay_finite},
         {"beams.9", "lengths times a power of two leave the bytes as they are",
          the_size_of_the_world_is_no_matter},
         {"beams.10", "beams are the same for any number of threads",
          threads_make_no_difference},
         {"beams.11", "an even field has its radiance and its noise, for any k",
          an_even_field_has_its_radiance},
         {"beams.12", "wrong maps, radii and k are refused with the rule",
          wrong_maps_and_radii_are_refused})

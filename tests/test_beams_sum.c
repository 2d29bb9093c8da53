// Beams against a sum over all photons that knows nothing of boxes: the same photons count, by
// the same radii, in any cloud and tree.
#include "beams.h"

#include "clouds.h"
#include "medium.h"
#include "photon_map.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

#include <stdlib.h>

static const pm_medium fog = {.sigma_t = 0.5, .albedo = {{0.9, 0.5, 0.25}}, .g = 0.0};

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
    return (pm_ray){
        .origin = from,
        .direction = direction,
        .t_max = i % 3 == 0 ? HUGE_VAL : length,
    };
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

PM_TESTS({"beams_sum.1", "maps of 0 to 64 photons are summed as one by one",
          small_trees_lose_no_photon},
         {"beams_sum.2", "maps of thousands, and of very large and small balls, too",
          large_trees_lose_no_photon},
         {"beams_sum.3", "photons on lines, planes, lattices or one place, too",
          awkward_clouds_lose_no_photon})

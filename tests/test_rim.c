// Where media end: planes beside places, and what beams and march make of them. Along a wall an
// even field is as bright as in the middle, behind a wall nothing of it is seen.
#include "rim.h"

#include "beams.h"
#include "fields.h"
#include "media.h"
#include "photon_map.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <omp.h>

enum { EVEN = 1000, ROOM = 1200 };

static const pm_medium fog = {.sigma_t = 0.5, .albedo = {{0.8, 0.8, 0.8}}, .g = 0.0};

// --- planes ---------------------------------------------------------------------------------

/// A floor at z = 0 (a wall, a null surface, or the end of a medium), tilted about y.
static void floor_scene(pm_scenes *s, double tilt, bool null, bool parts)
{
    *s = (pm_scenes){0};
    pm_scenes_begin(s);
    pm_vec3 edge = pm_vec(20.0 * cos(tilt), 0.0, 20.0 * sin(tilt));
    pm_shape floor = pm_shapes_rectangle(pm_vec(-0.5 * edge.x, -10.0, -0.5 * edge.z), edge,
                                         pm_vec(0.0, 20.0, 0.0));
    if (parts) {
        pm_scenes_bound(s, floor, pm_scenes_medium(s, 1.0, pm_gray(1.0), 0.0), PM_NONE);
    } else {
        pm_scenes_wear(s, floor, null ? pm_scenes_null(s) : pm_scenes_diffuse(s, pm_gray(0.5)));
    }
    pm_scenes_point(s, pm_vec(0.0, 0.0, 3.0), pm_gray(1.0));
    pm_scenes_ready(s);
}

static void a_plane_is_found_at_any_tilt(void)
{
    for (int i = 0; i < 12; i++) {
        double tilt = 0.13 * i;
        pm_scenes s;
        floor_scene(&s, tilt, false, false);
        for (int side = -1; side <= 1; side += 2) {
            pm_vec3 up = pm_vec(-sin(tilt) * side, 0.0, cos(tilt) * side);
            pm_vec3 at = pm_vec_scale(up, 0.3);
            pm_rim rim = pm_rim_find(&s.world, at, 0.31);
            CHECK_NEAR((double)rim.distance, 0.3, 1e-6);
            CHECK_NEAR((double)rim.normal[0], -up.x, 1e-6);
            CHECK_NEAR((double)rim.normal[2], -up.z, 1e-6);
            CHECK(pm_rim_is_before(&rim, up));
            CHECK(pm_rim_is_before(&rim, pm_vec_scale(up, -0.29)));
            CHECK(!pm_rim_is_before(&rim, pm_vec_scale(up, -0.31)));
            CHECK(isinf(pm_rim_find(&s.world, at, 0.29).distance));
        }
        pm_scenes_free(&s);
    }
}

static void only_ends_of_media_are_planes(void)
{
    pm_vec3 at = pm_vec(0.0, 0.0, 0.25);
    pm_scenes s;
    floor_scene(&s, 0.0, true, false);
    CHECK(isinf(pm_rim_find(&s.world, at, 1.0).distance));
    pm_scenes_free(&s);
    floor_scene(&s, 0.0, false, true);
    CHECK(pm_rim_find(&s.world, at, 1.0).distance == 0.25f);
    s.shapes[0].exterior = s.shapes[0].interior;
    CHECK(isinf(pm_rim_find(&s.world, at, 1.0).distance));
    pm_scenes_free(&s);
    CHECK(isinf(pm_rim_find(NULL, at, 1.0).distance));
}

static void a_wall_behind_a_null_surface_is_found(void)
{
    pm_scenes s = {0};
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(4.0, 0.5, false), pm_scenes_null(&s));
    pm_scenes_wear(&s, pm_scenes_square(4.0, 0.0, false), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 3.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_rim rim = pm_rim_find(&s.world, pm_vec(0.0, 0.0, 0.75), 1.0);
    CHECK_NEAR((double)rim.distance, 0.75, 1e-4);
    CHECK(isinf(pm_rim_find(&s.world, pm_vec(0.0, 0.0, 0.75), 0.7).distance));
    pm_scenes_free(&s);
}

// --- even fields ----------------------------------------------------------------------------

/// EVEN photons of 1 W in the cube of half side 1.5, but none below `floor`.
static pm_photon_map even_field(uint64_t trial, double floor)
{
    pm_photon_map map = {.kind = PM_MAP_VOLUME, .unpacked = true};
    pm_rng rng = pm_shapes_rng(trial, 5);
    for (int i = 0; i < EVEN; i++) {
        pm_vec3 at = pm_shapes_inside(&rng, 1.5);
        if (at.z > floor) {
            pm_fields_push(&map, at, pm_vec(0.0, 0.0, 0.0), 1.0);
        }
    }
    pm_fields_finish(&map);
    return map;
}

/// 1.6 m that start at the height `z` above the floor and climb by `slope`.
static pm_ray ray_above(double z, double slope)
{
    return (pm_ray){.origin = pm_vec(-0.8, 0.1, z),
                    .direction = pm_vec(cos(slope), 0.0, sin(slope)),
                    .t_max = 1.6,
                    .medium = 0};
}

static double even_radiance(void)
{
    double density = EVEN / 27.0;
    return density * 0.8 / (4.0 * PM_PI) * (1.0 - exp(-0.5 * 1.6)) / 0.5;
}

/// Beams, or a march, with all photons within 0.4 m.
static double ask(const pm_intersector *world, const pm_photon_map *map, bool march,
                  const pm_ray *ray, uint64_t trial)
{
    if (!march) {
        pm_beams beams;
        CHECK_OK(pm_beams_make(world, map, 0.4, 1, 0, &beams));
        double radiance = pm_beams_query(&beams, &fog, ray).radiance.c[0];
        pm_beams_free(&beams);
        return radiance;
    }
    pm_neighbour scratch[ROOM];
    pm_march how = {.world = world, .map = map, .step = 0.2, .scratch = scratch};
    how.estimate = pm_estimate_defaults();
    how.estimate.k = ROOM;
    how.estimate.radius = 0.4;
    pm_photon_map_box(map, &how.low, &how.high);
    pm_rng rng = pm_shapes_rng(trial, 9);
    pm_spectrum radiance;
    CHECK_OK(pm_media_march(&how, &fog, ray, &rng, &radiance));
    return radiance.c[0];
}

static pm_moments ask_many(const pm_scenes *s, double floor, bool march, const pm_ray *ray)
{
    const int trials = 150;
    double sum = 0.0;
    double sum2 = 0.0;
    omp_set_num_threads(1); // the runner keeps the other cores busy
    for (int t = 0; t < trials; t++) {
        pm_photon_map map = even_field((uint64_t)t, floor);
        double value = ask(&s->world, &map, march, ray, (uint64_t)t);
        sum += value;
        sum2 += value * value;
        pm_photon_map_free(&map);
    }
    return pm_fields_moments(sum, sum2, trials);
}

static void check_along_the_floor(bool march, double sides)
{
    static const double heights[] = {0.02, 0.15, 0.3};
    pm_scenes s;
    floor_scene(&s, 0.0, false, sides > 1.0);
    for (int i = 0; i < 3; i++) {
        pm_ray ray = ray_above(heights[i], 0.25 * i);
        pm_moments got = ask_many(&s, sides > 1.0 ? -9.0 : 0.0, march, &ray);
        CHECK_NEAR(got.mean, even_radiance(), 5.0 * got.sd / sqrt(150.0));
        CHECK_THAT(5.0 * got.sd / sqrt(150.0) < 0.2 * got.mean, "sd %g of %g", got.sd,
                   got.mean);
    }
    pm_scenes_free(&s);
}

static void no_rim_is_dark(void)
{
    check_along_the_floor(false, 1.0);
    check_along_the_floor(true, 1.0);
}

static void media_that_touch_are_kept_apart(void)
{
    // As many photons beyond the end of the medium: none of them is seen on top.
    check_along_the_floor(false, 2.0);
    check_along_the_floor(true, 2.0);
}

static void nothing_shines_through_a_wall(void)
{
    pm_scenes s;
    floor_scene(&s, 0.0, false, false);
    pm_photon_map map = even_field(1, 0.0);
    pm_ray below = ray_above(-0.01, 0.0);
    pm_ray above = ray_above(0.01, 0.0);
    CHECK(ask(&s.world, &map, false, &below, 1) == 0.0);
    CHECK(ask(&s.world, &map, true, &below, 1) == 0.0);
    CHECK(ask(&s.world, &map, false, &above, 1) > 0.0);
    CHECK(ask(NULL, &map, false, &below, 1) > 0.0);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

PM_TESTS({"rim.1", "a wall at any tilt is found, with its distance and on either side",
          a_plane_is_found_at_any_tilt},
         {"rim.2", "null surfaces that part no media are no end of one",
          only_ends_of_media_are_planes},
         {"rim.3", "a wall behind a null surface is found",
          a_wall_behind_a_null_surface_is_found},
         {"rim.4", "along a wall an even field is as bright as in the middle", no_rim_is_dark},
         {"rim.5", "media that touch do not see each other's photons",
          media_that_touch_are_kept_apart},
         {"rim.6", "no photon shines through a wall", nothing_shines_through_a_wall})

// Irradiance at photon positions against the field that sowed the photons, against brute force,
// and in pictures.
#include "balance.h"
#include "chance.h"
#include "coarse_normal.h"
#include "irradiance.h"
#include "photon_map.h"
#include "pictures.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

#include <omp.h>
#include <string.h>

static pm_estimate_settings settings_of(uint32_t k)
{
    pm_estimate_settings settings = pm_estimate_defaults();
    settings.k = k;
    return settings;
}

/// Sows `count` photons, 1 W together, evenly over a square of side 2 about the origin, seen
/// from `normal`.
static void sow(pm_photon_map *map, pm_vec3 normal, uint32_t count)
{
    pm_frame frame = pm_frame_around(normal);
    for (uint32_t i = 0; i < count; i++) {
        pm_rng rng = pm_shapes_rng(i, 21);
        double x = 2.0 * pm_rng_draw(&rng) - 1.0;
        double y = 2.0 * pm_rng_draw(&rng) - 1.0;
        pm_deposit deposit = {
            .position = pm_frame_to_world(&frame, pm_vec(x, y, 0.0)),
            .direction = pm_vec_negate(normal),
            .normal = normal,
            .power = pm_gray(1.0),
        };
        CHECK_OK(pm_store_push(map, &deposit));
    }
}

static void finish(pm_photon_map *map)
{
    CHECK_OK(pm_store_scale(map, map->count));
    CHECK_OK(pm_balance_build(map));
}

/// A scene that holds nothing but a large square about the origin that faces `normal`.
static void sheet(pm_scenes *s, pm_vec3 normal)
{
    pm_frame frame = pm_frame_around(normal);
    pm_shape square = pm_scenes_square(4.0, 0.0, false);
    square.edge[0] = pm_vec_scale(frame.s, 4.0);
    square.edge[1] = pm_vec_scale(frame.t, 4.0);
    square.corner = pm_vec_scale(pm_vec_add(square.edge[0], square.edge[1]), -0.5);
    pm_scenes_begin(s);
    pm_scenes_wear(s, square, pm_scenes_diffuse(s, pm_gray(0.5)));
    pm_scenes_ready(s);
}

enum { K = 50, LOOKUPS = 10000 };

/// Means over points of the sheet, away from its edges, of what places say there and of
/// estimates made there.
static void compare(const pm_photon_map *places, const pm_photon_map *map, pm_vec3 normal,
                    double *by_place, double *by_estimate)
{
    pm_frame frame = pm_frame_around(normal);
    pm_estimate_settings settings = settings_of(K);
    double reach = pm_irradiance_reach(places);
    *by_place = *by_estimate = 0.0;
    for (uint32_t i = 0; i < LOOKUPS; i++) {
        pm_rng rng = pm_shapes_rng(i, 22);
        double x = 1.6 * pm_rng_draw(&rng) - 0.8;
        double y = 1.6 * pm_rng_draw(&rng) - 0.8;
        pm_estimate_point point = {pm_frame_to_world(&frame, pm_vec(x, y, 0.0)), normal};
        pm_neighbour scratch[K];
        bool covered;
        pm_estimate found;
        double unevenness;
        CHECK_OK(pm_irradiance_find(places, &settings, reach, &point, &covered, &found,
                                    &unevenness));
        CHECK(covered && found.radius > 0.0 && found.found == K);
        *by_place += found.value.c[0] / LOOKUPS;
        CHECK_OK(pm_estimate_irradiance(map, &settings, &point, scratch, &found));
        *by_estimate += found.value.c[0] / LOOKUPS;
    }
}

// Although a place stands on a photon, and one near it is missing photons in between: left out
// of its own estimate, that photon would cost 2 % here. A place whose disc had the coarse
// normal would lose 4 % on the first tilted sheet.
static void a_flat_field_is_found_flat(void)
{
    const pm_vec3 normals[] = {{0.0, 0.0, 1.0}, {0.3, -0.5, 0.81}, {-0.04, 0.03, -1.0}};
    for (int i = 0; i < 3; i++) {
        pm_vec3 normal = pm_vec_normalize(normals[i]);
        pm_scenes s;
        sheet(&s, normal);
        pm_photon_map map = {.kind = PM_MAP_GLOBAL, .scale = 1.0};
        pm_photon_map places;
        pm_estimate_settings settings = settings_of(K);
        sow(&map, normal, 40000);
        finish(&map);
        CHECK_OK(pm_irradiance_make(&s.world, &map, &settings, 4, &places));
        CHECK(places.count == 10000 && places.balanced && places.unpacked);
        double by_place;
        double by_estimate;
        compare(&places, &map, normal, &by_place, &by_estimate);
        CHECK_NEAR(by_estimate, 0.25, 0.25 * 0.021); // 1 W over 4 m^2
        CHECK_NEAR(by_place, by_estimate, 0.005 * by_estimate);
        pm_photon_map_free(&places);
        pm_photon_map_free(&map);
        pm_scenes_free(&s);
    }
}

static void each_side_of_a_wall_has_its_own(void)
{
    const pm_vec3 up = {0.0, 0.0, 1.0};
    pm_scenes s;
    sheet(&s, up);
    pm_photon_map map = {.kind = PM_MAP_GLOBAL, .scale = 1.0};
    sow(&map, up, 4000);
    finish(&map);
    pm_estimate_settings settings = settings_of(50);
    pm_photon_map places;
    CHECK_OK(pm_irradiance_make(&s.world, &map, &settings, 1, &places));
    double reach = pm_irradiance_reach(&places);
    bool covered;
    pm_estimate found = {.radius = -1.0};
    double unevenness;
    pm_estimate_point behind = {{0.1, 0.2, 0.0}, {0.0, 0.0, -1.0}};
    CHECK_OK(
        pm_irradiance_find(&places, &settings, reach, &behind, &covered, &found, &unevenness));
    CHECK(!covered && found.radius == -1.0);
    pm_estimate_point across = {{0.1, 0.2, 0.0}, {1.0, 0.0, 0.0}}; // the foot of a wall
    CHECK_OK(
        pm_irradiance_find(&places, &settings, reach, &across, &covered, &found, &unevenness));
    CHECK(!covered);
    pm_estimate_point beyond = {{5.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    CHECK_OK(pm_irradiance_find(&places, &settings, HUGE_VAL, &beyond, &covered, &found,
                                &unevenness));
    CHECK(!covered); // by no place's own disc, however far one looks
    pm_estimate_point front = {{0.1, 0.2, 0.0}, {0.0, 0.0, 1.0}};
    CHECK_OK(
        pm_irradiance_find(&places, &settings, reach, &front, &covered, &found, &unevenness));
    CHECK(covered);
    pm_photon_map_free(&places);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

/// A room's global map, balanced.
static void room_map(pm_scenes *s, pm_photon_map *map)
{
    pm_scenes_lit_room(s, 0.6);
    pm_pass_settings pass = {.seed = 3, .count = 4000};
    CHECK_OK(pm_photon_pass(&s->world, PM_MAP_GLOBAL, &pass, map, NULL));
    CHECK_OK(pm_balance_build(map));
}

/// The nearest place that faces alike and whose disc covers the point, by looking at all.
static uint32_t nearest_place(const pm_photon_map *places, const pm_estimate_point *point)
{
    uint32_t best = UINT32_MAX;
    double least = HUGE_VAL;
    for (uint32_t i = 0; i < places->count; i++) {
        pm_photon_view place = pm_store_unpack(places, i);
        pm_vec3 away = pm_vec_sub(place.position, point->at);
        double height = pm_vec_dot(away, point->normal);
        double distance2 = pm_vec_dot(away, away) + 99.0 * height * height; // flatness 0.1
        double radius = (double)places->exact[i].direction[0];
        if (pm_vec_dot(place.normal, point->normal) >= 0.9 && distance2 <= radius * radius &&
            distance2 < least) {
            least = distance2;
            best = i;
        }
    }
    return best;
}

static void the_nearest_place_is_found(void)
{
    pm_scenes s;
    pm_photon_map map = {.kind = PM_MAP_GLOBAL};
    pm_photon_map places;
    room_map(&s, &map);
    pm_estimate_settings settings = settings_of(12);
    CHECK_OK(pm_irradiance_make(&s.world, &map, &settings, 5, &places));
    CHECK(places.count == (map.count + 4) / 5);
    double reach = pm_irradiance_reach(&places);
    int misses = 0;
    for (uint64_t i = 0; i < 300; i++) {
        pm_rng rng = pm_shapes_rng(i, 23);
        pm_vertex at = pm_pictures_meet(&s, pm_vec(0.0, 0.0, 0.0),
                                        pm_vec_normalize(pm_shapes_inside(&rng, 1.0)));
        pm_estimate_point point = {at.hit.position, at.lobes.normal};
        bool covered;
        pm_estimate found;
        double unevenness;
        CHECK_OK(pm_irradiance_find(&places, &settings, reach, &point, &covered, &found,
                                    &unevenness));
        uint32_t want = nearest_place(&places, &point);
        CHECK(covered == (want != UINT32_MAX));
        if (covered) {
            CHECK_NEAR(found.value.c[1], pm_store_power(&places, want).c[1], 0.0);
        }
        misses += !covered;
    }
    CHECK(misses < 30);
    pm_photon_map_free(&places);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

static void threads_do_not_matter(void)
{
    const int threads[] = {1, 2, 7};
    pm_scenes s;
    pm_photon_map map = {.kind = PM_MAP_GLOBAL};
    pm_photon_map first = {0};
    room_map(&s, &map);
    pm_estimate_settings settings = settings_of(12);
    for (int i = 0; i < 3; i++) {
        pm_photon_map places;
        omp_set_num_threads(threads[i]);
        CHECK_OK(pm_irradiance_make(&s.world, &map, &settings, 4, &places));
        if (i == 0) {
            first = places;
            continue;
        }
        CHECK(places.count == first.count);
        CHECK(memcmp(places.photons, first.photons, first.count * sizeof(pm_photon)) == 0);
        CHECK(memcmp(places.exact, first.exact, first.count * sizeof(pm_photon_exact)) == 0);
        pm_photon_map_free(&places);
    }
    pm_photon_map_free(&first);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

static void nonsense_is_refused(void)
{
    pm_scenes s;
    pm_photon_map map = {.kind = PM_MAP_GLOBAL};
    pm_photon_map places = {.count = 77};
    room_map(&s, &map);
    pm_estimate_settings settings = settings_of(0);
    CHECK_FAILS(pm_irradiance_make(&s.world, &map, &settings, 4, &places), PM_EINPUT,
                "got 0 and 4");
    settings.k = 10;
    CHECK_FAILS(pm_irradiance_make(&s.world, &map, &settings, 0, &places), PM_EINPUT,
                "got 10 and 0");
    map.balanced = false;
    CHECK_FAILS(pm_irradiance_make(&s.world, &map, &settings, 4, &places), PM_EINPUT,
                "balanced");
    CHECK(places.count == 77);
    pm_photon_map empty = {.kind = PM_MAP_GLOBAL};
    CHECK_OK(pm_irradiance_make(&s.world, &empty, &settings, 4, &places));
    CHECK(places.count == 0);
    CHECK_NEAR(pm_irradiance_reach(&places), 0.0, 0.0);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

static void pictures_agree_with_and_without(void)
{
    pm_scenes s;
    pm_scenes_balls(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.9, 0.0), pm_vec(0.0, 1.0, 0.0), 0.9, 16);
    pm_render_settings settings = pm_pictures_settings();
    settings.light.rays = 16;
    settings.only = PM_LAYER_INDIRECT;
    pm_image plain = pm_pictures_take(&s, &settings);
    settings.precompute = true;
    pm_image fast = pm_pictures_take(&s, &settings);
    double want = pm_pictures_mean(&plain, "indirect.R");
    CHECK_NEAR(pm_pictures_mean(&fast, "indirect.R"), want, 0.02 * want);
    bool differs = false;
    for (int i = 0; i < plain.width * plain.height; i++) {
        differs = differs || pm_image_plane(&plain, "R")[i] != pm_image_plane(&fast, "R")[i];
    }
    CHECK(differs); // it was asked
    CHECK_NEAR(pm_pictures_at(&fast, "gather.count", 8, 8), 100.0, 0.0);
    pm_image_free(&plain);
    pm_image_free(&fast);
    pm_scenes_free(&s);
}

PM_TESTS({"irradiance.1", "on a flat field the nearest place gives the field, tilted or not",
          a_flat_field_is_found_flat},
         {"irradiance.2", "a place does not answer for the other side, the next wall or afar",
          each_side_of_a_wall_has_its_own},
         {"irradiance.3", "the place found is the nearest that covers the point",
          the_nearest_place_is_found},
         {"irradiance.4", "1, 2 and 7 threads make the same places", threads_do_not_matter},
         {"irradiance.5", "nonsense is refused, an empty map has no places",
          nonsense_is_refused},
         {"irradiance.6", "a picture with irradiance at photons agrees with one without",
          pictures_agree_with_and_without})

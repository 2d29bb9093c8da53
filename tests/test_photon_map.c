// Maps as containers, and the coarse normals of photons.
#include "coarse_normal.h"
#include "map_power.h"
#include "photon_map.h"
#include "rng.h"
#include "store.h"
#include "test.h"

#include <math.h>
#include <string.h>

static void push(pm_photon_map *map, double x, double power)
{
    pm_deposit deposit = {.position = pm_vec(x, 0.0, 0.0),
                          .direction = pm_vec(0.0, 0.0, -1.0),
                          .normal = pm_vec(0.0, 0.0, 1.0),
                          .power = pm_gray(power)};
    CHECK_OK(pm_store_push(map, &deposit));
}

static void maps_are_appended(void)
{
    pm_photon_map all = {.kind = PM_MAP_GLOBAL, .unpacked = true};
    pm_photon_map part = {.kind = PM_MAP_GLOBAL, .unpacked = true};
    push(&all, 1.0, 1.0);
    push(&part, 2.0, 2.0);
    push(&part, 3.0, 3.0);
    push(&part, 4.0, 0x1p150);
    push(&part, 4.0, 0x1p-150);
    part.refused = 5;
    all.balanced = true;
    CHECK_OK(pm_photon_map_append(&all, &part));
    CHECK(all.count == 5 && !all.balanced);
    CHECK(all.refused == 5 && all.clamped == 1 && all.vanished == 1);
    CHECK(pm_store_unpack(&all, 2).position.x == 3.0 && pm_store_power(&all, 1).c[0] == 2.0);
    pm_photon_map empty = {.kind = PM_MAP_GLOBAL, .unpacked = true};
    CHECK_OK(pm_photon_map_append(&all, &empty));
    CHECK_OK(pm_photon_map_append(&empty, &empty));
    CHECK(all.count == 5 && empty.count == 0);
    pm_photon_map_free(&all);
    pm_photon_map_free(&part);
}

static void different_maps_are_not_appended(void)
{
    pm_photon_map all = {.kind = PM_MAP_GLOBAL};
    pm_photon_map other = {.kind = PM_MAP_CAUSTIC};
    push(&other, 1.0, 1.0);
    CHECK_FAILS(pm_photon_map_append(&all, &other), PM_EINPUT, "one kind");
    other.kind = PM_MAP_GLOBAL;
    all.unpacked = true;
    CHECK_FAILS(pm_photon_map_append(&all, &other), PM_EINPUT, "one packing");
    all.unpacked = false;
    CHECK_OK(pm_store_scale(&other, 10));
    CHECK_FAILS(pm_photon_map_append(&all, &other), PM_EINPUT, "before scaling");
    CHECK(all.count == 0);
    pm_photon_map_free(&other);
}

static void too_many_photons_are_refused(void)
{
    pm_photon_map map = {.kind = PM_MAP_GLOBAL};
    CHECK_FAILS(pm_photon_map_reserve(&map, (uint64_t)PM_MAP_MAX + 1), PM_ELIMIT,
                "asked for 2147483648");
    pm_photon_map half = {.count = 1u << 30, .capacity = 1u << 30};
    pm_photon_map same = half;
    CHECK_FAILS(pm_photon_map_append(&half, &same), PM_ELIMIT, "at most 2147483647");
    CHECK(half.count == 1u << 30 && half.photons == NULL && map.photons == NULL);
    // Growing by a quarter must not run past the limit while a smaller step still fits.
    pm_photon_map large = {.count = 2000000000u, .capacity = 2000000000u};
    CHECK(pm_photon_map_growth(&large, 2000000001u) == PM_MAP_MAX);
    CHECK(pm_photon_map_growth(&large, (uint64_t)PM_MAP_MAX + 1) > PM_MAP_MAX);
}

static void room_is_given_back(void)
{
    pm_photon_map map = {.kind = PM_MAP_VOLUME, .unpacked = true};
    CHECK_OK(pm_photon_map_reserve(&map, 1000));
    push(&map, 1.0, 4.0);
    CHECK(pm_photon_map_bytes(&map) == 1000 * (20 + sizeof(pm_photon_exact)));
    pm_photon_map_trim(&map);
    CHECK(map.capacity == 1 && pm_store_power(&map, 0).c[0] == 4.0);
    CHECK(pm_photon_map_bytes(&map) == 20 + sizeof(pm_photon_exact));
    push(&map, 2.0, 5.0);
    map.count = 0;
    pm_photon_map_trim(&map);
    CHECK(map.capacity == 0 && map.photons == NULL && map.exact == NULL);
    pm_photon_map_free(&map);
    CHECK(map.kind == PM_MAP_VOLUME && map.unpacked && map.count == 0);
    push(&map, 2.0, 5.0);
    CHECK(map.count == 1);
    pm_photon_map_free(&map);
}

static void power_is_summed_in_double(void)
{
    // In float 2^24 + 1 is 2^24, however often 1 is added.
    pm_photon_map map = {.unpacked = true};
    push(&map, 0.0, 0x1p24);
    for (int i = 0; i < 1000; i++) {
        push(&map, 0.0, 1.0);
    }
    CHECK_NEAR(pm_map_power(&map).c[1], 0x1p24 + 1000.0, 0.0);
    CHECK_OK(pm_store_scale(&map, 1000));
    CHECK_NEAR(pm_map_power(&map).c[1], (0x1p24 + 1000.0) / 1000.0, 1e-9);
    pm_photon_map_free(&map);
}

// --- coarse normals -------------------------------------------------------------------------

static pm_vec3 random_normal(uint64_t i)
{
    pm_rng_source source = {.seed = 4, .stream = PM_STREAM_TEST};
    pm_rng rng = pm_rng_at(&source, i, 0);
    double z = 1.0 - 2.0 * pm_rng_draw(&rng);
    double phi = 2.0 * PM_PI * pm_rng_draw(&rng);
    return pm_vec(sqrt(1.0 - z * z) * cos(phi), sqrt(1.0 - z * z) * sin(phi), z);
}

static void normals_come_back(void)
{
    double worst = 0.0;
    for (uint64_t i = 0; i < 200000; i++) {
        pm_vec3 normal = random_normal(i);
        pm_vec3 back = pm_normal_decode(pm_normal_encode(normal));
        CHECK_NEAR(pm_vec_length(back), 1.0, 1e-14);
        worst = fmax(worst, pm_vec_length(pm_vec_cross(normal, back)));
        CHECK(pm_vec_dot(normal, back) > 0.9);
    }
    CHECK(asin(worst) * 180.0 / PM_PI < 2.7);
}

static void axes_are_exact(void)
{
    for (int axis = 0; axis < 3; axis++) {
        for (double sign = -1.0; sign <= 1.0; sign += 2.0) {
            pm_vec3 normal =
                pm_vec(axis == 0 ? sign : 0.0, axis == 1 ? sign : 0.0, axis == 2 ? sign : 0.0);
            pm_vec3 back = pm_normal_decode(pm_normal_encode(normal));
            CHECK(back.x == normal.x && back.y == normal.y && back.z == normal.z);
            pm_vec3 zeros = pm_vec(normal.x == 0.0 ? -0.0 : sign, normal.y == 0.0 ? -0.0 : sign,
                                   normal.z == 0.0 ? -0.0 : sign);
            back = pm_normal_decode(pm_normal_encode(zeros));
            CHECK(pm_vec_dot(back, normal) == 1.0);
        }
    }
}

static void no_normal_has_a_code(void)
{
    CHECK(pm_normal_encode(pm_vec(0.0, -0.0, 0.0)) == 4095);
    CHECK(pm_vec_length(pm_normal_decode(4095)) == 0.0);
    CHECK(pm_normal_within(4095, pm_vec(0.0, 0.0, 1.0), 0.5));
    for (uint64_t i = 0; i < 100000; i++) {
        CHECK(pm_normal_encode(random_normal(i)) < 4095);
    }
}

static void within_agrees_with_decoding(void)
{
    static const double bounds[] = {-0.9, -0.05, 0.0, 0.3};
    for (uint64_t i = 0; i < 20000; i++) {
        uint16_t code = pm_normal_encode(random_normal(2 * i));
        pm_vec3 direction = random_normal(2 * i + 1);
        double cosine = pm_vec_dot(pm_normal_decode(code), direction);
        for (int b = 0; b < 4; b++) {
            bool clear = fabs(cosine - bounds[b]) > 1e-12;
            CHECK(!clear ||
                  pm_normal_within(code, direction, bounds[b]) == (cosine > bounds[b]));
        }
    }
}

PM_TESTS({"photon_map.1", "an appended map brings photons and counters", maps_are_appended},
         {"photon_map.2", "maps that differ or are scaled are not appended",
          different_maps_are_not_appended},
         {"photon_map.3", "more than 2^31 - 1 photons are refused before allocating",
          too_many_photons_are_refused},
         {"photon_map.4", "trim gives room back, free leaves a usable map", room_is_given_back},
         {"photon_map.5", "power is summed in double", power_is_summed_in_double},
         {"photon_map.6", "coarse normals are within 2.7 degrees", normals_come_back},
         {"photon_map.7", "normals along the axes are exact", axes_are_exact},
         {"photon_map.8", "no normal has a code of its own", no_normal_has_a_code},
         {"photon_map.9", "the quick test of a normal agrees with decoding it",
          within_agrees_with_decoding})

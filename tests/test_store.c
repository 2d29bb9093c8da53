// Packing: the codec against its arithmetic and against chance, the map as it grows, refusals.
// Statistical bounds are 5 sigma of the known variance; seeds are fixed.
#include "photon_map.h"
#include "rng.h"
#include "store.h"
#include "test.h"

#include <math.h>
#include <string.h>

static pm_rng rng_at(uint64_t index)
{
    pm_rng_source source = {.seed = 3, .stream = PM_STREAM_TEST, .pass = 1};
    return pm_rng_at(&source, index, 0);
}

static pm_deposit deposit_of(pm_spectrum power, pm_vec3 direction)
{
    return (pm_deposit){.position = pm_vec(1.0, -2.0, 0.5),
                        .direction = direction,
                        .normal = pm_vec(0.0, 0.0, 1.0),
                        .power = power};
}

/// What a packed map gives back for one deposit.
static pm_photon_view round_trip(const pm_deposit *deposit, int *fits)
{
    pm_photon photon;
    CHECK_OK(pm_store_pack(deposit, &photon, fits));
    pm_photon_map map = {.photons = &photon, .count = 1, .capacity = 1};
    return pm_store_unpack(&map, 0);
}

static pm_spectrum power_back(pm_spectrum power, int *fits)
{
    pm_deposit deposit = deposit_of(power, pm_vec(0.0, 0.0, 1.0));
    return round_trip(&deposit, fits).power;
}

static pm_vec3 direction_back(pm_vec3 direction)
{
    int fits;
    pm_deposit deposit = deposit_of(pm_gray(1.0), direction);
    return round_trip(&deposit, &fits).direction;
}

// --- power ----------------------------------------------------------------------------------

static void example_by_hand(void)
{
    // 1 = 0.5 * 2^1: mantissas 128, 64, 32, exponent 1 + 128; decoded at their bins' middles.
    int fits;
    pm_photon photon;
    pm_deposit deposit = deposit_of(pm_rgb(1.0, 0.5, 0.25), pm_vec(0.0, 0.0, 1.0));
    CHECK_OK(pm_store_pack(&deposit, &photon, &fits));
    CHECK(photon.power[0] == 128 && photon.power[1] == 64 && photon.power[2] == 32);
    CHECK(photon.power[3] == 129 && fits == 0);
    pm_spectrum back = power_back(pm_rgb(1.0, 0.5, 0.25), &fits);
    CHECK_NEAR(back.c[0], 128.5 / 128.0, 0.0);
    CHECK_NEAR(back.c[1], 64.5 / 128.0, 0.0);
    CHECK_NEAR(back.c[2], 32.5 / 128.0, 0.0);
}

/// Mean of decoded / true for a channel at `share` of the largest, over colours whose largest
/// mantissa m is log-uniform in [0.5, 1): the byte is floor(256 m share).
static double expected_ratio(double share)
{
    double low = 128.0 * share;
    double high = 256.0 * share;
    double sum = 0.0;
    for (int byte = 1; byte < 256; byte++) {
        double from = fmax(low, byte);
        double to = fmin(high, byte + 1.0);
        if (from < to) {
            sum += (byte + 0.5) * (1.0 / from - 1.0 / to);
        }
    }
    return sum / log(2.0);
}

static void power_does_not_drift(void)
{
    static const double shares[] = {1.0, 0.1, 0.03, 0.01};
    const int trials = 200000;
    for (int s = 0; s < 4; s++) {
        double sum = 0.0;
        double sum2 = 0.0;
        for (int i = 0; i < trials; i++) {
            pm_rng rng = rng_at((uint64_t)i);
            double largest = exp2(pm_rng_draw(&rng) * 240.0 - 120.0);
            int fits;
            pm_spectrum back = power_back(pm_rgb(largest * shares[s], largest, 0.0), &fits);
            double ratio = back.c[0] / (largest * shares[s]);
            CHECK(fits == 0);
            CHECK(fabs(back.c[1] / largest - 1.0) <= 0.5 / 128.0);
            CHECK(back.c[2] == 0.0);
            sum += ratio;
            sum2 += ratio * ratio;
        }
        double mean = sum / trials;
        double sigma = sqrt((sum2 / trials - mean * mean) / trials);
        CHECK_NEAR(mean, expected_ratio(shares[s]), 5.0 * sigma);
        CHECK_NEAR(mean, 1.0, 0.004); // without the half step 0.72 at a hundredth
    }
}

static void range_of_power(void)
{
    int fits;
    CHECK(power_back(pm_gray(0x1p-128), &fits).c[0] > 0.0 && fits == 0);
    CHECK(power_back(pm_gray(0x1.fffp-129), &fits).c[0] == 0.0 && fits == -1);
    CHECK(power_back(pm_gray(0x1.fffp126), &fits).c[0] > 0x1.fep126 && fits == 0);
    pm_spectrum top = power_back(pm_rgb(0x1p200, 0x1p199, 0.0), &fits);
    CHECK(fits == 1);
    CHECK_NEAR(top.c[0] / 0x1p127, 255.5 / 256.0, 0.0);
    CHECK_NEAR(top.c[1] / top.c[0], 0.5, 0.003); // its hue stays
    CHECK(top.c[2] == 0.0);
    CHECK(power_back(pm_gray(0.0), &fits).c[0] == 0.0 && fits == 0);
}

// --- direction ------------------------------------------------------------------------------

static pm_vec3 random_direction(pm_rng *rng)
{
    double z = 1.0 - 2.0 * pm_rng_draw(rng);
    double phi = 2.0 * PM_PI * pm_rng_draw(rng);
    double across = sqrt(1.0 - z * z);
    return pm_vec(across * cos(phi), across * sin(phi), z);
}

static double degrees_between(pm_vec3 a, pm_vec3 b)
{
    double angle = atan2(pm_vec_length(pm_vec_cross(a, b)), pm_vec_dot(a, b));
    return angle * (180.0 / PM_PI);
}

static void directions_come_back(void)
{
    const int trials = 200000;
    double sum = 0.0;
    double worst = 0.0;
    for (int i = 0; i < trials; i++) {
        pm_rng rng = rng_at((uint64_t)i);
        pm_vec3 direction = random_direction(&rng);
        pm_vec3 back = direction_back(direction);
        CHECK_NEAR(pm_vec_length(back), 1.0, 1e-13);
        double error = degrees_between(direction, back);
        sum += error;
        worst = fmax(worst, error);
    }
    CHECK_NEAR(sum / trials, 0.354, 0.002);
    CHECK_NEAR(worst, 0.786, 0.01); // half the diagonal of a bin at the equator
}

static void every_code_is_stable(void)
{
    pm_photon photon = {.power = {128, 128, 128, 129}};
    pm_photon_map map = {.photons = &photon, .count = 1, .capacity = 1};
    for (int theta = 0; theta < 256; theta++) {
        for (int phi = 0; phi < 256; phi++) {
            photon.direction[0] = (uint8_t)theta;
            photon.direction[1] = (uint8_t)phi;
            pm_vec3 middle = pm_store_unpack(&map, 0).direction;
            double at = (theta + 0.5) * PM_PI / 256.0;
            double around = (phi + 0.5) * PM_PI / 128.0;
            CHECK_NEAR(middle.x, sin(at) * cos(around), 1e-13);
            CHECK_NEAR(middle.y, sin(at) * sin(around), 1e-13);
            CHECK_NEAR(middle.z, cos(at), 1e-13);
            pm_photon again;
            int fits;
            pm_deposit deposit = deposit_of(pm_gray(1.0), middle);
            CHECK_OK(pm_store_pack(&deposit, &again, &fits));
            CHECK(memcmp(again.direction, photon.direction, 2) == 0);
        }
    }
}

static void azimuth_bins_are_equal(void)
{
    enum { TRIALS = 256000 };
    static int count[256];
    for (int i = 0; i < TRIALS; i++) {
        pm_rng rng = rng_at((uint64_t)i);
        pm_photon photon;
        int fits;
        pm_deposit deposit = deposit_of(pm_gray(1.0), random_direction(&rng));
        CHECK_OK(pm_store_pack(&deposit, &photon, &fits));
        count[photon.direction[1]]++;
    }
    for (int i = 0; i < 256; i++) {
        CHECK_NEAR(count[i], TRIALS / 256.0, 5.0 * sqrt(TRIALS / 256.0));
    }
}

static void directions_at_the_rims(void)
{
    // Rounding leaves |z| above 1; an azimuth just below 0 belongs to the last bin.
    static const pm_vec3 rims[] = {
        {0.0, 0.0, 1.0 + 1e-7}, {0.0, 0.0, -1.0 - 1e-7}, {0.0, 0.0, 1.0},   {0.0, 0.0, -1.0},
        {1.0, -1e-300, 0.0},    {1.0, -0.0, 0.0},        {-1.0, -0.0, 0.0}, {-1.0, 0.0, 0.0}};
    for (size_t i = 0; i < sizeof rims / sizeof rims[0]; i++) {
        CHECK(degrees_between(direction_back(rims[i]), rims[i]) < 0.79);
    }
}

// --- refusals -------------------------------------------------------------------------------

static void wrong_deposits_are_refused(void)
{
    pm_deposit good = deposit_of(pm_gray(1.0), pm_vec(0.0, 0.0, 1.0));
    double nan = (double)NAN;
    double inf = (double)INFINITY;
    pm_photon photon;
    memset(&photon, 7, sizeof photon);
    pm_photon before = photon;
    int fits = 42;
    pm_deposit bad = good;
    bad.power.c[1] = nan;
    CHECK_FAILS(pm_store_pack(&bad, &photon, &fits), PM_EINPUT, "power must be finite");
    bad.power.c[1] = inf;
    CHECK_FAILS(pm_store_pack(&bad, &photon, &fits), PM_EINPUT, "power must be finite");
    bad.power.c[1] = -1e-30;
    CHECK_FAILS(pm_store_pack(&bad, &photon, &fits), PM_EINPUT, "power must not be negative");
    bad = good;
    bad.position.y = nan;
    CHECK_FAILS(pm_store_pack(&bad, &photon, &fits), PM_EINPUT, "position must be finite");
    bad.position.y = 1e39; // no float
    CHECK_FAILS(pm_store_pack(&bad, &photon, &fits), PM_EINPUT, "position must be finite");
    bad = good;
    bad.direction.z = inf;
    CHECK_FAILS(pm_store_pack(&bad, &photon, &fits), PM_EINPUT, "direction and normal");
    bad = good;
    bad.normal.x = nan;
    CHECK_FAILS(pm_store_pack(&bad, &photon, &fits), PM_EINPUT, "direction and normal");
    CHECK(memcmp(&photon, &before, sizeof photon) == 0 && fits == 42);
}

static void refused_deposits_are_counted(void)
{
    pm_photon_map map = {.kind = PM_MAP_GLOBAL};
    pm_deposit deposit = deposit_of(pm_gray(1.0), pm_vec(0.0, 0.0, 1.0));
    CHECK_OK(pm_store_push(&map, &deposit));
    deposit.power.c[2] = (double)NAN;
    CHECK_OK(pm_store_push(&map, &deposit));
    deposit.power = pm_gray(0x1p130);
    CHECK_OK(pm_store_push(&map, &deposit));
    deposit.power = pm_gray(0x1p-140);
    CHECK_OK(pm_store_push(&map, &deposit));
    CHECK(map.count == 3 && map.refused == 1 && map.clamped == 1 && map.vanished == 1);
    CHECK(pm_status_message()[0] == '\0');
    pm_photon_map_free(&map);
}

// --- the map --------------------------------------------------------------------------------

static void map_grows_by_a_quarter(void)
{
    pm_photon_map map = {.kind = PM_MAP_GLOBAL};
    for (uint32_t i = 0; i < 100000; i++) {
        pm_deposit deposit = deposit_of(pm_gray(1.0 + i), pm_vec(0.0, 0.0, 1.0));
        CHECK_OK(pm_store_push(&map, &deposit));
        CHECK(map.count == i + 1 && map.capacity >= map.count);
        CHECK(map.capacity <= 4 || map.capacity <= map.count + map.count / 4);
    }
    for (uint32_t i = 0; i < map.count; i++) {
        double power = pm_store_unpack(&map, i).power.c[0];
        CHECK(fabs(power / (1.0 + i) - 1.0) <= 0.5 / 128.0);
    }
    pm_photon_map_free(&map);
}

static void a_full_map_is_refused(void)
{
    // No memory stands behind these counts: the refusal must come first.
    pm_photon_map map = {.count = PM_MAP_MAX, .capacity = PM_MAP_MAX};
    pm_deposit deposit = deposit_of(pm_gray(1.0), pm_vec(0.0, 0.0, 1.0));
    CHECK_FAILS(pm_store_push(&map, &deposit), PM_ELIMIT, "at most 2147483647 photons");
    CHECK(map.count == PM_MAP_MAX && map.photons == NULL);
}

static void scale_is_by_emitted(void)
{
    pm_photon_map map = {.kind = PM_MAP_CAUSTIC, .unpacked = true};
    pm_deposit deposit = deposit_of(pm_rgb(5.0, 6.0, 7.0), pm_vec(0.0, 0.0, 1.0));
    CHECK_OK(pm_store_push(&map, &deposit));
    CHECK_OK(pm_store_push(&map, &deposit));
    CHECK_NEAR(pm_store_power(&map, 1).c[2], 7.0, 0.0); // not scaled yet
    CHECK_FAILS(pm_store_scale(&map, 0), PM_EINPUT, "photons emitted, got 0");
    CHECK_OK(pm_store_scale(&map, 8));
    CHECK_NEAR(pm_store_power(&map, 0).c[0], 5.0 / 8.0, 0.0);
    CHECK_NEAR(pm_store_unpack(&map, 1).power.c[1], 6.0 / 8.0, 0.0);
    CHECK(map.emitted == 8);
    CHECK_FAILS(pm_store_scale(&map, 8), PM_EINPUT, "scaled once");
    CHECK_FAILS(pm_store_push(&map, &deposit), PM_EINPUT, "before scaling");
    CHECK(map.count == 2);
    pm_photon_map_free(&map);
}

static void exact_values_stay_exact(void)
{
    pm_photon_map map = {.unpacked = true};
    pm_deposit deposit = deposit_of(pm_rgb(0.1, 1e-9, 3.0), pm_vec(0.6, 0.0, -0.8));
    CHECK_OK(pm_store_push(&map, &deposit));
    pm_photon_view view = pm_store_unpack(&map, 0);
    CHECK_NEAR(view.power.c[0], 0.1, 1e-8);
    CHECK_NEAR(view.power.c[1], 1e-9, 1e-16); // the packed form loses it
    CHECK_NEAR(view.direction.x, 0.6, 1e-7);
    CHECK_NEAR(view.direction.z, -0.8, 1e-7);
    deposit.power = pm_gray(0x1p300); // above both forms' range
    CHECK_OK(pm_store_push(&map, &deposit));
    CHECK(isfinite(pm_store_power(&map, 1).c[0]) && map.clamped == 1);
    pm_photon_map_free(&map);
}

static void marks_and_normals_are_kept(void)
{
    int fits;
    pm_deposit deposit = deposit_of(pm_gray(1.0), pm_vec(0.0, 0.0, 1.0));
    deposit.normal = pm_vec(0.0, -1.0, 0.0);
    deposit.caustic = true;
    pm_photon_view view = round_trip(&deposit, &fits);
    CHECK(view.caustic && !view.first && view.normal.y == -1.0);
    CHECK(view.position.x == 1.0 && view.position.y == -2.0 && view.position.z == 0.5);
    deposit.caustic = false;
    deposit.first = true;
    deposit.in_medium = true;
    view = round_trip(&deposit, &fits);
    CHECK(!view.caustic && view.first && pm_vec_length(view.normal) == 0.0);
}

PM_TESTS(
    {"store.1", "a packed power has the bytes worked out by hand", example_by_hand},
    {"store.2", "packed powers do not drift in the mean", power_does_not_drift},
    {"store.3", "powers out of range are clamped or vanish, and it is said", range_of_power},
    {"store.4", "directions come back within the error of their bytes", directions_come_back},
    {"store.5", "every direction code decodes to its bin's middle", every_code_is_stable},
    {"store.6", "all azimuth bins are equally wide", azimuth_bins_are_equal},
    {"store.7", "directions at poles and seams survive rounding", directions_at_the_rims},
    {"store.8", "deposits that are no light are refused", wrong_deposits_are_refused},
    {"store.9", "refused, clamped and vanished photons are counted",
     refused_deposits_are_counted},
    {"store.10", "a map grows by a quarter and keeps its photons", map_grows_by_a_quarter},
    {"store.11", "a full map is refused before allocating", a_full_map_is_refused},
    {"store.12", "a map is scaled once, by the photons emitted", scale_is_by_emitted},
    {"store.13", "with packing off powers and directions are exact", exact_values_stay_exact},
    {"store.14", "marks, normals and positions are kept", marks_and_normals_are_kept})

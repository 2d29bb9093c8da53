// Estimates case by case: few photons by hand, sides, shapes, scales, media, refusals.
#include "coarse_normal.h"
#include "fields.h"
#include "photon_map.h"
#include "store.h"
#include "test.h"

#include <math.h>
#include <string.h>

// --- few photons ----------------------------------------------------------------------------

static void few_photons_by_hand(void)
{
    pm_photon_map map = {.unpacked = true};
    pm_vec3 up = pm_vec(0.0, 0.0, 1.0);
    pm_estimate_settings settings = pm_estimate_defaults();
    pm_fields_empty(&map);
    pm_fields_finish(&map);
    pm_estimate none = pm_fields_ask(&map, &settings, &pm_fields_floor);
    CHECK(none.value.c[0] == 0.0 && none.radius == 0.0 && none.found == 0);

    pm_fields_empty(&map);
    pm_fields_push(&map, pm_vec(0.5, 0.0, 0.0), up, 3.0);
    pm_fields_finish(&map);
    pm_estimate one = pm_fields_ask(&map, &settings, &pm_fields_floor);
    CHECK(one.value.c[0] == 0.0 && one.found == 1 && one.radius == 0.5);
    settings.radius = 2.0;
    one = pm_fields_ask(&map, &settings, &pm_fields_floor);
    CHECK_NEAR(one.value.c[0], 3.0 / (4.0 * PM_PI), 1e-15);
    CHECK(one.radius == 2.0 && one.found == 1);
    settings.k = 1; // one held, and left out
    CHECK(pm_fields_ask(&map, &settings, &pm_fields_floor).value.c[0] == 0.0);
    settings.radius = 0.25;
    CHECK(pm_fields_ask(&map, &settings, &pm_fields_floor).found == 0);

    pm_fields_empty(&map);
    pm_fields_push(&map, pm_vec(0.5, 0.0, 0.0), up, 3.0);
    pm_fields_push(&map, pm_vec(0.0, 1.0, 0.0), up, 5.0);
    pm_fields_push(&map, pm_vec(0.0, -2.0, 0.0), up, 7.0);
    pm_fields_finish(&map);
    settings = pm_estimate_defaults(); // k 100, found 3: found stands for k
    CHECK_NEAR(pm_fields_ask(&map, &settings, &pm_fields_floor).value.c[0], 8.0 / (4.0 * PM_PI),
               1e-15);
    settings.k = 2;
    CHECK_NEAR(pm_fields_ask(&map, &settings, &pm_fields_floor).value.c[0], 3.0 / PM_PI, 1e-15);
    settings.plain_k = true;
    CHECK_NEAR(pm_fields_ask(&map, &settings, &pm_fields_floor).value.c[0], 8.0 / PM_PI, 1e-15);
    settings.k = 1;
    CHECK_NEAR(pm_fields_ask(&map, &settings, &pm_fields_floor).value.c[0],
               3.0 / (0.25 * PM_PI), 1e-14);
    pm_photon_map_free(&map);
}

static void coincident_photons_stay_finite(void)
{
    static const pm_vec3 places[] = {{0.0, 0.0, 0.0}, {1.0, -2.0, 3.0}, {1e6, 0.0, 0.0}};
    for (int p = 0; p < 3; p++) {
        for (pm_filter_kind filter = 0; filter < PM_FILTER_COUNT; filter++) {
            pm_photon_map map = {.unpacked = true};
            for (int i = 0; i < 100; i++) {
                pm_fields_push(&map, places[p], pm_vec(0.0, 0.0, 1.0), 1e-3);
            }
            pm_fields_finish(&map);
            pm_estimate_settings settings = pm_estimate_defaults();
            settings.k = 10;
            settings.filter = filter;
            pm_estimate_point point = {places[p], {0.0, 0.0, 1.0}};
            pm_estimate estimate = pm_fields_ask(&map, &settings, &point);
            CHECK(isfinite(estimate.value.c[0]) && estimate.value.c[0] > 0.0);
            CHECK(estimate.floored && estimate.radius > 0.0 && estimate.radius < 0.1);
            pm_photon_map_free(&map);
        }
    }
}

// --- sides and shapes -----------------------------------------------------------------------

static void sides_are_told_by_normals(void)
{
    static const struct {
        pm_vec3 normal;
        bool counts;
    } cases[] = {{{0.0, 0.0, 1.0}, true},  {{0.0, 0.0, -1.0}, false}, {{1.0, 0.0, 0.0}, true},
                 {{0.0, -1.0, 0.0}, true}, {{0.6, 0.0, -0.8}, false}, {{0.0, 0.0, 0.0}, true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        pm_photon_map map = {.unpacked = true};
        pm_fields_push(&map, pm_vec(0.1, 0.0, 0.0), cases[i].normal, 1.0);
        pm_fields_finish(&map);
        pm_estimate_settings settings = pm_estimate_defaults();
        settings.radius = 1.0;
        CHECK((pm_fields_ask(&map, &settings, &pm_fields_floor).found == 1) == cases[i].counts);
        pm_photon_map_free(&map);
    }
}

static void turned_walls_keep_their_corner(void)
{
    // Normals at right angles, coarse as stored: neither wall may lose the other's photons.
    for (uint64_t i = 0; i < 3000; i++) {
        pm_rng rng = pm_fields_rng(i);
        double z = 1.0 - 2.0 * pm_rng_draw(&rng);
        double phi = 2.0 * PM_PI * pm_rng_draw(&rng);
        double across = sqrt(1.0 - z * z);
        pm_frame frame = pm_frame_around(pm_vec(across * cos(phi), across * sin(phi), z));
        pm_estimate_query query = {{{0.0, 0.0, 0.0}, frame.s}, PM_GATHER_SPHERE, 0.1, 0, 0};
        pm_photon photon = {
            .flags = (uint16_t)(pm_normal_encode(frame.n) << PM_PHOTON_NORMAL_SHIFT)};
        double distance2;
        CHECK(pm_estimate_accept(&query, &photon, &distance2));
        query.point.normal = pm_vec_negate(frame.n);
        CHECK(!pm_estimate_accept(&query, &photon, &distance2));
    }
}

static void disc_measures_heights_by_flatness(void)
{
    pm_photon photon = {.position = {3.0f, 0.0f, 4.0f}, .flags = 4095u << 4};
    pm_estimate_query query = {pm_fields_floor, PM_GATHER_DISC, 0.25, 0, 0};
    double distance2;
    CHECK(pm_estimate_accept(&query, &photon, &distance2));
    CHECK_NEAR(distance2, 9.0 + 16.0 * 16.0, 1e-12);
    photon.position[2] = 0.0f;
    query.flatness = 1e-200; // its square is 0, and 0 / 0 not a number
    CHECK(pm_estimate_accept(&query, &photon, &distance2));
    CHECK_NEAR(distance2, 9.0, 0.0);
    photon.position[2] = 4.0f;
    query.shape = PM_GATHER_SPHERE;
    CHECK(pm_estimate_accept(&query, &photon, &distance2));
    CHECK_NEAR(distance2, 25.0, 0.0);
}

static void marked_photons_are_skipped(void)
{
    pm_photon_map map = {.unpacked = true};
    for (int i = 0; i < 8; i++) {
        pm_fields_push(&map, pm_vec(0.1 * i, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), 1.0);
        map.photons[i].flags |= i % 2 ? PM_PHOTON_FIRST : 0;
        map.photons[i].flags |= i % 4 == 0 ? PM_PHOTON_CAUSTIC : 0;
    }
    pm_fields_finish(&map);
    pm_estimate_settings settings = pm_estimate_defaults();
    settings.radius = 10.0;
    CHECK(pm_fields_ask(&map, &settings, &pm_fields_floor).found == 8);
    settings.skip = PM_PHOTON_FIRST;
    CHECK(pm_fields_ask(&map, &settings, &pm_fields_floor).found == 4);
    settings.skip = PM_PHOTON_FIRST | PM_PHOTON_CAUSTIC;
    CHECK(pm_fields_ask(&map, &settings, &pm_fields_floor).found == 2);
    pm_photon_map_free(&map);
}

static void scale_is_undone_exactly(void)
{
    // Lengths times 2^m and powers times 2^2m leave irradiance as it is, bit for bit.
    pm_photon_map unit = {.unpacked = true};
    pm_rng rng = pm_fields_rng(1);
    pm_fields_lay_out(&unit, &rng, 500, 1e9, true);
    for (int m = -20; m <= 20; m += 10) {
        for (int shape = 0; shape < 2; shape++) {
            pm_photon_map map = {.unpacked = true};
            double scale = exp2(m);
            for (uint32_t i = 0; i < unit.count; i++) {
                pm_photon_view photon = pm_store_unpack(&unit, i);
                pm_fields_push(&map, pm_vec_scale(photon.position, scale), photon.normal,
                               photon.power.c[0] * scale * scale);
            }
            pm_fields_finish(&map);
            pm_estimate_settings settings = pm_estimate_defaults();
            settings.shape = (pm_gather_shape)shape;
            settings.filter = PM_FILTER_CONE;
            settings.radius = 4.0;
            double want = pm_fields_ask(&unit, &settings, &pm_fields_floor).value.c[0];
            settings.radius = 4.0 * scale;
            pm_estimate got = pm_fields_ask(&map, &settings, &pm_fields_floor);
            CHECK(got.value.c[0] == want && got.radius == 4.0 * scale);
            pm_photon_map_free(&map);
        }
    }
    pm_photon_map_free(&unit);
}

// --- radiance and volume --------------------------------------------------------------------

static void diffuse_radiance_is_albedo_over_pi(void)
{
    pm_photon_map map = {.kind = PM_MAP_GLOBAL}; // packed: directions are coarse
    // Tilted: on an axis the bins of the polar angle end just at the floor.
    pm_frame frame = pm_frame_around(pm_vec_normalize(pm_vec(1.0, 2.0, 3.0)));
    int below = 0;
    for (int i = 0; i < 64; i++) {
        pm_rng rng = pm_fields_rng((uint64_t)i);
        double angle = 2.0 * PM_PI * pm_rng_draw(&rng);
        double away = pm_rng_draw(&rng);
        pm_vec3 out = pm_vec(cos(angle), sin(angle), 0.0);
        pm_vec3 graze = pm_vec(out.x, out.y, -1e-3);
        pm_deposit deposit = {.position = pm_frame_to_world(&frame, pm_vec_scale(out, away)),
                              .direction = pm_frame_to_world(&frame, graze),
                              .normal = frame.n,
                              .power = pm_rgb(1.0, 2.0, 4.0)};
        CHECK_OK(pm_store_push(&map, &deposit));
        below += pm_vec_dot(pm_store_unpack(&map, (uint32_t)i).direction, frame.n) > 0.0;
    }
    CHECK(below > 10); // packed, these come from behind the floor
    pm_fields_finish(&map);
    pm_estimate_point point = {{0.0, 0.0, 0.0}, frame.n};
    pm_lobes lobes = {.lobe = {{PM_LOBE_DIFFUSE, false, {{0.5, 0.25, 0.0}}}},
                      .count = 1,
                      .diffuse = true,
                      .wi = frame.n,
                      .normal = frame.n};
    pm_estimate_settings settings = pm_estimate_defaults();
    settings.k = 32;
    pm_neighbour scratch[32];
    pm_estimate radiance;
    CHECK_OK(pm_estimate_radiance(&map, &settings, &point, &lobes, scratch, &radiance));
    pm_spectrum irradiance = pm_fields_ask(&map, &settings, &point).value;
    CHECK_NEAR(radiance.value.c[0] / irradiance.c[0], 0.5 / PM_PI, 1e-14);
    CHECK_NEAR(radiance.value.c[1] / irradiance.c[1], 0.25 / PM_PI, 1e-14);
    CHECK(radiance.value.c[2] == 0.0 && irradiance.c[2] > 0.0);
    pm_photon_map_free(&map);
}

static void media_scatter_by_their_phase_function(void)
{
    pm_photon_map map = {.kind = PM_MAP_VOLUME, .unpacked = true};
    pm_fields_push(&map, pm_vec(0.1, 0.0, 0.0), pm_vec(0.0, 0.0, 0.0), 2.0); // flies along -z
    pm_fields_finish(&map);
    pm_estimate_settings settings = pm_estimate_defaults();
    settings.radius = 0.5;
    double density = 2.0 / (4.0 / 3.0 * PM_PI * 0.125);
    pm_medium medium = {.sigma_t = 3.0, .albedo = {{0.5, 0.8, 1.0}}};
    pm_neighbour scratch[100];
    pm_estimate got;
    pm_vec3 at = pm_vec(0.0, 0.0, 0.0);
    pm_vec3 onward = pm_vec(0.0, 0.0, -1.0);
    CHECK_OK(pm_estimate_volume(&map, &settings, at, &medium, onward, scratch, &got));
    CHECK_NEAR(got.value.c[1], 0.8 * density / (4.0 * PM_PI), 1e-14);
    medium.g = 0.5; // forward: (1 - g^2) / (4 pi (1 - g)^3)
    CHECK_OK(pm_estimate_volume(&map, &settings, at, &medium, onward, scratch, &got));
    CHECK_NEAR(got.value.c[0], 0.5 * density * 0.75 / (4.0 * PM_PI * 0.125), 1e-13);
    pm_vec3 back = pm_vec(0.0, 0.0, 1.0);
    CHECK_OK(pm_estimate_volume(&map, &settings, at, &medium, back, scratch, &got));
    CHECK_NEAR(got.value.c[0], 0.5 * density * 0.75 / (4.0 * PM_PI * 3.375), 1e-13);
    pm_photon_map_free(&map);
}

// --- refusals -------------------------------------------------------------------------------

static void refuse(const pm_photon_map *map, pm_estimate_settings settings, const char *why)
{
    pm_neighbour scratch[PM_FIELDS_K_MAX];
    pm_estimate before;
    memset(&before, 7, sizeof before);
    pm_estimate out = before;
    CHECK_FAILS(pm_estimate_irradiance(map, &settings, &pm_fields_floor, scratch, &out),
                PM_EINPUT, why);
    CHECK_FAILS(pm_estimate_volume(map, &settings, pm_fields_floor.at, NULL,
                                   pm_fields_floor.normal, scratch, &out),
                PM_EINPUT, why);
    CHECK(memcmp(&out, &before, sizeof out) == 0);
}

static void wrong_settings_are_refused(void)
{
    pm_photon_map map = {.unpacked = true};
    pm_fields_push(&map, pm_vec(0.1, 0.0, 0.0), pm_vec(0.0, 0.0, 1.0), 1.0);
    pm_estimate_settings settings = pm_estimate_defaults();
    refuse(&map, settings, "must be scaled");
    CHECK_OK(pm_store_scale(&map, 1));
    refuse(&map, settings, "must be balanced");
    CHECK_OK(pm_balance_build(&map));
    static const double radii[] = {0.0, -1.0, (double)NAN, 1e-300};
    for (int i = 0; i < 4; i++) {
        settings.radius = radii[i];
        refuse(&map, settings, "radius must be > 0");
    }
    settings = pm_estimate_defaults();
    static const double flats[] = {0.0, -0.1, 1.5, (double)NAN};
    for (int i = 0; i < 4; i++) {
        settings.flatness = flats[i];
        refuse(&map, settings, "flatness must lie in (0, 1]");
    }
    settings = pm_estimate_defaults();
    settings.k = 0;
    refuse(&map, settings, "k must be at least 1");
    pm_photon_map_free(&map);
}

PM_TESTS({"estimate.1", "no, one, two and three photons give what hand and rule say",
          few_photons_by_hand},
         {"estimate.2", "photons at one point give a finite answer",
          coincident_photons_stay_finite},
         {"estimate.3", "photons of the far side are left out, those of a wall are not",
          sides_are_told_by_normals},
         {"estimate.4", "walls at right angles keep each other's photons however turned",
          turned_walls_keep_their_corner},
         {"estimate.5", "a disc measures heights by its flatness",
          disc_measures_heights_by_flatness},
         {"estimate.6", "photons with a mark can be skipped", marked_photons_are_skipped},
         {"estimate.7", "scaling lengths and powers is undone bit for bit",
          scale_is_undone_exactly},
         {"estimate.8", "a diffuse surface sends albedo over pi of the irradiance",
          diffuse_radiance_is_albedo_over_pi},
         {"estimate.9", "media scatter by albedo and phase function",
          media_scatter_by_their_phase_function},
         {"estimate.10", "settings without a meaning are refused", wrong_settings_are_refused})

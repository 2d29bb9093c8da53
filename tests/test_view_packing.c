// Packing made visible: numbers against storage's report, dots against directions by hand.
#include "command.h"
#include "photon_file.h"
#include "photon_map.h"
#include "seen.h"
#include "store.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define VIEW "view packing {S} --size 640x480"

/// A map of one photon, exact values beside it unless `packed`.
static const char *write_map(const char *name, pm_vec3 direction, bool packed)
{
    pm_photon_map map = {.kind = PM_MAP_GLOBAL, .unpacked = !packed};
    pm_deposit deposit = {.direction = direction,
                          .normal = pm_vec(0.0, 0.0, 1.0),
                          .power = pm_rgb(1.0, 0.5, 0.25)};
    CHECK_OK(pm_store_push(&map, &deposit));
    CHECK_OK(pm_store_scale(&map, 1));
    pm_photon_file_info info = {0};
    const char *path = pm_command_path(name);
    CHECK_OK(pm_photon_file_write(path, &map, &info, NULL));
    pm_photon_map_free(&map);
    return path;
}

static pm_vec3 at_angles(double theta, double phi)
{
    return pm_vec(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
}

static void numbers_are_storages(void)
{
    static const char *const keys[] = {"angle_mean_deg", "angle_max_deg", "power_rms"};
    pm_test_ran ran = pm_command_run("storage {S} -n 300 --packing off -o {O} --json",
                                     "scenes/cornell-spheres.xml", pm_command_path("m.ply"));
    CHECK_THAT(ran.exit_code == 0, "%s", ran.err);
    json_t *report = json_loads(ran.out, 0, NULL);
    pm_seen s = pm_seen_look("view packing {S} {O} --size 640x480", pm_command_path("m.ply"),
                             pm_command_path("m.caustic.ply"));
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        char key[64];
        snprintf(key, sizeof key, "packing.%s", keys[i]);
        const json_t *want = json_object_get(json_object_get(report, "packing"), keys[i]);
        CHECK(json_is_real(want));
        CHECK_NEAR(pm_seen_number(&s, key), json_number_value(want), 0.0);
    }
    json_decref(report);
    pm_test_ran_free(&ran);
    pm_seen_free(&s);
}

/// Packing puts the direction into the middle of its cell, a step of 0.6 cells away.
static void both_directions_are_seen(void)
{
    const double cell = PM_PI / 256.0;
    const pm_vec3 exact = at_angles(127.2 * cell, 2.0 * cell * 1.9);
    const pm_vec3 middle = at_angles(127.5 * cell, 2.0 * cell * 1.5);
    pm_seen s = pm_seen_look(VIEW, write_map("one.ply", exact, false), "");
    CHECK_COLOUR(pm_seen_pixel(&s, 1, exact), 230.0, 159.0, 0.0, 8.0);
    CHECK_COLOUR(pm_seen_pixel(&s, 1, middle), 86.0, 180.0, 233.0, 8.0);
    CHECK_COLOUR(pm_seen_pixel(&s, 1, pm_vec_scale(pm_vec_add(exact, middle), 0.5)), 245.0,
                 245.0, 245.0, 90.0);
    double angle = acos(pm_vec_dot(exact, middle)) * 180.0 / PM_PI;
    CHECK_NEAR(pm_seen_number(&s, "packing.angle_max_deg"), angle, 1e-5);
    CHECK_CONTAINS(pm_seen_text(&s, "note"), "1 photons: direction off by ");
    pm_seen_free(&s);
}

static void poles_have_narrow_cells(void)
{
    const double cell = PM_PI / 256.0;
    const pm_vec3 exact = at_angles(255.1 * cell, 2.0 * cell * 64.9);
    pm_seen s = pm_seen_look(VIEW, write_map("pole.ply", exact, false), "");
    CHECK_COLOUR(pm_seen_pixel(&s, 2, exact), 230.0, 159.0, 0.0, 8.0);
    pm_seen_free(&s);
}

static void bars_stand_at_the_errors(void)
{
    const double cell = PM_PI / 256.0;
    const pm_vec3 exact = at_angles(127.2 * cell, 2.0 * cell * 1.9);
    pm_seen s = pm_seen_look(VIEW, write_map("one.ply", exact, false), "");
    double angle = pm_seen_number(&s, "packing.angle_max_deg");
    double bin = 0.8 / 40.0;
    double middle = (floor(angle / bin) + 0.5) * bin;
    int x = 0;
    int y = 0;
    pm_seen_chart(&s, 0, middle + 2.0 * bin, 50.0, &x, &y);
    CHECK(pm_seen_at(&s, x, y)[2] < 150);
    pm_seen_chart(&s, 0, middle, 50.0, &x, &y);
    const uint8_t sky[3] = {86, 180, 233};
    CHECK(pm_seen_near(&s, x, y, 2, sky, 6));
    pm_seen_free(&s);
}

static void packed_maps_have_nothing_to_compare(void)
{
    char line[256];
    const char *map = write_map("packed.ply", pm_vec(0.0, 0.0, 1.0), true);
    snprintf(line, sizeof line, "view packing {S} -o %s", pm_command_path("x.png"));
    int before = pm_command_count_files();
    pm_test_ran ran = pm_command_run(line, map, "");
    pm_command_check_refusal(
        line, &ran,
        "packed.ply: holds packed photons without the exact ones; write it "
        "with `storage --packing off");
    CHECK(pm_command_count_files() == before);
    pm_test_ran_free(&ran);
}

PM_TESTS({"view_packing.1", "errors of packing are those that storage reports",
          numbers_are_storages},
         {"view_packing.2", "an exact direction and the middle of its cell are joined",
          both_directions_are_seen},
         {"view_packing.3", "the patch around a pole is the one with the photons",
          poles_have_narrow_cells},
         {"view_packing.4", "the histogram's bar stands at the error",
          bars_stand_at_the_errors},
         {"view_packing.5", "a map of packed photons alone is refused",
          packed_maps_have_nothing_to_compare})

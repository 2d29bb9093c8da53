// Projection maps of whole scenes: which lights are aimed at what, when it pays, and that the
// maps traced with and without them hold the same light.
#include "projection.h"

#include "chance.h"
#include "map_power.h"
#include "photon_map.h"
#include "photon_pass.h"
#include "scenes.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

#include <omp.h>
#include <string.h>

/// A floor of side 4, a glass ball of radius 0.2 a little above it. Returns the glass.
static int ball_over_floor(pm_scenes *s)
{
    pm_scenes_begin(s);
    int white = pm_scenes_diffuse(s, pm_gray(0.5));
    int glass = pm_scenes_glass(s, 1.5);
    pm_scenes_wear(s, pm_scenes_square(4.0, 0.0, false), white);
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.3, 0.1, 0.25), 0.2), glass);
    return glass;
}

/// One light over it: 0 point, 1 spot, 2 rectangle, 3 sun, 4 disk.
static void light_it(pm_scenes *s, int which)
{
    static const double cone[2] = {0.3, 0.9};
    if (which == 0) {
        pm_scenes_point(s, pm_vec(0.5, -0.4, 2.0), pm_rgb(1.0, 2.0, 4.0));
    } else if (which == 1) {
        pm_scenes_spot(s, pm_vec(0.5, -0.4, 2.0), pm_vec(0.0, 0.0, -1.0), cone, pm_gray(2.0));
    } else if (which == 3) {
        pm_scenes_sun(s, pm_vec(0.3, 0.2, -1.0), pm_rgb(1.0, 2.0, 3.0));
    } else {
        pm_shape lamp =
            which == 2 ? pm_scenes_square(0.3, 1.5, true)
                       : pm_shapes_disk(pm_vec(0.2, 0.0, 1.5), pm_vec(0.0, 0.0, -1.0), 0.2);
        pm_scenes_lamp(s, pm_scenes_add(s, lamp, 0, PM_NONE), pm_gray(3.0));
    }
    pm_scenes_ready(s);
}

enum { REGIONS = 4 };

typedef struct {
    double power[REGIONS], variance[REGIONS]; // [W], channel 1, of a map's photons
    uint32_t count;
} regions;

/// By how near the ball's middle the photons lie.
static regions look_at(const pm_photon_map *map)
{
    static const double ends[REGIONS - 1] = {0.1, 0.3, 1.0};
    regions seen = {.count = map->count};
    for (uint32_t i = 0; i < map->count; i++) {
        const pm_photon *photon = &map->photons[i];
        double away =
            hypot((double)photon->position[0] - 0.3, (double)photon->position[1] - 0.1);
        double power = pm_store_power(map, i).c[1];
        int k = 0;
        while (k < REGIONS - 1 && away > ends[k]) {
            k++;
        }
        seen.power[k] += power;
        seen.variance[k] += power * power;
    }
    return seen;
}

static regions trace(const pm_scenes *s, pm_map_kind kind, const pm_projections *aim)
{
    pm_pass_settings settings = {.seed = 11, .count = 50000, .unpacked = true};
    settings.projections = aim == NULL ? NULL : pm_projection_of(aim);
    pm_photon_map map;
    pm_pass_report report;
    CHECK_OK(pm_photon_pass(&s->world, kind, &settings, &map, &report));
    CHECK_OK(pm_audit_check(&report.audit));
    pm_spectrum dark = aim == NULL ? pm_gray(0.0) : aim->dark;
    for (int c = 0; c < 3; c++) {
        double all = 0.0;
        for (int i = 0; i < s->scene.light_count; i++) {
            all += s->lights[i].flux.c[c];
        }
        CHECK_NEAR(report.audit.emitted.c[c] + dark.c[c], all, 1e-12 * all);
    }
    regions seen = look_at(&map);
    pm_photon_map_free(&map);
    pm_pass_report_free(&report);
    return seen;
}

/// Both ways; the photons a map holds are as many times more as the power sent is less.
static void compare(const pm_scenes *s, pm_map_kind kind)
{
    pm_projections aim;
    CHECK_OK(pm_projection_make(&s->scene, kind, &aim));
    CHECK(pm_projection_of(&aim) != NULL && aim.active > 0 && aim.active < aim.cells);
    CHECK(aim.sent <= 0.75);
    regions off = trace(s, kind, NULL);
    regions on = trace(s, kind, &aim);
    int judged = 0;
    for (int k = 0; k < REGIONS; k++) {
        double bound = 5.0 * sqrt(off.variance[k] + on.variance[k]);
        CHECK_NEAR(on.power[k], off.power[k], bound);
        judged += off.power[k] > 2.0 * bound;
        CHECK(on.variance[k] <= off.variance[k]);
    }
    CHECK_THAT(judged > 0, "no region holds enough photons to tell");
    double more = (double)on.count / off.count;
    CHECK_NEAR(more * aim.sent, 1.0, 5.0 * sqrt(2.0 / off.count));
    pm_projection_free(&aim);
}

static void caustics_agree_on_and_off(void)
{
    for (int which = 0; which < 5; which++) {
        pm_scenes s;
        ball_over_floor(&s);
        light_it(&s, which);
        compare(&s, PM_MAP_CAUSTIC);
        pm_scenes_free(&s);
    }
}

static void global_maps_agree_on_and_off(void)
{
    static const int aimed[2] = {0, 3};
    for (int i = 0; i < 2; i++) {
        pm_scenes s;
        ball_over_floor(&s);
        light_it(&s, aimed[i]);
        compare(&s, PM_MAP_GLOBAL);
        pm_scenes_free(&s);
    }
}

static void meshes_and_cylinders_agree_on_and_off(void)
{
    pm_scenes s;
    int glass = ball_over_floor(&s);
    s.shapes[1] = pm_shapes_torus(pm_vec(0.3, 0.1, 0.25), 0.3, 0.12, 8, 6);
    s.shapes[1].material[0] = s.shapes[1].material[1] = glass;
    pm_shape pipe = pm_shapes_cylinder(pm_vec(-0.5, 0.0, 0.1), pm_vec(0.0, 1.0, 0.0), 0.6, 0.1);
    pm_scenes_wear(&s, pipe, pm_scenes_mirror(&s, pm_gray(0.9)));
    light_it(&s, 0);
    compare(&s, PM_MAP_CAUSTIC);
    pm_scenes_free(&s);
}

// --- what is aimed, and when it pays

static void expect(const pm_scenes *s, pm_map_kind kind, bool aimed, const char *why)
{
    pm_projections aim;
    CHECK_OK(pm_projection_make(&s->scene, kind, &aim));
    CHECK_THAT((pm_projection_of(&aim) != NULL) == aimed, "aimed: %d; %s", !aimed, aim.why);
    CHECK_CONTAINS(aim.why, why);
    if (!aimed) {
        CHECK(aim.sent == 1.0 && aim.cells == 0 && aim.active == 0);
        CHECK(pm_spectrum_is_black(aim.dark) && pm_projection_saved(&aim, 1000) == 0);
    }
    pm_projection_free(&aim);
}

static void closed_rooms_are_lit_everywhere(void)
{
    pm_scenes s;
    pm_scenes_balls(&s);
    expect(&s, PM_MAP_GLOBAL, false, "no light gains");
    pm_scenes_free(&s);
    pm_scenes_lit_room(&s, 0.5);
    expect(&s, PM_MAP_GLOBAL, false, "no light gains");
    expect(&s, PM_MAP_CAUSTIC, true, "none is sent");
    pm_scenes_free(&s);
    pm_scenes_begin(&s);
    pm_scenes_globe(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_point(&s, pm_vec(0.3, 0.5, 0.1), pm_gray(1.0));
    pm_scenes_ready(&s);
    expect(&s, PM_MAP_GLOBAL, false, "no light gains");
    pm_scenes_free(&s);
}

static void aiming_must_pay(void)
{
    // A lamp aimed at the ball beside a sky, which cannot be: the sky's power decides.
    for (int strong = 0; strong < 2; strong++) {
        pm_scenes s;
        ball_over_floor(&s);
        pm_scenes_sky(&s, pm_gray(strong ? 1.0 : 1e-3));
        light_it(&s, 0);
        if (strong) {
            expect(&s, PM_MAP_CAUSTIC, false, "would save only");
        } else {
            expect(&s, PM_MAP_CAUSTIC, true, "aimed at");
        }
        pm_scenes_free(&s);
    }
}

static void null_and_black_things_are_no_targets(void)
{
    pm_scenes s;
    int glass = ball_over_floor(&s);
    s.materials[glass].specular_reflectance = pm_gray(0.0);
    s.materials[glass].specular_transmittance = pm_gray(0.0);
    light_it(&s, 0);
    expect(&s, PM_MAP_CAUSTIC, true, "none is sent");
    s.materials[glass].type = PM_BSDF_NULL;
    expect(&s, PM_MAP_CAUSTIC, true, "none is sent");
    s.materials[0].type = PM_BSDF_NULL;
    expect(&s, PM_MAP_GLOBAL, true, "none is sent");
    pm_scenes_free(&s);
}

static void darkness_is_no_reason_to_aim(void)
{
    pm_scenes s;
    ball_over_floor(&s);
    light_it(&s, 0);
    s.lights[0].flux = pm_gray(0.0);
    expect(&s, PM_MAP_CAUSTIC, false, "no light gains");
    pm_scenes_free(&s);
}

static void no_target_gives_an_empty_map(void)
{
    // A spot that looks away from the ball: its light can start no caustic.
    static const double cone[2] = {0.3, 0.5};
    pm_scenes s;
    ball_over_floor(&s);
    pm_scenes_spot(&s, pm_vec(0.0, 0.0, 2.0), pm_vec(0.0, 0.0, 1.0), cone, pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_projections aim;
    CHECK_OK(pm_projection_make(&s.scene, PM_MAP_CAUSTIC, &aim));
    CHECK(aim.active == 0 && aim.cells > 0 && aim.sent == 0.0);
    CHECK(pm_projection_saved(&aim, 0) == 0);
    pm_pass_settings settings = {.seed = 1, .count = 1000};
    settings.projections = pm_projection_of(&aim);
    pm_photon_map map;
    pm_pass_report report;
    CHECK_OK(pm_photon_pass(&s.world, PM_MAP_CAUSTIC, &settings, &map, &report));
    CHECK(map.count == 0 && map.emitted == 0 && map.scaled && report.emitted == 0);
    CHECK_OK(pm_audit_check(&report.audit));
    pm_trace_sink sink = {0};
    uint32_t light;
    CHECK_FAILS(pm_photon_replay(&s.world, PM_MAP_CAUSTIC, &settings, 0, &sink, &light),
                PM_EINPUT, "no light sends any power");
    pm_photon_map_free(&map);
    pm_pass_report_free(&report);
    pm_projection_free(&aim);
    pm_scenes_free(&s);
}

static void saved_photons_are_those_not_sent(void)
{
    pm_projections aim = {.sent = 0.25};
    CHECK(pm_projection_saved(&aim, 1000) == 3000);
    aim.sent = 1.0;
    CHECK(pm_projection_saved(&aim, 1000) == 0);
    aim.sent = 0.0;
    CHECK(pm_projection_saved(&aim, 0) == 0);
}

static void threads_change_no_aimed_byte(void)
{
    static const int threads[3] = {1, 2, 7};
    pm_scenes s;
    ball_over_floor(&s);
    pm_scenes_sky(&s, pm_gray(1e-5));
    light_it(&s, 0);
    pm_projections aim;
    CHECK_OK(pm_projection_make(&s.scene, PM_MAP_CAUSTIC, &aim));
    pm_pass_settings settings = {.seed = 2, .count = 20000};
    settings.projections = pm_projection_of(&aim);
    CHECK(settings.projections != NULL);
    pm_photon_map map[3];
    for (int i = 0; i < 3; i++) {
        omp_set_num_threads(threads[i]);
        CHECK_OK(pm_photon_pass(&s.world, PM_MAP_CAUSTIC, &settings, &map[i], NULL));
        CHECK(map[i].count > 1000 && map[i].count == map[0].count);
        CHECK(memcmp(map[i].photons, map[0].photons, map[0].count * sizeof(pm_photon)) == 0);
    }
    for (int i = 0; i < 3; i++) {
        pm_photon_map_free(&map[i]);
    }
    pm_projection_free(&aim);
    pm_scenes_free(&s);
}

PM_TESTS({"projection.10", "caustics by aimed lamps, spots, points and suns are those unaimed",
          caustics_agree_on_and_off},
         {"projection.11", "global maps of open scenes are the same aimed and unaimed",
          global_maps_agree_on_and_off},
         {"projection.12", "caustics of meshes and cylinders are the same aimed and unaimed",
          meshes_and_cylinders_agree_on_and_off},
         {"projection.13", "a light in a closed room sends everywhere, as before",
          closed_rooms_are_lit_everywhere},
         {"projection.14", "lights are aimed only when a quarter of all power is saved",
          aiming_must_pay},
         {"projection.15", "black glass and null surfaces are no targets",
          null_and_black_things_are_no_targets},
         {"projection.16", "lights of 0 W are not aimed", darkness_is_no_reason_to_aim},
         {"projection.17", "lights that reach no target give an empty map and no fault",
          no_target_gives_an_empty_map},
         {"projection.18", "photons saved are those not sent",
          saved_photons_are_those_not_sent},
         {"projection.19", "one, two and seven threads fill the same bytes when aimed",
          threads_change_no_aimed_byte})

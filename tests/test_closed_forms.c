// Photons end to end, from the lamp through the map to the estimate, where the answer is known
// in closed form.
#include "balance.h"
#include "chance.h"
#include "estimate.h"
#include "map_power.h"
#include "photon_map.h"
#include "photon_pass.h"
#include "scenes.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

#include <omp.h>
#include <stdlib.h>
#include <string.h>

/// A balanced map of `count` emitted photons, with powers as they were.
static pm_photon_map trace(const pm_scenes *s, pm_map_kind kind, uint64_t count,
                           pm_pass_report *report)
{
    pm_pass_settings settings = {.seed = 1, .count = count, .unpacked = true};
    pm_photon_map map;
    omp_set_num_threads(1); // the runner keeps the other cores busy
    CHECK_OK(pm_photon_pass(&s->world, kind, &settings, &map, report));
    CHECK_OK(pm_balance_build(&map));
    return map;
}

/// Point `i` of `count` spread evenly over the unit sphere.
static pm_vec3 spread(int i, int count)
{
    double z = 1.0 - (2.0 * i + 1.0) / count;
    double turn = 2.399963229728653 * i;
    double across = sqrt(1.0 - z * z);
    return pm_vec(across * cos(turn), across * sin(turn), z);
}

/// Mean irradiance at `count` points, less what photons of the flags `skip` bring.
static double mean_irradiance(const pm_photon_map *map, pm_estimate_settings settings,
                              const pm_estimate_point *points, int count)
{
    pm_neighbour *scratch = calloc(settings.k, sizeof *scratch);
    CHECK(scratch != NULL);
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        pm_estimate found;
        CHECK_OK(pm_estimate_irradiance(map, &settings, &points[i], scratch, &found));
        sum += pm_spectrum_mean(found.value);
    }
    free(scratch);
    return sum / count;
}

// --- the integrating sphere ------------------------------------------------------------------

static const double sphere_flux = 10.0;
static const double sphere_albedo = 0.6;
enum { SPHERE_PHOTONS = 200000, PROBES = 40 };

static void sphere_begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_globe(s, 1.0, pm_scenes_diffuse(s, pm_gray(sphere_albedo)));
    pm_scenes_point(s, pm_vec(0.4, 0.2, -0.1), pm_gray(sphere_flux));
    pm_scenes_ready(s);
}

static void sphere_probes(pm_estimate_point *points, int count)
{
    for (int i = 0; i < count; i++) {
        pm_vec3 out = spread(i, count);
        points[i] = (pm_estimate_point){out, pm_vec_negate(out)};
    }
}

static void photons_meet_walls_as_often_as_albedo_says(void)
{
    pm_scenes s;
    sphere_begin(&s);
    pm_pass_report report;
    pm_photon_map map = trace(&s, PM_MAP_GLOBAL, SPHERE_PHOTONS, &report);
    double rest = 1.0 - sphere_albedo;
    double hits = 1.0 / rest;
    double bound = pm_chance_bound(sphere_albedo / (rest * rest), SPHERE_PHOTONS);
    CHECK_NEAR((double)map.count / SPHERE_PHOTONS, hits, bound);
    pm_spectrum power = pm_map_power(&map);
    CHECK_NEAR(power.c[0], sphere_flux * hits, sphere_flux * bound);
    CHECK_NEAR(power.c[0], report.deposited.c[0], 1e-5 * power.c[0]); // floats in the map
    CHECK_NEAR(report.audit.escaped.c[0], 0.0, 0.0);
    pm_pass_report_free(&report);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

/// Variance of the photons past their first hit that land on a share `p` of the wall, per
/// emitted one. Their number M is geometric, so E[M (M - 1)] = 2 E[M]^2.
static double landing_variance(double p)
{
    double m = p * sphere_albedo / (1.0 - sphere_albedo);
    return m + 2.0 * m * m - m * m;
}

static void integrating_sphere_is_evenly_lit(void)
{
    pm_scenes s;
    sphere_begin(&s);
    pm_photon_map map = trace(&s, PM_MAP_GLOBAL, SPHERE_PHOTONS, NULL);
    pm_estimate_settings settings = pm_estimate_defaults();
    settings.shape = PM_GATHER_SPHERE; // a cap within the chord r has the area pi r^2 exactly
    settings.skip = PM_PHOTON_FIRST;
    double past_first = sphere_albedo / (1.0 - sphere_albedo);
    double want = past_first * sphere_flux / (4.0 * PM_PI);
    pm_estimate_point probes[PROBES];

    // A fixed reach that holds fewer than k.
    sphere_probes(probes, 3);
    settings.k = SPHERE_PHOTONS;
    settings.radius = 0.5;
    double share = 0.25 / 4.0;
    double spread_of_one = landing_variance(share) / (share * share * past_first * past_first);
    for (int i = 0; i < 3; i++) {
        double got = mean_irradiance(&map, settings, &probes[i], 1);
        CHECK_NEAR(got, want, want * pm_chance_bound(spread_of_one, SPHERE_PHOTONS));
    }

    // The k nearest, without a reach; the discs of all probes hold different photons.
    sphere_probes(probes, PROBES);
    settings.k = 2000;
    settings.radius = HUGE_VAL;
    double got = mean_irradiance(&map, settings, probes, PROBES);
    CHECK_NEAR(got, want, want * pm_chance_bound(1.0, PROBES * 2000.0));
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

// --- floors ----------------------------------------------------------------------------------

static void add_floor(pm_scenes *s, double width)
{
    pm_scenes_wear(s, pm_scenes_square(width, 0.0, false), pm_scenes_diffuse(s, pm_gray(0.5)));
}

static const pm_estimate_point under_the_lamp = {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};

// The square of side 1 sees an equal one at distance 1 with the form factor 0.199825; below its
// centre E = 0.239456 pi L.
static void square_light_lights_the_floor(void)
{
    enum { PHOTONS = 400000 };
    pm_scenes s;
    pm_scenes_begin(&s);
    add_floor(&s, 1.0);
    int lamp = pm_scenes_add(&s, pm_scenes_square(1.0, 1.0, true), PM_NONE, PM_NONE);
    pm_scenes_lamp(&s, lamp, pm_gray(2.0));
    pm_scenes_ready(&s);
    pm_photon_map map = trace(&s, PM_MAP_GLOBAL, PHOTONS, NULL);
    double share = 0.199825;
    CHECK_NEAR((double)map.count / PHOTONS, share,
               pm_chance_bound(share * (1.0 - share), PHOTONS) + 5e-7);
    CHECK_NEAR(pm_map_power(&map).c[1], 2.0 * PM_PI * (double)map.count / PHOTONS, 1e-4);

    pm_estimate_settings settings = pm_estimate_defaults();
    settings.k = PHOTONS;
    settings.radius = 0.1;
    double want = 0.239456 * PM_PI * 2.0;
    double caught = want * PM_PI * 0.01 / (2.0 * PM_PI) * PHOTONS;
    double got = mean_irradiance(&map, settings, &under_the_lamp, 1);
    CHECK_NEAR(got, want, want * (pm_chance_bound(1.0, caught) + 0.005)); // and the disc's blur
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

static void point_light_lights_the_floor(void)
{
    enum { PHOTONS = 400000 };
    pm_scenes s;
    pm_scenes_begin(&s);
    add_floor(&s, 1.0);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.5), pm_gray(6.0));
    pm_scenes_ready(&s);
    pm_photon_map map = trace(&s, PM_MAP_GLOBAL, PHOTONS, NULL);
    // The floor is a face of the unit cube about the light.
    CHECK_NEAR((double)map.count / PHOTONS, 1.0 / 6.0, pm_chance_bound(5.0 / 36.0, PHOTONS));
    pm_estimate_settings settings = pm_estimate_defaults();
    settings.k = 1000;
    double want = 6.0 / (4.0 * PM_PI * 0.25);
    double got = mean_irradiance(&map, settings, &under_the_lamp, 1);
    CHECK_NEAR(got, want, want * (pm_chance_bound(1.0, 1000.0) + 0.01)); // it falls off
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

static void even_light_is_read_without_bias(void)
{
    enum { PHOTONS = 100000, SIDE = 5 };
    const double radii[] = {0.18, 0.01};
    pm_scenes s;
    pm_scenes_begin(&s);
    add_floor(&s, 2.0);
    pm_scenes_sun(&s, pm_vec(3.0, 0.0, -4.0), pm_gray(2.0));
    pm_scenes_ready(&s);
    pm_photon_map map = trace(&s, PM_MAP_GLOBAL, PHOTONS, NULL);
    pm_estimate_point points[SIDE * SIDE];
    for (int i = 0; i < SIDE * SIDE; i++) {
        points[i] = under_the_lamp;
        points[i].at.x = 0.4 * (i % SIDE) - 0.8;
        points[i].at.y = 0.4 * (i / SIDE) - 0.8;
    }
    // Discs hold 1300 photons, or 4 and now and then none.
    for (int i = 0; i < 2; i++) {
        pm_estimate_settings settings = pm_estimate_defaults();
        settings.k = PHOTONS;
        settings.radius = radii[i];
        double want = 2.0 * 0.8;
        double disc = PM_PI * radii[i] * radii[i];
        double all = PM_PI * s.scene.radius * s.scene.radius;
        double caught = SIDE * SIDE * PHOTONS * disc * 0.8 / all;
        double got = mean_irradiance(&map, settings, points, SIDE * SIDE);
        CHECK_NEAR(got, want, want * pm_chance_bound(1.0, caught));
    }
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

// --- what a map holds ------------------------------------------------------------------------

enum { WATCHED = 20000 };

/// The way of one photon, in letters, and how its deposits were judged.
typedef struct {
    char met[64];
    size_t length;
    pm_map_kind kind;
    long direct, caustic, others;
    long wrong; // marked as what they are not, or in the wrong map
} witness;

static void note_event(void *context, const pm_start *start, const pm_event *event)
{
    (void)start;
    witness *w = context;
    if (event->scatter != 0 && event->kind == PM_EVENT_SURFACE) {
        CHECK(w->length + 1 < sizeof w->met);
        w->met[w->length++] = event->scatter;
    } else {
        w->length = 0;
    }
    w->met[w->length] = '\0';
}

static pm_status note_deposit(void *context, const pm_deposit *deposit)
{
    witness *w = context;
    bool first = w->length == 0;
    bool caustic = !first && strchr(w->met, 'D') == NULL;
    w->direct += first;
    w->caustic += caustic;
    w->others += !first && !caustic;
    bool belongs = caustic || w->kind == PM_MAP_GLOBAL;
    w->wrong += !belongs || deposit->first != first || deposit->caustic != caustic ||
                deposit->bounce != w->length;
    return PM_OK;
}

static witness watch(const pm_scenes *s, pm_map_kind kind)
{
    witness w = {.kind = kind};
    pm_pass_settings settings = {
        .seed = 1, .count = WATCHED, .tap = {&w, note_deposit, note_event}};
    pm_photon_map map;
    CHECK_OK(pm_photon_pass(&s->world, kind, &settings, &map, NULL));
    CHECK((long)map.count == w.direct + w.caustic + w.others);
    CHECK_THAT(w.wrong == 0, "%ld of %u deposits in map %d are not what they say", w.wrong,
               map.count, (int)kind);
    pm_photon_map_free(&map);
    return w;
}

static void maps_hold_their_class_of_paths(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_rgb(0.6, 0.5, 0.4)));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.4, 0.3, -0.4), 0.4), pm_scenes_glass(&s, 1.5));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(-0.4, -0.3, -0.5), 0.4),
                   pm_scenes_mirror(&s, pm_gray(0.9)));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.8), pm_gray(1.0));
    pm_scenes_ready(&s);
    witness global = watch(&s, PM_MAP_GLOBAL);
    CHECK(global.direct > 0 && global.caustic > 0 && global.others > 0);
    witness caustic = watch(&s, PM_MAP_CAUSTIC);
    CHECK(caustic.direct == 0 && caustic.caustic > 0 && caustic.others == 0);
    pm_scenes_free(&s);
}

static void without_glass_the_caustic_map_is_empty(void)
{
    pm_scenes s;
    sphere_begin(&s);
    witness caustic = watch(&s, PM_MAP_CAUSTIC);
    CHECK(caustic.direct + caustic.caustic + caustic.others == 0);
    pm_scenes_free(&s);
}

static void nothing_escapes_from_a_closed_box(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.4, 0.3, -0.4), 0.4), pm_scenes_glass(&s, 1.5));
    pm_scenes_point(&s, pm_vec(0.1, 0.0, 0.8), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_pass_report report;
    pm_photon_map map = trace(&s, PM_MAP_GLOBAL, 1000000, &report);
    CHECK(report.audit.ended_escaped == 0 && report.audit.photons == 1000000);
    CHECK(pm_spectrum_is_black(report.audit.escaped));
    CHECK_OK(pm_audit_check(&report.audit));
    pm_pass_report_free(&report);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

PM_TESTS({"closed.1", "hits per photon and power stored are 1 / (1 - rho) in a closed sphere",
          photons_meet_walls_as_often_as_albedo_says},
         {"closed.2", "an integrating sphere is evenly lit, wherever its lamp stands",
          integrating_sphere_is_evenly_lit},
         {"closed.3", "photons of a square light land by form factor and closed form",
          square_light_lights_the_floor},
         {"closed.4", "photons of a point light land by solid angle and distance",
          point_light_lights_the_floor},
         {"closed.5", "even light on a flat floor is read right at any radius",
          even_light_is_read_without_bias},
         {"closed.6", "every photon is marked, and mapped, as its path says",
          maps_hold_their_class_of_paths},
         {"closed.7", "where all is diffuse the caustic map is empty",
          without_glass_the_caustic_map_is_empty},
         {"closed.8", "of a million photons in a closed box with a glass ball none escapes",
          nothing_escapes_from_a_closed_box})

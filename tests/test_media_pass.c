// Whole passes through scenes with media: classes of paths, marks, books, threads, and lights
// that are aimed.
#include "photon_pass.h"

#include "chance.h"
#include "map_power.h"
#include "photon_map.h"
#include "projection.h"
#include "scenes.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

#include <omp.h>
#include <string.h>

enum { COUNT = 20000 };

/// A diffuse room full of coloured fog, with a glass ball in it and a point light.
static void foggy_room(pm_scenes *s)
{
    pm_scenes_begin(s);
    int fog = pm_scenes_medium(s, 0.6, pm_rgb(0.9, 0.7, 0.4), 0.3);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_rgb(0.7, 0.5, 0.3)));
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.3, 0.1, -0.4), 0.4), pm_scenes_glass(s, 1.5));
    pm_scenes_point(s, pm_vec(-0.2, 0.0, 0.6), pm_rgb(3.0, 2.0, 1.0));
    s->lights[0].medium = fog;
    pm_scenes_ready(s);
}

// --- classes of paths

/// Every deposit of a pass, by the path that led there.
typedef struct {
    char path[64];
    uint64_t current;
    uint64_t deposits, first, caustic, scattered; // scattered: behind a V event
    uint64_t done, done_in_medium;
} classes;

static void spell_event(void *context, const pm_start *start, const pm_event *event)
{
    classes *c = context;
    if (c->current != start->photon) {
        c->current = start->photon;
        c->path[0] = '\0';
    }
    bool done = event->kind == PM_EVENT_DONE;
    c->done += done;
    c->done_in_medium += done && event->medium != PM_NONE;
    CHECK((event->medium == PM_NONE) || event->hit == NULL);
    if (event->scatter != 0 && event->bounce + 1 < sizeof c->path) {
        c->path[event->bounce] = event->scatter;
        c->path[event->bounce + 1] = '\0';
    }
}

static pm_status spell_deposit(void *context, const pm_deposit *d)
{
    classes *c = context;
    if (c->current != d->photon) {
        c->current = d->photon;
        c->path[0] = '\0';
    }
    size_t length = strlen(c->path);
    bool caustic = length > 0 && strspn(c->path, "S") == length;
    CHECK_THAT(d->caustic == caustic, "path L%s: caustic mark is %d", c->path, d->caustic);
    CHECK_THAT(d->first == (length == 0), "path L%s: first mark is %d", c->path, d->first);
    c->deposits++;
    c->first += d->first;
    c->caustic += d->caustic;
    c->scattered += strchr(c->path, 'V') != NULL;
    return PM_OK;
}

static classes spell(const pm_scenes *s, pm_map_kind kind, pm_photon_map *map)
{
    classes c = {.current = UINT64_MAX};
    pm_pass_settings settings = {.seed = 3, .count = COUNT, .unpacked = true};
    settings.tap = (pm_trace_sink){&c, spell_deposit, spell_event};
    CHECK_OK(pm_photon_pass(&s->world, kind, &settings, map, NULL));
    CHECK(c.deposits == map->count);
    return c;
}

static void photons_of_a_volume_map(void)
{
    pm_scenes s;
    pm_photon_map map;
    foggy_room(&s);
    classes c = spell(&s, PM_MAP_VOLUME, &map);
    CHECK(c.first > 1000 && c.caustic > 100 && c.scattered > 1000); // LV LSSV LVV
    uint64_t first = 0;
    uint64_t caustic = 0;
    for (uint32_t i = 0; i < map.count; i++) {
        pm_photon_view photon = pm_store_unpack(&map, i);
        CHECK(pm_vec_length(photon.normal) == 0.0);
        CHECK(pm_vec_reach(photon.position) < 1.0);
        first += photon.first;
        caustic += photon.caustic;
    }
    CHECK(first == c.first && caustic == c.caustic);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

static void fog_makes_no_caustics(void)
{
    pm_scenes s;
    pm_photon_map global;
    pm_photon_map caustic;
    foggy_room(&s);
    classes all = spell(&s, PM_MAP_GLOBAL, &global);
    CHECK(all.scattered > 1000 && all.first > 1000); // LVD LD: marks are held against the path
    classes only = spell(&s, PM_MAP_CAUSTIC, &caustic);
    CHECK(only.caustic == only.deposits && only.deposits > 100);
    CHECK(only.scattered == 0 && only.done_in_medium > 1000 &&
          only.done > only.done_in_medium + 1000);
    pm_photon_map_free(&global);
    pm_photon_map_free(&caustic);
    pm_scenes_free(&s);
}

// --- books

static void books_close_in_fog(void)
{
    pm_scenes s;
    foggy_room(&s);
    for (pm_roulette_rule rule = PM_ROULETTE_MAX; rule <= PM_ROULETTE_AVERAGE; rule++) {
        pm_pass_settings settings = {.seed = 1, .count = COUNT, .rule = rule};
        pm_photon_map map;
        pm_pass_report report;
        CHECK_OK(pm_photon_pass(&s.world, PM_MAP_VOLUME, &settings, &map, &report));
        CHECK_OK(pm_audit_check(&report.audit));
        const pm_audit_medium *fog = &report.audit.media[0];
        CHECK(fog->collisions == report.deposits && map.refused == 0);
        CHECK(pm_spectrum_is_black(report.audit.escaped));
        for (int c = 0; c < 3; c++) {
            double absorbed = fog->absorbed.c[c];
            for (int i = 0; i < s.scene.shape_count; i++) {
                absorbed += report.audit.shapes[i].absorbed.c[c];
            }
            CHECK_NEAR(absorbed, s.lights[0].flux.c[c], 1e-12);
            CHECK_NEAR(fog->incident.c[c], report.deposited.c[c], 1e-12);
        }
        pm_photon_map_free(&map);
        pm_pass_report_free(&report);
    }
    pm_scenes_free(&s);
}

static void books_close_through_glass_that_disperses(void)
{
    pm_scenes s;
    foggy_room(&s);
    for (int i = 0; i < s.scene.material_count; i++) {
        bool glass = s.materials[i].type == PM_BSDF_DIELECTRIC;
        s.materials[i].glass = glass ? pm_glass_named("sf11") : NULL;
    }
    pm_pass_settings settings = {.seed = 1, .count = COUNT};
    pm_photon_map map;
    pm_pass_report report;
    CHECK_OK(pm_photon_pass(&s.world, PM_MAP_GLOBAL, &settings, &map, &report));
    CHECK_OK(pm_audit_check(&report.audit));
    for (int c = 0; c < 3; c++) {
        double sd = sqrt(report.audit.dispersion_variance.c[c]);
        CHECK(sd > 1e-3 * s.lights[0].flux.c[c]);
        CHECK(report.audit.dispersion.c[c] != 0.0);
        // A photon that went through glass may be any colour.
        CHECK_NEAR(report.audit.emitted.c[c], s.lights[0].flux.c[c], 1e-12);
    }
    pm_photon_map_free(&map);
    pm_pass_report_free(&report);
    pm_scenes_free(&s);
}

// --- threads and seeds

static void check_threads(const pm_scenes *s, pm_map_kind kind)
{
    static const int threads[3] = {1, 2, 7};
    pm_pass_settings settings = {.seed = 2, .count = 6000};
    pm_photon_map maps[3];
    pm_pass_report reports[3];
    for (int i = 0; i < 3; i++) {
        omp_set_num_threads(threads[i]);
        CHECK_OK(pm_photon_pass(&s->world, kind, &settings, &maps[i], &reports[i]));
        size_t bytes = maps[i].count * sizeof *maps[i].photons;
        CHECK(maps[i].count == maps[0].count && bytes > 0);
        CHECK_THAT(memcmp(maps[i].photons, maps[0].photons, bytes) == 0,
                   "map by %d threads differs", threads[i]);
        CHECK_THAT(memcmp(reports[i].audit.media, reports[0].audit.media,
                          sizeof *reports[i].audit.media) == 0,
                   "books by %d threads differ", threads[i]);
    }
    for (int i = 0; i < 3; i++) {
        pm_photon_map_free(&maps[i]);
        pm_pass_report_free(&reports[i]);
    }
}

static void threads_change_no_byte(void)
{
    pm_scenes s;
    foggy_room(&s);
    check_threads(&s, PM_MAP_VOLUME);
    check_threads(&s, PM_MAP_GLOBAL);
    pm_scenes_free(&s);
}

// --- scale

/// The foggy room with all lengths times `factor` and extinction over it.
static pm_photon_map scaled_map(double factor)
{
    pm_scenes s;
    foggy_room(&s);
    pm_intersector_free(&s.world);
    for (int i = 0; i < s.scene.shape_count; i++) {
        s.shapes[i] = pm_shapes_scaled(&s.shapes[i], factor);
    }
    s.lights[0].position = pm_vec_scale(s.lights[0].position, factor);
    s.media[0].sigma_t /= factor;
    pm_scenes_ready(&s);
    pm_pass_settings settings = {.seed = 5, .count = 2000, .unpacked = true};
    pm_photon_map map;
    CHECK_OK(pm_photon_pass(&s.world, PM_MAP_VOLUME, &settings, &map, NULL));
    pm_scenes_free(&s);
    return map;
}

static void lengths_by_powers_of_two(void)
{
    static const int powers[3] = {-20, 7, 20};
    pm_photon_map one = scaled_map(1.0);
    for (int i = 0; i < 3; i++) {
        float factor = (float)ldexp(1.0, powers[i]);
        pm_photon_map map = scaled_map((double)factor);
        CHECK(map.count == one.count && map.count > 0);
        CHECK(memcmp(map.exact, one.exact, map.count * sizeof *map.exact) == 0);
        for (uint32_t j = 0; j < map.count; j++) {
            for (int axis = 0; axis < 3; axis++) {
                CHECK(map.photons[j].position[axis] == factor * one.photons[j].position[axis]);
            }
        }
        pm_photon_map_free(&map);
    }
    pm_photon_map_free(&one);
}

// --- aiming

/// A small ball of fog, and a floor under it, below a point light outside.
static void ball_of_fog(pm_scenes *s)
{
    pm_scenes_begin(s);
    int fog = pm_scenes_medium(s, 3.0, pm_gray(0.8), 0.0);
    pm_scenes_wear(s, pm_scenes_square(1.2, 0.0, false), pm_scenes_diffuse(s, pm_gray(0.5)));
    pm_scenes_bound(s, pm_shapes_sphere(pm_vec(1.0, 0.0, 0.5), 0.4), fog, PM_NONE);
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(-1.0, 0.0, 0.5), 0.4), pm_scenes_null(s));
    pm_scenes_point(s, pm_vec(0.2, 0.1, 2.0), pm_rgb(4.0, 2.0, 1.0));
    pm_scenes_ready(s);
}

/// Power of a map and the variance of that sum, channel 1.
static double power_of(const pm_scenes *s, pm_map_kind kind, const pm_projections *aim,
                       double *variance)
{
    pm_pass_settings settings = {.seed = 4, .count = COUNT, .unpacked = true};
    settings.projections = aim == NULL ? NULL : pm_projection_of(aim);
    pm_photon_map map;
    pm_pass_report report;
    CHECK_OK(pm_photon_pass(&s->world, kind, &settings, &map, &report));
    CHECK_OK(pm_audit_check(&report.audit));
    double sum = 0.0;
    *variance = 0.0;
    for (uint32_t i = 0; i < map.count; i++) {
        double power = pm_store_power(&map, i).c[1];
        sum += power;
        *variance += 6.0 * power * power; // a photon collides some times, never on its own
    }
    pm_photon_map_free(&map);
    pm_pass_report_free(&report);
    return sum;
}

static void fog_is_aimed_at_by_its_bounds(void)
{
    pm_scenes s;
    ball_of_fog(&s);
    for (pm_map_kind kind = PM_MAP_GLOBAL; kind <= PM_MAP_VOLUME; kind += PM_MAP_VOLUME) {
        pm_projections aim;
        CHECK_OK(pm_projection_make(&s.scene, kind, &aim));
        CHECK(pm_projection_of(&aim) != NULL && aim.sent < 0.5);
        CHECK_CONTAINS(aim.why, "aimed at 2 shapes");
        double loose;
        double tight;
        double without = power_of(&s, kind, NULL, &loose);
        double with = power_of(&s, kind, &aim, &tight);
        CHECK(without > 5.0 * sqrt(loose));
        CHECK_NEAR(with, without, 5.0 * sqrt(loose + tight));
        pm_projection_free(&aim);
    }
    pm_scenes_free(&s);
}

static void lights_in_fog_send_everywhere(void)
{
    pm_scenes s;
    ball_of_fog(&s);
    s.lights[0].medium = 0; // fog is everywhere
    for (pm_map_kind kind = PM_MAP_GLOBAL; kind <= PM_MAP_VOLUME; kind += PM_MAP_VOLUME) {
        pm_projections aim;
        CHECK_OK(pm_projection_make(&s.scene, kind, &aim));
        CHECK(pm_projection_of(&aim) == NULL && aim.sent == 1.0);
        CHECK_CONTAINS(aim.why, "medium around the lights");
        pm_projection_free(&aim);
        s.media[0].sigma_t = 0.0; // as if it were not there
        CHECK_OK(pm_projection_make(&s.scene, kind, &aim));
        CHECK(pm_projection_of(&aim) != NULL);
        pm_projection_free(&aim);
        s.media[0].sigma_t = 3.0;
    }
    pm_scenes_free(&s);
}

static void nothing_but_fog_takes_photons(void)
{
    // No shape is met at all, and the map is full all the same.
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_scenes_square(1.0, 0.0, false), pm_scenes_null(&s));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 1.0), pm_gray(1.0));
    s.lights[0].medium = pm_scenes_medium(&s, 1.0, pm_gray(0.0), 0.0);
    pm_scenes_ready(&s);
    pm_projections aim;
    double variance;
    CHECK_OK(pm_projection_make(&s.scene, PM_MAP_VOLUME, &aim));
    CHECK_NEAR(power_of(&s, PM_MAP_VOLUME, &aim, &variance), 1.0, 1e-6);
    pm_projection_free(&aim);
    pm_scenes_free(&s);
}

PM_TESTS({"media_pass.1", "a volume map holds LV, LSSV and LVV, marked as such",
          photons_of_a_volume_map},
         {"media_pass.2", "what fog scatters onto walls is no caustic; the caustic pass ends",
          fog_makes_no_caustics},
         {"media_pass.3", "books close in coloured fog, and agree with the map",
          books_close_in_fog},
         {"media_pass.4", "books close through glass that disperses, in fog",
          books_close_through_glass_that_disperses},
         {"media_pass.5", "one, two and seven threads fill the same volume map",
          threads_change_no_byte},
         {"media_pass.9", "lengths by a power of two, extinction by its inverse: the same bits",
          lengths_by_powers_of_two},
         {"media_pass.6",
          "lights outside media are aimed at what bounds them, and lose nothing",
          fog_is_aimed_at_by_its_bounds},
         {"media_pass.7", "a light in a medium sends everywhere, unless it takes nothing",
          lights_in_fog_send_everywhere},
         {"media_pass.8", "where only fog takes photons, they are sent",
          nothing_but_fog_takes_photons})

// Passes as a whole: the same bytes for any number of threads, presets that stop with the right
// photon, books, memory, and failures that leave nothing behind.
#include "photon_pass.h"

#include "caps.h"
#include "interrupt.h"
#include "map_power.h"
#include "photon_map.h"
#include "scenes.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

#include <malloc.h>
#include <omp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void run(const pm_scenes *s, pm_map_kind kind, pm_pass_settings settings,
                pm_photon_map *map, pm_pass_report *report)
{
    CHECK_OK(pm_photon_pass(&s->world, kind, &settings, map, report));
}

static bool same_bytes(const pm_photon_map *a, const pm_photon_map *b)
{
    size_t exact = a->unpacked ? a->count * sizeof *a->exact : 0;
    return a->count == b->count && a->emitted == b->emitted && a->scale == b->scale &&
           memcmp(a->photons, b->photons, a->count * sizeof *a->photons) == 0 &&
           (exact == 0 || memcmp(a->exact, b->exact, exact) == 0);
}

static bool same_power(const pm_spectrum *a, const pm_spectrum *b)
{
    return memcmp(a, b, sizeof *a) == 0;
}

static bool same_books(const pm_audit *a, const pm_audit *b)
{
    size_t shapes = (size_t)a->scene->shape_count * sizeof *a->shapes;
    size_t media = (size_t)a->scene->medium_count * sizeof *a->media;
    return a->photons == b->photons && a->events == b->events &&
           memcmp(a->bounces, b->bounces, sizeof a->bounces) == 0 &&
           same_power(&a->emitted, &b->emitted) && same_power(&a->absorbed, &b->absorbed) &&
           same_power(&a->escaped, &b->escaped) && same_power(&a->lost, &b->lost) &&
           same_power(&a->roulette, &b->roulette) &&
           same_power(&a->roulette_variance, &b->roulette_variance) &&
           same_power(&a->dispersion, &b->dispersion) &&
           same_power(&a->dispersion_variance, &b->dispersion_variance) &&
           memcmp(a->shapes, b->shapes, shapes) == 0 && memcmp(a->media, b->media, media) == 0;
}

static void check_threads(pm_map_kind kind, pm_pass_settings settings)
{
    static const int threads[3] = {1, 2, 7};
    pm_scenes s;
    pm_scenes_balls(&s);
    pm_photon_map maps[3];
    pm_pass_report reports[3];
    for (int i = 0; i < 3; i++) {
        omp_set_num_threads(threads[i]);
        run(&s, kind, settings, &maps[i], &reports[i]);
        CHECK(maps[i].count > 100);
        CHECK_THAT(same_bytes(&maps[i], &maps[0]), "map by %d threads differs", threads[i]);
        CHECK_THAT(same_books(&reports[i].audit, &reports[0].audit),
                   "books by %d threads differ", threads[i]);
        CHECK(same_power(&reports[i].deposited, &reports[0].deposited));
    }
    for (int i = 0; i < 3; i++) {
        pm_photon_map_free(&maps[i]);
        pm_pass_report_free(&reports[i]);
    }
    pm_scenes_free(&s);
}

static void threads_change_no_byte(void)
{
    check_threads(PM_MAP_GLOBAL, (pm_pass_settings){.seed = 1, .count = 10000});
    check_threads(PM_MAP_CAUSTIC,
                  (pm_pass_settings){.seed = 2, .count = 10000, .unpacked = true});
    check_threads(PM_MAP_GLOBAL,
                  (pm_pass_settings){.seed = 3, .count = 100000, .stored = 10000});
}

static void other_seeds_other_photons(void)
{
    const pm_pass_settings base = {.seed = 1, .count = 500};
    pm_pass_settings seed = base;
    seed.seed = 2;
    pm_pass_settings pass = base;
    pass.pass = 1;
    pm_scenes s;
    pm_scenes_balls(&s);
    pm_photon_map maps[4];
    run(&s, PM_MAP_GLOBAL, base, &maps[0], NULL);
    run(&s, PM_MAP_GLOBAL, base, &maps[1], NULL);
    run(&s, PM_MAP_GLOBAL, seed, &maps[2], NULL);
    run(&s, PM_MAP_GLOBAL, pass, &maps[3], NULL);
    CHECK(same_bytes(&maps[0], &maps[1]));
    CHECK(!same_bytes(&maps[0], &maps[2]));
    CHECK(!same_bytes(&maps[0], &maps[3]));
    CHECK(!same_bytes(&maps[2], &maps[3]));
    for (int i = 0; i < 4; i++) {
        pm_photon_map_free(&maps[i]);
    }
    pm_scenes_free(&s);
}

// --- books and memory

static void books_match_the_scene(void)
{
    enum { COUNT = 20000 };
    pm_scenes s;
    pm_scenes_balls(&s);
    pm_pass_settings settings = {.seed = 1, .count = COUNT, .unpacked = true};
    pm_photon_map map;
    pm_pass_report report;
    run(&s, PM_MAP_GLOBAL, settings, &map, &report);
    CHECK_OK(pm_audit_check(&report.audit));
    CHECK(report.emitted == COUNT && report.deposits == map.count && map.refused == 0);
    CHECK(report.share[0] + report.share[1] == COUNT);
    CHECK(map.scaled && map.capacity == map.count);
    pm_spectrum stored = pm_map_power(&map);
    for (int c = 0; c < 3; c++) {
        double flux = s.lights[0].flux.c[c] + s.lights[1].flux.c[c];
        CHECK_NEAR(report.audit.emitted.c[c], flux, 1e-12 * flux);
        double incident = 0.0;
        double absorbed = 0.0;
        for (int i = 0; i < s.scene.shape_count; i++) {
            bool diffuse = s.shapes[i].material[0] == 0;
            incident += diffuse ? report.audit.shapes[i].incident.c[c] : 0.0;
            absorbed += report.audit.shapes[i].absorbed.c[c];
        }
        CHECK_NEAR(incident, report.deposited.c[c], 1e-12 * incident);
        CHECK_NEAR(absorbed, report.audit.absorbed.c[c], 1e-12 * flux);
        CHECK_NEAR(stored.c[c], incident, 1e-7 * incident); // kept as float
    }
    CHECK(report.audit.ended_absorbed == COUNT && report.audit.ended_escaped == 0);
    pm_photon_map_free(&map);
    pm_pass_report_free(&report);
    pm_scenes_free(&s);
}

static void books_close_by_either_rule(void)
{
    pm_scenes s;
    pm_scenes_balls(&s);
    for (int rule = PM_ROULETTE_MAX; rule <= PM_ROULETTE_AVERAGE; rule++) {
        for (uint32_t seed = 1; seed <= 10; seed++) {
            pm_pass_settings settings = {.seed = seed, .count = 3000};
            settings.rule = (pm_roulette_rule)rule;
            pm_map_kind kind = seed % 2 ? PM_MAP_GLOBAL : PM_MAP_CAUSTIC;
            pm_photon_map map;
            pm_pass_report report;
            run(&s, kind, settings, &map, &report);
            CHECK_OK(pm_audit_check(&report.audit));
            CHECK(pm_spectrum_max(report.audit.roulette_variance) > 0.0);
            pm_photon_map_free(&map);
            pm_pass_report_free(&report);
        }
    }
    pm_scenes_free(&s);
}

/// What tracing holds at most, in bytes a photon stored so far.
typedef struct {
    size_t before;
    uint64_t deposits;
    double most;
} scale_of_memory;

static size_t bytes_held(void)
{
    struct mallinfo2 info = mallinfo2(); // all zero under sanitizers
    return info.hblkhd + info.uordblks;
}

static pm_status weigh(void *context, const pm_deposit *deposit)
{
    (void)deposit;
    scale_of_memory *scale = context;
    if (++scale->deposits > 100000 && scale->deposits % 16 == 0) {
        double held = (double)(bytes_held() - scale->before);
        scale->most = fmax(scale->most, held / (double)scale->deposits);
    }
    return PM_OK;
}

static void tracing_holds_little_more_than_the_map(void)
{
    pm_scenes s;
    pm_scenes_lit_room(&s, 0.8);
    scale_of_memory scale = {.before = bytes_held()};
    pm_pass_settings settings = {.seed = 1, .count = 60000};
    settings.tap = (pm_trace_sink){&scale, weigh, NULL};
    pm_photon_map map;
    run(&s, PM_MAP_GLOBAL, settings, &map, NULL);
    CHECK(map.count > 250000);
    // Each thread's chunk, some 0.2 MB, is part of it: at 100,000 photons 2 bytes each.
    CHECK_THAT(scale.most <= 1.5 * sizeof(pm_photon), "%g bytes a photon while tracing",
               scale.most);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

// --- caps

static void caps_follow_the_albedos(void)
{
    static const struct {
        double albedo;
        uint32_t asked, bounces, specular;
    } cases[5] = {{0.5, 0, UINT32_MAX, 1000},
                  {0.9999, 0, UINT32_MAX, 1000},
                  {0.99991, 0, 10000, 1000},
                  {1.0, 0, 10000, 1000},
                  {1.0, 7, 7, 7}};
    for (int i = 0; i < 5; i++) {
        pm_scenes s;
        pm_scenes_lit_room(&s, cases[i].albedo);
        pm_caps caps = pm_caps_of(&s.scene, cases[i].asked);
        CHECK(caps.bounces == cases[i].bounces && caps.specular == cases[i].specular);
        pm_scenes_free(&s);
    }
}

static void white_room_ends_by_its_cap(void)
{
    enum { COUNT = 20 };
    pm_scenes s;
    pm_scenes_lit_room(&s, 1.0);
    pm_photon_map map;
    pm_pass_report report;
    run(&s, PM_MAP_GLOBAL, (pm_pass_settings){.seed = 1, .count = COUNT}, &map, &report);
    CHECK(map.count == COUNT * 10001 && report.audit.ended_lost == COUNT);
    CHECK_NEAR(report.audit.lost.c[0], 3.0, 1e-12);
    CHECK_NEAR(report.audit.absorbed.c[0], 0.0, 1e-12);
    CHECK_OK(pm_audit_check(&report.audit));
    pm_photon_map_free(&map);
    pm_pass_report_free(&report);
    pm_scenes_free(&s);
}

// --- failures

static void failures_tell_their_own_message(void)
{
    // Whatever an earlier pass left in the threads.
    omp_set_num_threads(4);
    pm_scenes s;
    pm_scenes_lit_room(&s, 0.5);
    pm_pass_settings settings = {.seed = 1, .count = 20000};
    pm_photon_map map = {.count = 77};
    for (int type = 70; type < 90; type++) {
        char words[32];
        snprintf(words, sizeof words, "unknown light type %d", type);
        s.lights[0].type = (pm_light_type)type;
        CHECK_FAILS(pm_photon_pass(&s.world, PM_MAP_GLOBAL, &settings, &map, NULL), PM_EINPUT,
                    words);
    }
    CHECK(map.count == 77 && map.photons == NULL);
    pm_scenes_free(&s);
}

/// The events of one photon: how many, and a sum that any change of one would change.
typedef struct {
    uint64_t photon;
    uint32_t events;
    double sum;
} retold;

static void retell(void *context, const pm_start *start, const pm_event *event)
{
    retold *r = context;
    if (start->photon == r->photon) {
        r->events++;
        r->sum += r->events * (event->position.x + event->carried.c[1] + (double)event->bounce);
    }
}

static void replay_repeats_the_pass(void)
{
    pm_scenes s;
    pm_scenes_lit_room(&s, 0.8);
    for (uint64_t photon = 0; photon < 3000; photon += 997) {
        retold in_pass = {.photon = photon};
        retold alone = {.photon = photon};
        pm_pass_settings settings = {.seed = 3, .count = 3000, .tap = {&in_pass, NULL, retell}};
        pm_photon_map map;
        uint32_t light;
        CHECK_OK(pm_photon_pass(&s.world, PM_MAP_GLOBAL, &settings, &map, NULL));
        pm_photon_map_free(&map);
        pm_trace_sink sink = {.context = &alone, .event = retell};
        CHECK_OK(pm_photon_replay(&s.world, PM_MAP_GLOBAL, &settings, photon, &sink, &light));
        CHECK(in_pass.events > 0 && in_pass.events == alone.events);
        CHECK_NEAR(alone.sum, in_pass.sum, 0.0);
        CHECK_FAILS(pm_photon_replay(&s.world, PM_MAP_GLOBAL, &settings, 3000, &sink, &light),
                    PM_EINPUT, "no photon 3000");
    }
    pm_scenes_free(&s);
}

static void darkness_gives_an_empty_map(void)
{
    pm_scenes s;
    pm_scenes_lit_room(&s, 0.5);
    s.lights[0].flux = pm_gray(0.0);
    pm_pass_settings settings = {.seed = 1, .count = 20000};
    pm_photon_map map;
    pm_pass_report report;
    CHECK_OK(pm_photon_pass(&s.world, PM_MAP_GLOBAL, &settings, &map, &report));
    CHECK(map.count == 0 && map.emitted == 0 && map.scaled && report.emitted == 0);
    CHECK_OK(pm_audit_check(&report.audit));
    pm_pass_report_free(&report);
    pm_scenes_free(&s);
}

static pm_status refuse_late(void *context, const pm_deposit *deposit)
{
    (void)context;
    return deposit->photon < 3000 ? PM_OK : pm_status_fail(PM_EIO, "dump.csv: disk is full");
}

static void tap_can_stop(void)
{
    pm_scenes s;
    pm_scenes_lit_room(&s, 0.5);
    pm_pass_settings settings = {.seed = 1, .count = 20000};
    settings.tap.deposit = refuse_late;
    pm_photon_map map = {.count = 77};
    CHECK_FAILS(pm_photon_pass(&s.world, PM_MAP_GLOBAL, &settings, &map, NULL), PM_EIO,
                "disk is full");
    CHECK(map.count == 77);
    pm_scenes_free(&s);
}

static void interrupt_stops_a_pass(void)
{
    pm_scenes s;
    pm_scenes_lit_room(&s, 0.5);
    pm_interrupt_catch();
    raise(SIGINT);
    pm_pass_settings settings = {.seed = 1, .count = 20000};
    pm_photon_map map = {.count = 77};
    CHECK_FAILS(pm_photon_pass(&s.world, PM_MAP_GLOBAL, &settings, &map, NULL), PM_ESTOPPED,
                "stopped");
    CHECK(map.count == 77);
    pm_scenes_free(&s);
}

PM_TESTS({"photon_pass.1", "one, two and seven threads fill the same bytes and books",
          threads_change_no_byte},
         {"photon_pass.2", "the same seed gives the same photons, another seed or pass others",
          other_seeds_other_photons},
         {"photon_pass.6", "the books agree with the lights, the shapes and the map",
          books_match_the_scene},
         {"photon_pass.7", "the books close by either roulette rule",
          books_close_by_either_rule},
         {"photon_pass.8", "tracing holds at most half more than the finished map",
          tracing_holds_little_more_than_the_map},
         {"photon_pass.9", "caps follow the brightest albedo unless they are given",
          caps_follow_the_albedos},
         {"photon_pass.10", "a white room ends by its cap and loses all its power",
          white_room_ends_by_its_cap},
         {"photon_pass.11", "a failed pass tells its own fault and leaves the map alone",
          failures_tell_their_own_message},
         {"photon_pass.12", "a tap's refusal stops the pass", tap_can_stop},
         {"photon_pass.13", "an interrupt stops the pass", interrupt_stops_a_pass},
         {"photon_pass.20", "without power there is an empty map and no fault",
          darkness_gives_an_empty_map},
         {"photon_pass.21", "a photon replayed alone does what it did in the pass",
          replay_repeats_the_pass})

// Presets name stored photons: a pass that stops with the photon that fills the number, and
// what a tap sees of it.
#include "photon_pass.h"

#include "photon_map.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <stdlib.h>
#include <string.h>

static void run(const pm_scenes *s, pm_map_kind kind, pm_pass_settings settings,
                pm_photon_map *map, pm_pass_report *report)
{
    CHECK_OK(pm_photon_pass(&s->world, kind, &settings, map, report));
}

/// What a tap saw.
typedef struct {
    uint64_t deposits, ended, *photon, room;
    uint64_t last;
    bool disorder;
    float *x;
} witness;

static pm_status witness_deposit(void *context, const pm_deposit *deposit)
{
    witness *w = context;
    if (w->deposits < w->room) {
        w->photon[w->deposits] = deposit->photon;
        w->x[w->deposits] = (float)deposit->position.x;
    }
    w->deposits++;
    return PM_OK;
}

static void witness_event(void *context, const pm_start *start, const pm_event *event)
{
    witness *w = context;
    w->disorder = w->disorder || start->photon < w->last;
    w->last = start->photon;
    w->ended += event->scatter == 0;
}

static witness witness_make(uint64_t room)
{
    witness w = {.room = room};
    w.photon = calloc(room, sizeof *w.photon);
    w.x = calloc(room, sizeof *w.x);
    CHECK(w.photon != NULL && w.x != NULL);
    return w;
}

static void witness_free(witness *w)
{
    free(w->photon);
    free(w->x);
}

static void check_preset(const pm_scenes *s, const pm_photon_map *full, const witness *all,
                         uint64_t stored)
{
    // All deposits of the photon that fills the number belong to the map.
    uint64_t last = all->photon[stored - 1];
    uint64_t count = stored;
    while (count < all->deposits && all->photon[count] == last) {
        count++;
    }
    pm_photon_map map;
    pm_pass_report report;
    run(s, PM_MAP_GLOBAL, (pm_pass_settings){.seed = 1, .count = 30000, .stored = stored}, &map,
        &report);
    CHECK_NEAR((double)map.count, (double)count, 0.0);
    CHECK(report.emitted == last + 1 && map.emitted == last + 1);
    CHECK(report.audit.photons == last + 1 && report.deposits == count);
    CHECK(memcmp(map.photons, full->photons, count * sizeof *map.photons) == 0);
    CHECK_NEAR(map.scale, 1.0 / (double)(last + 1), 1e-15);
    CHECK_OK(pm_audit_check(&report.audit));
    pm_photon_map_free(&map);
    pm_pass_report_free(&report);
}

static void presets_stop_with_the_right_photon(void)
{
    static const uint64_t wanted[6] = {1, 2, 1000, 2500, 10000, 50000};
    pm_scenes s;
    pm_scenes_balls(&s);
    witness all = witness_make(200000);
    pm_pass_settings settings = {.seed = 1, .count = 30000};
    settings.tap = (pm_trace_sink){&all, witness_deposit, witness_event};
    pm_photon_map full;
    run(&s, PM_MAP_GLOBAL, settings, &full, NULL);
    CHECK(all.deposits == full.count && all.deposits <= all.room && !all.disorder);
    CHECK(all.ended == 30000);
    for (int i = 0; i < 6; i++) {
        check_preset(&s, &full, &all, wanted[i]);
    }
    witness_free(&all);
    pm_photon_map_free(&full);
    pm_scenes_free(&s);
}

static void tap_sees_what_is_stored(void)
{
    // Each photon once, in order, and none beyond the one that fills the number.
    for (uint64_t stored = 0; stored <= 5000; stored += 2500) {
        pm_scenes s;
        pm_scenes_balls(&s);
        witness w = witness_make(20000);
        pm_pass_settings settings = {.seed = 1, .count = 5000, .stored = stored};
        settings.tap = (pm_trace_sink){&w, witness_deposit, witness_event};
        pm_photon_map map;
        pm_pass_report report;
        run(&s, PM_MAP_GLOBAL, settings, &map, &report);
        CHECK_NEAR((double)w.deposits, (double)map.count, 0.0);
        CHECK_NEAR((double)w.ended, (double)report.emitted, 0.0);
        CHECK(!w.disorder && w.last + 1 == report.emitted);
        for (uint32_t i = 0; i < map.count; i++) {
            CHECK(map.photons[i].position[0] == w.x[i]);
        }
        witness_free(&w);
        pm_photon_map_free(&map);
        pm_pass_report_free(&report);
        pm_scenes_free(&s);
    }
}

static void unreachable_presets_give_up(void)
{
    pm_scenes s;
    pm_scenes_lit_room(&s, 0.5); // nothing specular: no caustic photon ever
    pm_pass_settings settings = {.seed = 1, .count = 5000, .stored = 50};
    pm_photon_map map = {.count = 77};
    pm_pass_report report = {.emitted = 77};
    CHECK_FAILS(pm_photon_pass(&s.world, PM_MAP_CAUSTIC, &settings, &map, &report), PM_ELIMIT,
                "test.xml: 50 photons were to be stored, but 5000 emitted ones gave only 0");
    CHECK(map.count == 77 && report.emitted == 77 && report.share == NULL);
    settings.stored = 0;
    run(&s, PM_MAP_CAUSTIC, settings, &map, NULL); // an empty map is no fault
    CHECK(map.count == 0 && map.emitted == 5000 && map.scaled);
    pm_photon_map_free(&map);
    pm_scenes_free(&s);
}

PM_TESTS({"photon_pass.3", "a preset stops with the photon that fills its number",
          presets_stop_with_the_right_photon},
         {"photon_pass.4", "a tap sees each photon that counts once, in order",
          tap_sees_what_is_stored},
         {"photon_pass.5", "a preset that cannot be filled gives up with a line",
          unreachable_presets_give_up})

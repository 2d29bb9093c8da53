// A photon's life: what is deposited with which marks, what is passed, how paths end.
#include "trace.h"

#include "chance.h"
#include "ledger.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

#include <stdlib.h>
#include <string.h>

static void globe_scene(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_globe(s, 1.0, pm_scenes_diffuse(s, pm_gray(0.6)));
    pm_scenes_point(s, pm_vec(0.0, 0.3, 0.4), pm_gray(1.0));
    pm_scenes_ready(s);
}

// --- rooms

static void closed_room_keeps_its_light(void)
{
    enum { COUNT = 100000 };
    pm_scenes s;
    pm_ledger l;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.7)));
    int lamp =
        pm_scenes_add(&s, pm_scenes_square(0.5, 1.0, true), 0, PM_NONE); // in the ceiling
    pm_scenes_lamp(&s, lamp, pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    l.check_path = true;
    pm_ledger_trace(&s, &tracing, COUNT);
    CHECK(l.escaped == 0 && l.absorbed == COUNT);
    double rho = 0.7;
    CHECK_NEAR((double)l.deposits / COUNT, 1.0 / (1.0 - rho),
               pm_chance_bound(rho / ((1.0 - rho) * (1.0 - rho)), COUNT));
    pm_scenes_free(&s);
}

/// No photon of a lamp in the ceiling plane meets the ceiling before anything else.
static pm_status not_the_ceiling(void *context, const pm_deposit *d)
{
    uint64_t *first = context;
    if (d->first) {
        CHECK(d->position.z < 1.0 - 1e-9);
        CHECK_NEAR(pm_vec_length(d->direction), 1.0, 1e-14);
        ++*first;
    }
    return PM_OK;
}

static void flush_lamp_does_not_hit_its_wall(void)
{
    uint64_t first = 0;
    pm_scenes s;
    pm_ledger l;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_lamp(&s, pm_scenes_add(&s, pm_scenes_square(2.0, 1.0, true), 0, 0), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    tracing.sink = (pm_trace_sink){&first, not_the_ceiling, NULL};
    pm_ledger_trace(&s, &tracing, 50000);
    CHECK(first == 50000);
    pm_scenes_free(&s);
}

static void black_floor_keeps_its_photons(void)
{
    pm_scenes s;
    pm_ledger l;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.0)));
    pm_scenes_point(&s, pm_vec(0.2, 0.1, 0.0), pm_gray(2.0));
    pm_scenes_ready(&s);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    pm_ledger_trace(&s, &tracing, 10000);
    CHECK(l.deposits == 10000 && l.first == 10000 && l.absorbed == 10000);
    CHECK_NEAR(l.direct.c[0], 20000.0, 1e-8);
    pm_scenes_free(&s);
}

static pm_status has_power(void *context, const pm_deposit *deposit)
{
    (void)context;
    CHECK(!pm_spectrum_is_black(deposit->power));
    return PM_OK;
}

static void photons_without_power_end(void)
{
    // So rough a mirror draws many directions below itself.
    pm_scenes s;
    pm_ledger l;
    pm_scenes_begin(&s);
    pm_scenes_room(&s, 1.0, pm_scenes_rough_mirror(&s, PM_MICROFACET_GGX, 1.0));
    pm_scenes_point(&s, pm_vec(0.2, 0.1, -0.95), pm_gray(2.0));
    pm_scenes_ready(&s);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    tracing.max_bounces = 20;
    tracing.sink.deposit = has_power;
    pm_ledger_trace(&s, &tracing, 2000);
    CHECK(l.absorbed > 200 && l.escaped == 0);
    pm_scenes_free(&s);
}

static void back_of_a_sheet_absorbs(void)
{
    for (int above = 0; above < 2; above++) {
        pm_scenes s;
        pm_ledger l;
        pm_scenes_begin(&s);
        int white = pm_scenes_diffuse(&s, pm_gray(0.5));
        pm_scenes_add(&s, pm_scenes_square(1e3, 0.0, false), white, PM_NONE);
        pm_scenes_sun(&s, pm_vec(0.3, 0.0, above ? -1.0 : 1.0), pm_gray(1.0));
        pm_scenes_ready(&s);
        pm_tracing tracing = pm_ledger_open(&s, &l);
        pm_ledger_trace(&s, &tracing, 1000);
        CHECK(above ? l.deposits > 500 : l.deposits == 0);
        CHECK(l.absorbed + l.escaped == 1000 && l.absorbed > 100);
        CHECK(above || l.events == 1000);
        pm_scenes_free(&s);
    }
}

static void null_surfaces_are_passed(void)
{
    // A globe within three null shells: nothing but the globe counts.
    pm_ledger bare;
    pm_ledger shelled;
    pm_scenes s;
    globe_scene(&s);
    pm_tracing tracing = pm_ledger_open(&s, &bare);
    pm_ledger_trace(&s, &tracing, 20000);
    pm_scenes_free(&s);

    pm_scenes_begin(&s);
    pm_scenes_globe(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(0.6)));
    int none = pm_scenes_null(&s);
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.3, 0.4), 0.25), none);
    pm_scenes_wear(&s, pm_scenes_square(1.0, -0.5, false), none);
    pm_scenes_wear(&s, pm_scenes_square(1.0, -0.5, true), none);
    pm_scenes_point(&s, pm_vec(0.0, 0.3, 0.4), pm_gray(1.0));
    pm_scenes_ready(&s);
    tracing = pm_ledger_open(&s, &shelled);
    shelled.check_path = true;
    pm_ledger_trace(&s, &tracing, 20000);
    CHECK(shelled.first == 20000 && shelled.events == bare.events);
    CHECK(memcmp(bare.lengths, shelled.lengths, sizeof bare.lengths) == 0);
    pm_scenes_free(&s);
}

// --- marks, with a mirror ball and a glass ball in the room

static void balls_scene(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_rgb(0.7, 0.5, 0.3)));
    pm_shape mirror = pm_shapes_sphere(pm_vec(-0.4, 0.2, -0.6), 0.4);
    pm_shape glass = pm_shapes_sphere(pm_vec(0.45, -0.2, -0.55), 0.4);
    pm_scenes_wear(s, mirror, pm_scenes_mirror(s, pm_gray(0.9)));
    pm_scenes_wear(s, glass, pm_scenes_glass(s, 1.5));
    pm_scenes_point(s, pm_vec(0.1, 0.0, 0.8), pm_rgb(1.0, 2.0, 1.0));
    pm_scenes_ready(s);
}

static void marks_follow_the_path(void)
{
    enum { COUNT = 50000 };
    pm_scenes s;
    pm_ledger l;
    balls_scene(&s);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    l.check_path = true;
    pm_ledger_trace(&s, &tracing, COUNT);
    CHECK(l.caustic > COUNT / 100 && l.specular_late > COUNT / 100);
    CHECK(l.escaped == 0 && l.cut == 0);
    pm_scenes_free(&s);
}

/// The caustic deposits of a run, in order.
typedef struct {
    pm_deposit *list;
    size_t count, room;
} deposit_list;

static pm_status keep_caustic(void *context, const pm_deposit *d)
{
    deposit_list *kept = context;
    if (d->caustic) {
        CHECK(kept->count < kept->room);
        kept->list[kept->count++] = *d;
    }
    return PM_OK;
}

static void caustic_pass_keeps_the_marked(void)
{
    // The same draws at the same places: the same photons, not only in distribution.
    enum { COUNT = 50000 };
    pm_scenes s;
    pm_ledger l;
    balls_scene(&s);
    deposit_list runs[2];
    for (int only = 0; only < 2; only++) {
        runs[only] = (deposit_list){calloc(COUNT, sizeof(pm_deposit)), 0, COUNT};
        CHECK(runs[only].list != NULL);
        pm_tracing tracing = pm_ledger_open(&s, &l);
        tracing.map = only ? PM_MAP_CAUSTIC : PM_MAP_GLOBAL;
        tracing.sink = (pm_trace_sink){&runs[only], keep_caustic, NULL};
        pm_ledger_trace(&s, &tracing, COUNT);
    }
    CHECK(runs[0].count > 1000 && runs[0].count == runs[1].count);
    for (size_t i = 0; i < runs[0].count; i++) {
        const pm_deposit *a = &runs[0].list[i];
        const pm_deposit *b = &runs[1].list[i];
        CHECK(a->photon == b->photon && a->bounce == b->bounce && b->caustic && !b->first);
        CHECK(memcmp(&a->position, &b->position, sizeof a->position) == 0);
        CHECK(memcmp(&a->power, &b->power, sizeof a->power) == 0);
    }
    free(runs[0].list);
    free(runs[1].list);
    pm_scenes_free(&s);
}

static void caustic_pass_ends_at_diffuse(void)
{
    pm_scenes s;
    pm_ledger l;
    balls_scene(&s);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    tracing.map = PM_MAP_CAUSTIC;
    pm_ledger_trace(&s, &tracing, 20000);
    CHECK(l.deposits == l.caustic && l.first == 0 && l.done > 1000);
    CHECK(l.absorbed + l.done == 20000);
    pm_scenes_free(&s);

    globe_scene(&s); // nothing specular: nothing is caustic
    tracing = pm_ledger_open(&s, &l);
    tracing.map = PM_MAP_CAUSTIC;
    pm_ledger_trace(&s, &tracing, 20000);
    CHECK(l.deposits == 0);
    pm_scenes_free(&s);
}

// --- the sink

static pm_status give_up(void *context, const pm_deposit *d)
{
    uint64_t *seen = context;
    return ++*seen < 5 ? PM_OK
                       : pm_status_fail(PM_EIO, "sink.c:1: enough at %g", d->power.c[0]);
}

static void sink_can_stop(void)
{
    uint64_t seen = 0;
    pm_scenes s;
    globe_scene(&s);
    uint64_t share = 100;
    pm_ledger l;
    pm_tracing tracing = pm_ledger_open(&s, &l);
    pm_emission emission = {&s.scene, tracing.source, 100, &share, NULL};
    pm_start starts[100];
    CHECK_OK(pm_emit_photons(&emission, 0, 100, starts));
    tracing.sink = (pm_trace_sink){&seen, give_up, NULL};
    CHECK_FAILS(pm_trace_photons(&tracing, starts, 100), PM_EIO, "enough at 1");
    CHECK(seen == 5);
    pm_scenes_free(&s);
}

PM_TESTS({"trace.16", "no light leaves a closed room, whose corners hold",
          closed_room_keeps_its_light},
         {"trace.17", "a lamp flush with the ceiling lights all but the ceiling",
          flush_lamp_does_not_hit_its_wall},
         {"trace.18", "a black room still holds one photon for each sent",
          black_floor_keeps_its_photons},
         {"trace.19", "the back of a one-sided sheet absorbs and keeps nothing",
          back_of_a_sheet_absorbs},
         {"trace.20", "null surfaces are passed without an event", null_surfaces_are_passed},
         {"trace.21", "a deposit's marks say what its path was", marks_follow_the_path},
         {"trace.22", "a caustic pass keeps just what a global pass marks",
          caustic_pass_keeps_the_marked},
         {"trace.23", "a caustic pass ends every photon at its first diffuse event",
          caustic_pass_ends_at_diffuse},
         {"trace.24", "a sink's refusal ends the tracing with its message", sink_can_stop},
         {"trace.26", "a photon that a rough surface throws into itself ends there",
          photons_without_power_end})

// A path is spelled by its events so far, S, D or V; a photon is traced at a time.
#include "ledger.h"

#include "test.h"

#include <stdlib.h>
#include <string.h>

static void spell(pm_ledger *l, uint64_t photon)
{
    if (l->current != photon) {
        l->current = photon;
        l->path[0] = '\0';
    }
}

static void check_marks(const pm_ledger *l, const pm_deposit *d)
{
    size_t length = strlen(l->path);
    bool caustic = length > 0 && strspn(l->path, "S") == length;
    CHECK_THAT(d->caustic == caustic, "path L%sD: caustic mark is %d", l->path, d->caustic);
    CHECK_THAT(d->first == (length == 0), "path L%sD: first mark is %d", l->path, d->first);
    CHECK(d->bounce == length);
    if (d->in_medium) {
        CHECK(pm_vec_length(d->normal) == 0.0);
    } else {
        CHECK(pm_vec_dot(d->direction, d->normal) < 0.0);
        CHECK_NEAR(pm_vec_length(d->normal), 1.0, 1e-14);
    }
    CHECK_NEAR(pm_vec_length(d->direction), 1.0, 1e-14);
    if (length > 0) {
        CHECK(memcmp(&d->power, &l->carried, sizeof d->power) == 0);
    }
}

static void add(pm_spectrum *sum, pm_spectrum power)
{
    *sum = pm_spectrum_add(*sum, power);
}

static pm_status write_deposit(void *context, const pm_deposit *d)
{
    pm_ledger *l = context;
    spell(l, d->photon);
    if (l->check_path) {
        check_marks(l, d);
    }
    size_t length = strlen(l->path);
    l->deposits++;
    l->first += d->first;
    l->caustic += d->caustic;
    l->in_medium += d->in_medium;
    l->specular_late += length > 0 && l->path[length - 1] == 'S' && !d->caustic;
    add(d->first ? &l->direct : &l->indirect, d->power);
    return PM_OK;
}

static void end_photon(pm_ledger *l, const pm_event *event)
{
    l->absorbed += event->kind == PM_EVENT_SURFACE || event->kind == PM_EVENT_MEDIUM;
    l->escaped += event->kind == PM_EVENT_ESCAPED;
    l->cut += event->kind == PM_EVENT_CUT;
    l->done += event->kind == PM_EVENT_DONE;
    if (event->kind == PM_EVENT_CUT) {
        add(&l->lost, event->arriving);
    }
    uint32_t last = PM_LEDGER_PATH - 1;
    l->lengths[event->bounce < last ? event->bounce : last]++;
}

static void write_event(void *context, const pm_start *start, const pm_event *event)
{
    pm_ledger *l = context;
    spell(l, start->photon);
    l->events++;
    if (event->scatter == 0 || event->kind == PM_EVENT_DONE) {
        end_photon(l, event);
        return;
    }
    size_t length = strlen(l->path);
    CHECK(event->bounce >= length);
    if (length + 1 < PM_LEDGER_PATH) {
        l->path[length] = event->scatter;
        l->path[length + 1] = '\0';
    }
    l->carried = event->carried;
}

pm_tracing pm_ledger_open(const pm_scenes *s, pm_ledger *l)
{
    *l = (pm_ledger){.current = UINT64_MAX};
    return (pm_tracing){.world = &s->world,
                        .source = {.seed = 5, .stream = PM_STREAM_GLOBAL},
                        .max_bounces = UINT32_MAX,
                        .max_specular = 1000,
                        .sink = {l, write_deposit, write_event}};
}

void pm_ledger_trace(const pm_scenes *s, const pm_tracing *tracing, uint32_t count)
{
    uint64_t share[PM_SCENES_LIGHTS];
    CHECK_OK(pm_emit_share(&s->scene, NULL, count, share));
    pm_emission emission = {&s->scene, tracing->source, count, share, NULL};
    pm_start *starts = calloc(count, sizeof *starts);
    CHECK(starts != NULL);
    CHECK_OK(pm_emit_photons(&emission, 0, count, starts));
    CHECK_OK(pm_trace_photons(tracing, starts, count));
    free(starts);
}

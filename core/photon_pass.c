// Chunks of CHUNK photons are traced on any thread and appended in order, so neither the map
// nor the books depend on how many threads there are.
#include "photon_pass.h"

#include "caps.h"
#include "clock.h"
#include "interrupt.h"
#include "photon_map.h"
#include "progress.h"
#include "store.h"

#include <stdlib.h>
#include <string.h>

#define CHUNK 1024u
#define ROUND 1024 // chunks between looks at whether more are wanted

/// What all threads share.
typedef struct {
    const pm_pass_settings *settings;
    pm_emission emission;
    pm_tracing tracing; // without a sink
    pm_photon_map *map;
    pm_pass_report *report;
    bool done; // nothing more is wanted
    pm_progress progress;
    pm_status status;
    char message[1024];
} pm_pass;

/// What one thread works in.
typedef struct {
    const pm_pass_settings *settings;
    pm_start starts[CHUNK];
    pm_photon_map part;
    pm_audit audit;
    pm_spectrum deposited;
    double emit_cpu, trace_cpu;
} pm_pass_worker;

static pm_status worker_deposit(void *context, const pm_deposit *deposit)
{
    pm_pass_worker *worker = context;
    const pm_trace_sink *tap = &worker->settings->tap;
    if (tap->deposit != NULL) {
        PM_TRY(tap->deposit(tap->context, deposit));
    }
    worker->deposited = pm_spectrum_add(worker->deposited, deposit->power);
    return pm_store_push(&worker->part, deposit);
}

static void worker_event(void *context, const pm_start *start, const pm_event *event)
{
    pm_pass_worker *worker = context;
    const pm_trace_sink *tap = &worker->settings->tap;
    pm_audit_event(&worker->audit, start, event);
    if (tap->event != NULL) {
        tap->event(tap->context, start, event);
    }
}

static pm_status trace_range(const pm_pass *pass, pm_pass_worker *worker, uint64_t first,
                             uint32_t count)
{
    pm_tracing tracing = pass->tracing;
    tracing.sink = (pm_trace_sink){worker, worker_deposit, worker_event};
    worker->part.count = 0;
    worker->part.refused = worker->part.clamped = worker->part.vanished = 0;
    pm_audit_clear(&worker->audit);
    worker->deposited = pm_gray(0.0);
    double start = pm_seconds_now();
    PM_TRY(pm_emit_photons(&pass->emission, first, count, worker->starts));
    pm_audit_emit(&worker->audit, worker->starts, count);
    double emitted = pm_seconds_now();
    pm_status status = pm_trace_photons(&tracing, worker->starts, count);
    worker->emit_cpu += emitted - start;
    worker->trace_cpu += pm_seconds_now() - emitted;
    return status;
}

static pm_status append(pm_pass *pass, const pm_pass_worker *worker, uint32_t count)
{
    pm_pass_report *report = pass->report;
    double start = pm_seconds_now();
    pm_audit_add(&report->audit, &worker->audit);
    report->deposited = pm_spectrum_add(report->deposited, worker->deposited);
    report->emitted += count;
    pm_status status = pm_photon_map_append(pass->map, &worker->part);
    report->store_cpu += pm_seconds_now() - start;
    return status;
}

/// Nothing more is wanted. Only one thread at a time comes here, but all of them ask.
static void finish(pm_pass *pass)
{
#pragma omp atomic write
    pass->done = true;
}

/// The chunk in which the wanted number is reached, photon by photon.
static pm_status append_singly(pm_pass *pass, pm_pass_worker *worker, uint64_t first,
                               uint32_t count)
{
    for (uint32_t i = 0; i < count && !pass->done; i++) {
        PM_TRY(trace_range(pass, worker, first + i, 1));
        PM_TRY(append(pass, worker, 1));
        if (pass->map->count >= pass->settings->stored) {
            finish(pass);
        }
    }
    return PM_OK;
}

static pm_status append_in_order(pm_pass *pass, pm_pass_worker *worker, uint64_t first,
                                 uint32_t count)
{
    uint64_t wanted = pass->settings->stored;
    uint64_t would_be = (uint64_t)pass->map->count + worker->part.count;
    if (wanted != 0 && would_be >= wanted) {
        return append_singly(pass, worker, first, count);
    }
    return append(pass, worker, count);
}

static void fail(pm_pass *pass, pm_status status)
{
    pass->status = status;
    finish(pass);
    strncpy(pass->message, pm_status_message(), sizeof pass->message - 1);
}

static bool tapped(const pm_pass *pass)
{
    const pm_trace_sink *tap = &pass->settings->tap;
    return tap->deposit != NULL || tap->event != NULL;
}

static void run_chunk(pm_pass *pass, pm_pass_worker *worker, uint64_t chunk)
{
    uint64_t first = chunk * CHUNK;
    uint64_t left = pass->emission.count - first;
    uint32_t count = left < CHUNK ? (uint32_t)left : CHUNK;
    // A tap sees no photon twice and none beyond the last: such a pass goes singly throughout.
    bool singly = pass->settings->stored != 0 && tapped(pass);
    bool skip;
#pragma omp atomic read
    skip = pass->done;
    pm_status status = PM_OK;
    if (!skip && !singly) {
        status = trace_range(pass, worker, first, count);
    }
#pragma omp ordered
    {
        if (pm_interrupted() && !pass->done) {
            status = pm_interrupt_check();
        }
        if (!pass->done && status == PM_OK) {
            status = singly ? append_singly(pass, worker, first, count)
                            : append_in_order(pass, worker, first, count);
        }
        if (!pass->done && status != PM_OK) {
            fail(pass, status);
        }
        pm_progress_add(&pass->progress, count);
    }
    if (status != PM_OK) {
        pm_status_clear(); // this thread's next pass tells its own
    }
}

static pm_status worker_make(const pm_pass *pass, pm_pass_worker **out)
{
    pm_pass_worker *worker = calloc(1, sizeof *worker);
    if (worker == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory to trace in");
    }
    pm_status status = pm_audit_make(pass->emission.scene, &worker->audit);
    if (status != PM_OK) {
        free(worker);
        return status;
    }
    worker->settings = pass->settings;
    worker->part.kind = pass->map->kind;
    worker->part.unpacked = pass->map->unpacked;
    *out = worker;
    return PM_OK;
}

static void worker_free(pm_pass_worker *worker)
{
    if (worker != NULL) {
        pm_photon_map_free(&worker->part);
        pm_audit_free(&worker->audit);
        free(worker);
    }
}

static void run_chunks(pm_pass *pass)
{
    int64_t chunks = (int64_t)((pass->emission.count + CHUNK - 1) / CHUNK);
#pragma omp parallel if (!tapped(pass))
    {
        pm_pass_worker *worker = NULL;
        pm_status made = worker_make(pass, &worker);
        if (made != PM_OK) {
#pragma omp critical
            fail(pass, made);
        }
        bool done = false; // the same for all threads: read between two barriers
        for (int64_t first = 0; first < chunks && !done; first += ROUND) {
            int64_t end = chunks - first < ROUND ? chunks : first + ROUND;
#pragma omp barrier
#pragma omp for ordered schedule(dynamic, 1)
            for (int64_t chunk = first; chunk < end; chunk++) {
                if (worker != NULL) {
                    run_chunk(pass, worker, (uint64_t)chunk);
                }
            }
            done = pass->done;
        }
        if (worker != NULL) {
#pragma omp critical
            {
                pass->report->emit_cpu += worker->emit_cpu;
                pass->report->trace_cpu += worker->trace_cpu;
            }
        }
        worker_free(worker);
    }
}

/// What both stages are told. Shares the photons out among the lights.
static pm_status prepare(const pm_intersector *world, pm_map_kind kind,
                         const pm_pass_settings *settings, uint64_t *share,
                         pm_emission *emission, pm_tracing *tracing)
{
    pm_rng_source source = {settings->seed, (pm_rng_stream)kind, settings->pass};
    *emission =
        (pm_emission){world->scene, source, settings->count, share, settings->projections};
    *tracing = (pm_tracing){
        .world = world,
        .source = source,
        .rule = settings->rule,
        .map = kind,
    };
    pm_caps caps = pm_caps_of(world->scene, settings->max_bounces);
    tracing->max_bounces = caps.bounces;
    tracing->max_specular = caps.specular;
    return pm_emit_share(world->scene, settings->projections, settings->count, share);
}

static pm_status outcome(const pm_pass *pass)
{
    const pm_pass_settings *settings = pass->settings;
    if (pass->status != PM_OK) {
        pm_status_clear();
        return pm_status_fail(pass->status, "%s", pass->message);
    }
    if (settings->stored != 0 && pass->map->count < settings->stored) {
        return pm_status_fail(
            PM_ELIMIT, "%s: %llu photons were to be stored, but %llu emitted ones gave only %u",
            pass->emission.scene->path, (unsigned long long)settings->stored,
            (unsigned long long)pass->report->emitted, pass->map->count);
    }
    return PM_OK;
}

/// Whether no light got a photon: none sends any power.
static bool is_dark(const pm_scene *scene, const uint64_t *share)
{
    uint64_t sum = 0;
    for (int i = 0; i < scene->light_count; i++) {
        sum += share[i];
    }
    return sum == 0;
}

/// Runs the pass into `map` and `report`, both fresh.
static pm_status run(const pm_intersector *world, pm_map_kind kind,
                     const pm_pass_settings *settings, pm_photon_map *map,
                     pm_pass_report *report)
{
    double start = pm_seconds_now();
    pm_pass pass = {.settings = settings, .map = map, .report = report};
    PM_TRY(prepare(world, kind, settings, report->share, &pass.emission, &pass.tracing));
    if (is_dark(world->scene, report->share)) {
        map->scaled = true;
        return PM_OK;
    }
    pass.progress = pm_progress_begin("tracing", settings->count);
    run_chunks(&pass);
    pm_progress_end(&pass.progress);
    PM_TRY(outcome(&pass));
    pm_photon_map_trim(map);
    PM_TRY(pm_store_scale(map, report->emitted));
    pm_audit_scale(&report->audit, 1.0 / (double)report->emitted);
    report->deposited = pm_spectrum_scale(report->deposited, 1.0 / (double)report->emitted);
    report->deposits = (uint64_t)map->count + map->refused;
    report->seconds = pm_seconds_now() - start;
    return PM_OK;
}

static pm_status make_share(const pm_scene *scene, uint64_t **share)
{
    *share = calloc((size_t)scene->light_count, sizeof **share);
    if (*share == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for the shares of %d lights", scene->light_count);
    }
    return PM_OK;
}

pm_status pm_photon_pass(const pm_intersector *world, pm_map_kind kind,
                         const pm_pass_settings *settings, pm_photon_map *map,
                         pm_pass_report *report)
{
    const pm_scene *scene = world->scene;
    pm_pass_report fresh = {0};
    PM_TRY(make_share(scene, &fresh.share));
    pm_photon_map filled = {.kind = kind, .unpacked = settings->unpacked, .scale = 1.0};
    pm_status status = pm_audit_make(scene, &fresh.audit);
    if (status == PM_OK) {
        status = run(world, kind, settings, &filled, &fresh);
    }
    if (status != PM_OK || report == NULL) {
        pm_pass_report_free(&fresh);
    }
    if (status != PM_OK) {
        pm_photon_map_free(&filled);
        return status;
    }
    *map = filled;
    if (report != NULL) {
        *report = fresh;
    }
    return PM_OK;
}

void pm_pass_report_free(pm_pass_report *report)
{
    free(report->share);
    pm_audit_free(&report->audit);
    *report = (pm_pass_report){0};
}

static pm_status ignore_deposit(void *context, const pm_deposit *deposit)
{
    (void)context;
    (void)deposit;
    return PM_OK;
}

static pm_status replay(const pm_emission *emission, const pm_tracing *tracing, uint64_t photon,
                        uint32_t *light)
{
    pm_start start;
    PM_TRY(pm_emit_photons(emission, photon, 1, &start));
    *light = start.light;
    return pm_trace_photons(tracing, &start, 1);
}

pm_status pm_photon_replay(const pm_intersector *world, pm_map_kind kind,
                           const pm_pass_settings *settings, uint64_t photon,
                           const pm_trace_sink *sink, uint32_t *light)
{
    if (photon >= settings->count) {
        return PM_FAIL(PM_EINPUT, "a pass of %llu photons has no photon %llu",
                       (unsigned long long)settings->count, (unsigned long long)photon);
    }
    uint64_t *share;
    PM_TRY(make_share(world->scene, &share));
    pm_emission emission;
    pm_tracing tracing;
    pm_status status = prepare(world, kind, settings, share, &emission, &tracing);
    tracing.sink = *sink;
    if (sink->deposit == NULL) {
        tracing.sink.deposit = ignore_deposit;
    }
    if (status == PM_OK && is_dark(world->scene, share)) {
        status =
            pm_status_fail(PM_EINPUT, "%s: no light sends any power: there is no photon %llu",
                           world->scene->path, (unsigned long long)photon);
    }
    if (status == PM_OK) {
        status = replay(&emission, &tracing, photon, light);
    }
    free(share);
    return status;
}

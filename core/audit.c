// Sums in double, in the order of the photons; parts of a pass are added in the order of its
// chunks.
#include "audit.h"

#include <stdlib.h>
#include <string.h>

#define CLOSES_TO 1e-12 // of the power emitted: rounding of some 1e8 additions in double
#define SIGMAS 5.0
// Survivors that may be missing altogether: of 15 expected, none comes with probability
// e^-15 = 3e-7, as rare as 5 sigma.
#define RARE 15.0
// A survivor carries at most this many times the largest channel it arrived with: the
// roulette's average rule divides by a third of the albedo where only one channel is reflected.
#define SURVIVOR_MOST 3.0

pm_status pm_audit_make(int shape_count, pm_audit *audit)
{
    size_t count = shape_count > 0 ? (size_t)shape_count : 1;
    pm_audit_shape *shapes = calloc(count, sizeof *shapes);
    if (shapes == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for the books of %d shapes", shape_count);
    }
    *audit = (pm_audit){.shapes = shapes, .shape_count = shape_count};
    return PM_OK;
}

void pm_audit_free(pm_audit *audit)
{
    free(audit->shapes);
    *audit = (pm_audit){0};
}

void pm_audit_clear(pm_audit *audit)
{
    pm_audit_shape *shapes = audit->shapes;
    int shape_count = audit->shape_count;
    memset(shapes, 0, (size_t)shape_count * sizeof *shapes);
    *audit = (pm_audit){.shapes = shapes, .shape_count = shape_count};
}

static void grow(pm_spectrum *sum, pm_spectrum part)
{
    *sum = pm_spectrum_add(*sum, part);
}

/// What the albedos promised on average, against what the roulette carried on.
static void judge_roulette(pm_audit *audit, const pm_event *event)
{
    pm_spectrum albedo = pm_gray(0.0);
    for (int i = 0; i < event->lobes->count; i++) {
        grow(&albedo, event->lobes->lobe[i].albedo);
    }
    pm_spectrum promised = pm_spectrum_mul(event->entering, albedo);
    pm_spectrum gap = pm_spectrum_sub(event->chosen, promised);
    grow(&audit->roulette, gap);
    grow(&audit->roulette_variance, pm_spectrum_mul(gap, gap));
    audit->largest = fmax(audit->largest, pm_spectrum_max(event->arriving));
}

static void end_photon(pm_audit *audit, const pm_event *event)
{
    uint32_t last = PM_AUDIT_BOUNCES - 1;
    audit->bounces[event->bounce < last ? event->bounce : last]++;
    switch (event->kind) {
    case PM_EVENT_ESCAPED:
        audit->ended_escaped++;
        break;
    case PM_EVENT_CUT:
        audit->ended_lost++;
        break;
    default:
        audit->ended_absorbed++;
    }
}

void pm_audit_event(void *context, const pm_start *start, const pm_event *event)
{
    (void)start;
    pm_audit *audit = context;
    if (event->scatter == 0 || event->kind == PM_EVENT_DONE) {
        end_photon(audit, event);
    }
    if (event->kind == PM_EVENT_ESCAPED) {
        grow(&audit->escaped, event->arriving);
        return;
    }
    audit->events++;
    pm_audit_shape *shape = event->hit == NULL ? NULL : &audit->shapes[event->hit->shape];
    if (shape != NULL) {
        grow(&shape->incident, event->arriving);
    }
    if (event->kind == PM_EVENT_CUT) {
        grow(&audit->lost, event->arriving);
        return;
    }
    pm_spectrum taken = pm_spectrum_sub(event->arriving, event->carried);
    grow(&audit->absorbed, taken);
    if (shape != NULL) {
        grow(&shape->absorbed, taken);
        judge_roulette(audit, event);
    }
}

void pm_audit_emit(pm_audit *audit, const pm_start *starts, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        grow(&audit->emitted, starts[i].power);
    }
    audit->photons += count;
}

void pm_audit_add(pm_audit *audit, const pm_audit *part)
{
    audit->photons += part->photons;
    audit->ended_absorbed += part->ended_absorbed;
    audit->ended_escaped += part->ended_escaped;
    audit->ended_lost += part->ended_lost;
    audit->events += part->events;
    for (int i = 0; i < PM_AUDIT_BOUNCES; i++) {
        audit->bounces[i] += part->bounces[i];
    }
    grow(&audit->emitted, part->emitted);
    grow(&audit->absorbed, part->absorbed);
    grow(&audit->escaped, part->escaped);
    grow(&audit->lost, part->lost);
    grow(&audit->roulette, part->roulette);
    grow(&audit->roulette_variance, part->roulette_variance);
    audit->largest = fmax(audit->largest, part->largest);
    for (int i = 0; i < audit->shape_count; i++) {
        grow(&audit->shapes[i].incident, part->shapes[i].incident);
        grow(&audit->shapes[i].absorbed, part->shapes[i].absorbed);
    }
}

static void shrink(pm_spectrum *sum, double factor)
{
    *sum = pm_spectrum_scale(*sum, factor);
}

void pm_audit_scale(pm_audit *audit, double factor)
{
    shrink(&audit->emitted, factor);
    shrink(&audit->absorbed, factor);
    shrink(&audit->escaped, factor);
    shrink(&audit->lost, factor);
    shrink(&audit->roulette, factor);
    shrink(&audit->roulette_variance, factor * factor);
    audit->largest *= factor;
    for (int i = 0; i < audit->shape_count; i++) {
        shrink(&audit->shapes[i].incident, factor);
        shrink(&audit->shapes[i].absorbed, factor);
    }
}

static pm_status check_channel(const pm_audit *audit, int c)
{
    static const char *const name[3] = {"red", "green", "blue"};
    double emitted = audit->emitted.c[c];
    double rest = emitted - audit->absorbed.c[c] - audit->escaped.c[c] - audit->lost.c[c];
    if (!(fabs(rest) <= CLOSES_TO * emitted)) {
        return pm_status_fail(
            PM_ELIMIT, "audit: %s power does not close: emitted %.17g W, unaccounted %.3g W",
            name[c], emitted, rest);
    }
    double sd = sqrt(audit->roulette_variance.c[c]);
    double chance = SIGMAS * sd + RARE * SURVIVOR_MOST * audit->largest;
    if (!(fabs(audit->roulette.c[c]) <= chance + CLOSES_TO * emitted)) {
        return pm_status_fail(
            PM_ELIMIT,
            "audit: roulette carries on %+.3g W of %s beyond the albedos' promise,"
            " %.1f standard deviations",
            audit->roulette.c[c], name[c], audit->roulette.c[c] / sd);
    }
    return PM_OK;
}

pm_status pm_audit_check(const pm_audit *audit)
{
    uint64_t ended = audit->ended_absorbed + audit->ended_escaped + audit->ended_lost;
    if (ended != audit->photons) {
        return pm_status_fail(PM_ELIMIT, "audit: %llu photons emitted, %llu ended",
                              (unsigned long long)audit->photons, (unsigned long long)ended);
    }
    for (int c = 0; c < 3; c++) {
        PM_TRY(check_channel(audit, c));
    }
    return PM_OK;
}

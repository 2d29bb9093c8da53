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

static pm_status make_books(int count, size_t size, const char *what, void **books)
{
    *books = calloc(count > 0 ? (size_t)count : 1, size);
    return *books != NULL ? PM_OK
                          : PM_FAIL(PM_ENOMEM, "no memory for the books of %d %s", count, what);
}

pm_status pm_audit_make(const pm_scene *scene, pm_audit *audit)
{
    void *shapes;
    void *media;
    PM_TRY(make_books(scene->shape_count, sizeof(pm_audit_shape), "shapes", &shapes));
    pm_status status =
        make_books(scene->medium_count, sizeof(pm_audit_medium), "media", &media);
    if (status != PM_OK) {
        free(shapes);
        return status;
    }
    *audit = (pm_audit){.scene = scene, .shapes = shapes, .media = media};
    return PM_OK;
}

void pm_audit_free(pm_audit *audit)
{
    free(audit->shapes);
    free(audit->media);
    *audit = (pm_audit){0};
}

void pm_audit_clear(pm_audit *audit)
{
    const pm_scene *scene = audit->scene;
    pm_audit_shape *shapes = audit->shapes;
    pm_audit_medium *media = audit->media;
    memset(shapes, 0, (size_t)scene->shape_count * sizeof *shapes);
    memset(media, 0, (size_t)scene->medium_count * sizeof *media);
    *audit = (pm_audit){.scene = scene, .shapes = shapes, .media = media};
}

static void grow(pm_spectrum *sum, pm_spectrum part)
{
    *sum = pm_spectrum_add(*sum, part);
}

/// Adds one gap to a sum whose mean must be 0, and to the variance of that sum.
static void judge(pm_spectrum gap, pm_spectrum *sum, pm_spectrum *variance)
{
    grow(sum, gap);
    grow(variance, pm_spectrum_mul(gap, gap));
}

/// Of all that the roulette could have chosen.
static pm_spectrum albedo_at(const pm_audit *audit, const pm_event *event)
{
    if (event->lobes != NULL) {
        pm_spectrum albedo = pm_gray(0.0);
        for (int i = 0; i < event->lobes->count; i++) {
            grow(&albedo, event->lobes->lobe[i].albedo);
        }
        return albedo;
    }
    return audit->scene->media[event->medium].albedo;
}

/// What the albedos promised on average, against what the roulette carried on.
static void judge_roulette(pm_audit *audit, const pm_event *event)
{
    pm_spectrum promised = pm_spectrum_mul(event->entering, albedo_at(audit, event));
    judge(pm_spectrum_sub(event->chosen, promised), &audit->roulette,
          &audit->roulette_variance);
    audit->largest = fmax(audit->largest, pm_spectrum_max(event->entering));
}

/// A wavelength's weight is 1 on average.
static void judge_dispersion(pm_audit *audit, const pm_event *event)
{
    judge(pm_spectrum_sub(event->entering, event->arriving), &audit->dispersion,
          &audit->dispersion_variance);
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

static void book_arrival(pm_audit *audit, const pm_event *event)
{
    if (event->hit != NULL) {
        grow(&audit->shapes[event->hit->shape].incident, event->arriving);
        return;
    }
    pm_audit_medium *medium = &audit->media[event->medium];
    medium->collisions++;
    grow(&medium->incident, event->arriving);
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
    book_arrival(audit, event);
    if (event->kind == PM_EVENT_CUT) {
        grow(&audit->lost, event->arriving);
        return;
    }
    pm_spectrum taken = pm_spectrum_sub(event->arriving, event->carried);
    grow(&audit->absorbed, taken);
    grow(event->hit != NULL ? &audit->shapes[event->hit->shape].absorbed
                            : &audit->media[event->medium].absorbed,
         taken);
    judge_dispersion(audit, event);
    judge_roulette(audit, event);
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
    grow(&audit->dispersion, part->dispersion);
    grow(&audit->dispersion_variance, part->dispersion_variance);
    audit->largest = fmax(audit->largest, part->largest);
    for (int i = 0; i < audit->scene->shape_count; i++) {
        grow(&audit->shapes[i].incident, part->shapes[i].incident);
        grow(&audit->shapes[i].absorbed, part->shapes[i].absorbed);
    }
    for (int i = 0; i < audit->scene->medium_count; i++) {
        audit->media[i].collisions += part->media[i].collisions;
        grow(&audit->media[i].incident, part->media[i].incident);
        grow(&audit->media[i].absorbed, part->media[i].absorbed);
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
    shrink(&audit->dispersion, factor);
    shrink(&audit->dispersion_variance, factor * factor);
    audit->largest *= factor;
    for (int i = 0; i < audit->scene->shape_count; i++) {
        shrink(&audit->shapes[i].incident, factor);
        shrink(&audit->shapes[i].absorbed, factor);
    }
    for (int i = 0; i < audit->scene->medium_count; i++) {
        shrink(&audit->media[i].incident, factor);
        shrink(&audit->media[i].absorbed, factor);
    }
}

static const char *const channel_name[3] = {"red", "green", "blue"};

static pm_status check_closed(const pm_audit *audit, int c)
{
    double emitted = audit->emitted.c[c];
    double rest = emitted - audit->absorbed.c[c] - audit->escaped.c[c] - audit->lost.c[c];
    if (!(fabs(rest) <= CLOSES_TO * emitted)) {
        return pm_status_fail(
            PM_ELIMIT, "audit: %s power does not close: emitted %.17g W, unaccounted %.3g W",
            channel_name[c], emitted, rest);
    }
    return PM_OK;
}

static pm_status check_roulette(const pm_audit *audit, int c)
{
    double sd = sqrt(audit->roulette_variance.c[c]);
    double chance = SIGMAS * sd + RARE * SURVIVOR_MOST * audit->largest;
    if (!(fabs(audit->roulette.c[c]) <= chance + CLOSES_TO * audit->emitted.c[c])) {
        return pm_status_fail(
            PM_ELIMIT,
            "audit: roulette carries on %+.3g W of %s beyond the albedos' promise,"
            " %.1f standard deviations",
            audit->roulette.c[c], channel_name[c], audit->roulette.c[c] / sd);
    }
    return PM_OK;
}

static pm_status check_dispersion(const pm_audit *audit, int c)
{
    double sd = sqrt(audit->dispersion_variance.c[c]);
    double gap = audit->dispersion.c[c];
    if (!(fabs(gap) <= SIGMAS * sd + CLOSES_TO * audit->emitted.c[c])) {
        return pm_status_fail(PM_ELIMIT,
                              "audit: wavelengths add %+.3g W of %s where their weights should"
                              " add none, %.1f standard deviations",
                              gap, channel_name[c], gap / sd);
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
        PM_TRY(check_closed(audit, c));
        PM_TRY(check_roulette(audit, c));
        PM_TRY(check_dispersion(audit, c));
    }
    return PM_OK;
}

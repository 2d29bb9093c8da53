// A photon's life is one loop: fly, meet, deposit, roulette, turn.
#include "trace.h"

#include "medium.h"
#include "wavelength.h"

#include <stddef.h>

/// The photon on its way.
typedef struct {
    const pm_start *start;
    pm_ray ray;
    pm_spectrum power;
    uint32_t bounce;   // events so far
    uint32_t specular; // S events in a row, up to now
    bool coloured;     // it took a wavelength at some time
} pm_flight;

/// Where it came to.
typedef struct {
    pm_event_kind kind; // SURFACE, MEDIUM or ESCAPED
    pm_hit hit;
    pm_lobes lobes;
    pm_vec3 position;
} pm_meeting;

static double probability(pm_spectrum power, pm_spectrum albedo, pm_roulette_rule rule)
{
    if (rule == PM_ROULETTE_AVERAGE) {
        return pm_spectrum_mean(albedo);
    }
    return pm_spectrum_max(pm_spectrum_mul(power, albedo)) / pm_spectrum_max(power);
}

pm_status pm_trace_roulette(pm_spectrum power, const pm_lobe *lobes, int count,
                            pm_roulette_rule rule, pm_rng *rng, pm_roulette *outcome)
{
    if (count > PM_LOBES_MAX) {
        return PM_FAIL(PM_EINPUT, "at most %d lobes, got %d", PM_LOBES_MAX, count);
    }
    *outcome = (pm_roulette){.lobe = PM_NONE};
    if (pm_spectrum_is_black(power)) {
        return PM_OK;
    }
    double chance[PM_LOBES_MAX] = {0};
    double total = 0.0;
    for (int i = 0; i < count; i++) {
        chance[i] = probability(power, lobes[i].albedo, rule);
        total += chance[i];
    }
    double scale = total > 1.0 ? 1.0 / total : 1.0;
    double left = pm_rng_draw(rng);
    for (int i = 0; i < count; i++) {
        double p = chance[i] * scale;
        if (left < p) {
            outcome->lobe = i;
            outcome->power =
                pm_spectrum_scale(pm_spectrum_mul(power, lobes[i].albedo), 1.0 / p);
            return PM_OK;
        }
        left -= p;
    }
    return PM_OK;
}

// --- flying ---------------------------------------------------------------------------------

/// Whether the photon collides within the next `length` [m] of its medium, and where. `depth`
/// is what it has left of the optical depth that it was given for this flight; below 0: it was
/// not in a medium yet.
static bool collides(const pm_tracing *tracing, const pm_flight *flight, double length,
                     pm_rng *rng, double *depth, pm_vec3 *position)
{
    if (flight->ray.medium == PM_NONE) {
        return false;
    }
    const pm_medium *medium = &tracing->world->scene->media[flight->ray.medium];
    if (*depth < 0.0) {
        *depth = pm_medium_collision_depth(pm_rng_draw(rng));
    }
    double thickness = pm_medium_depth(medium, length);
    if (*depth >= thickness) {
        *depth -= thickness;
        return false;
    }
    double distance = *depth / medium->sigma_t;
    *position = pm_vec_along(flight->ray.origin, flight->ray.direction, distance);
    return true;
}

/// To the next surface that does something to light, or to a collision before it; null surfaces
/// are passed.
static void fly(const pm_tracing *tracing, pm_flight *flight, pm_rng *rng, pm_meeting *at)
{
    double depth = -1.0;
    for (;;) {
        bool met = pm_closest(tracing->world, &flight->ray, &at->hit);
        double length = met ? at->hit.t : HUGE_VAL;
        if (collides(tracing, flight, length, rng, &depth, &at->position)) {
            at->kind = PM_EVENT_MEDIUM;
            return;
        }
        if (!met) {
            at->kind = PM_EVENT_ESCAPED;
            at->position = flight->ray.origin;
            return;
        }
        pm_material_lobes(tracing->world->scene, &at->hit, &flight->ray, &at->lobes);
        if (!at->lobes.passes) {
            at->kind = PM_EVENT_SURFACE;
            at->position = at->hit.position;
            return;
        }
        flight->ray = pm_hit_ray(&at->hit, flight->ray.direction, flight->ray.wavelength,
                                 at->lobes.medium_beyond);
    }
}

// --- telling --------------------------------------------------------------------------------

static pm_event event_at(const pm_flight *flight, const pm_meeting *at)
{
    bool surface = at->kind == PM_EVENT_SURFACE;
    return (pm_event){
        .kind = at->kind,
        .bounce = flight->bounce,
        .hit = surface ? &at->hit : NULL,
        .lobes = surface ? &at->lobes : NULL,
        .medium = at->kind == PM_EVENT_MEDIUM ? flight->ray.medium : PM_NONE,
        .from = flight->ray.origin,
        .position = at->position,
        .direction = flight->ray.direction,
        .arriving = flight->power,
        .entering = flight->power,
    };
}

static void tell(const pm_tracing *tracing, const pm_flight *flight, const pm_event *event)
{
    if (tracing->sink.event != NULL) {
        tracing->sink.event(tracing->sink.context, flight->start, event);
    }
}

static void tell_end(const pm_tracing *tracing, const pm_flight *flight, const pm_meeting *at,
                     pm_event_kind kind)
{
    pm_event event = event_at(flight, at);
    event.kind = kind;
    tell(tracing, flight, &event);
}

/// Whether the map takes what came here.
static bool is_wanted(const pm_tracing *tracing, const pm_meeting *at, bool caustic)
{
    if (at->kind == PM_EVENT_MEDIUM) {
        return tracing->map == PM_MAP_VOLUME;
    }
    bool surface = at->lobes.diffuse && tracing->map != PM_MAP_VOLUME;
    return surface && (caustic || tracing->map != PM_MAP_CAUSTIC);
}

static pm_status hand_over(const pm_tracing *tracing, const pm_flight *flight,
                           const pm_meeting *at)
{
    bool caustic = flight->bounce > 0 && flight->specular == flight->bounce;
    if (!is_wanted(tracing, at, caustic)) {
        return PM_OK;
    }
    bool in_medium = at->kind == PM_EVENT_MEDIUM;
    pm_deposit deposit = {
        .position = at->position,
        .direction = flight->ray.direction,
        .normal = in_medium ? pm_vec(0.0, 0.0, 0.0) : at->lobes.normal,
        .power = flight->power,
        .photon = flight->start->photon,
        .bounce = flight->bounce,
        .light = flight->start->light,
        .caustic = caustic,
        .first = flight->bounce == 0,
        .in_medium = in_medium,
    };
    return tracing->sink.deposit(tracing->sink.context, &deposit);
}

// --- scattering -----------------------------------------------------------------------------

/// Takes a wavelength, and the surface is looked at anew with it.
static void take_wavelength(const pm_tracing *tracing, pm_flight *flight, pm_rng *rng,
                            pm_meeting *at)
{
    double u = flight->coloured ? pm_rng_draw(rng)
                                : pm_wavelength_spread(&tracing->source, flight->start->photon);
    flight->coloured = true;
    flight->ray.wavelength = pm_wavelength_at(u);
    flight->power =
        pm_spectrum_mul(flight->power, pm_wavelength_weight(flight->ray.wavelength));
    pm_material_lobes(tracing->world->scene, &at->hit, &flight->ray, &at->lobes);
}

/// A caustic map has no use for a photon after an event that is not S.
static bool is_done(const pm_tracing *tracing, char scatter)
{
    return tracing->map == PM_MAP_CAUSTIC && scatter != 0 && scatter != 'S';
}

/// After an event: the photon goes on along `ray` with what the event left it.
static void go_on(pm_flight *flight, const pm_event *event, pm_ray ray)
{
    flight->power = event->carried;
    flight->ray = ray;
    flight->bounce++;
    flight->specular = event->scatter == 'S' ? flight->specular + 1 : 0;
}

/// Roulette in a medium; the flight goes on changed. Writes whether it does.
static pm_status scatter_in_medium(const pm_tracing *tracing, pm_flight *flight, pm_rng *rng,
                                   const pm_meeting *at, bool *goes_on)
{
    const pm_medium *medium = &tracing->world->scene->media[flight->ray.medium];
    pm_lobe lobe = {.albedo = medium->albedo};
    pm_roulette outcome;
    PM_TRY(pm_trace_roulette(flight->power, &lobe, 1, tracing->rule, rng, &outcome));
    pm_event event = event_at(flight, at);
    event.chosen = outcome.power;
    *goes_on = false;
    event.scatter = outcome.lobe == PM_NONE ? 0 : 'V';
    if (is_done(tracing, event.scatter)) {
        event.kind = PM_EVENT_DONE;
        tell(tracing, flight, &event);
        return PM_OK;
    }
    event.carried = outcome.power;
    tell(tracing, flight, &event);
    if (event.scatter == 'V') {
        *goes_on = true;
        pm_vec3 onward = pm_medium_turn(medium, flight->ray.direction, rng);
        go_on(flight, &event,
              (pm_ray){at->position, onward, HUGE_VAL, 0.0, flight->ray.medium});
    }
    return PM_OK;
}

/// Roulette at a surface; the flight goes on changed. Writes whether it does.
static pm_status scatter(const pm_tracing *tracing, pm_flight *flight, pm_rng *rng,
                         pm_meeting *at, bool *goes_on)
{
    pm_event event = event_at(flight, at);
    if (at->lobes.disperses) {
        take_wavelength(tracing, flight, rng, at);
        event.entering = flight->power;
    }
    pm_roulette outcome;
    PM_TRY(pm_trace_roulette(flight->power, at->lobes.lobe, at->lobes.count, tracing->rule, rng,
                             &outcome));
    event.chosen = outcome.power;
    *goes_on = false;
    if (outcome.lobe == PM_NONE) {
        tell(tracing, flight, &event);
        return PM_OK;
    }
    bool specular = at->lobes.lobe[outcome.lobe].specular;
    event.scatter = specular ? 'S' : 'D';
    if (is_done(tracing, event.scatter)) {
        event.kind = PM_EVENT_DONE;
        tell(tracing, flight, &event);
        return PM_OK;
    }
    pm_scatter turn;
    pm_material_sample(&at->lobes, outcome.lobe, rng, &turn);
    event.carried = pm_spectrum_mul(outcome.power, turn.weight);
    // A rough lobe may draw a direction into the surface, which carries nothing.
    *goes_on = !pm_spectrum_is_black(event.carried);
    event.scatter = *goes_on ? event.scatter : 0;
    tell(tracing, flight, &event);
    // Past a D event the photon is all three channels again.
    double wavelength = specular ? flight->ray.wavelength : 0.0;
    go_on(flight, &event, pm_hit_ray(&at->hit, turn.wo, wavelength, turn.medium));
    return PM_OK;
}

static pm_status follow(const pm_tracing *tracing, const pm_start *start)
{
    pm_flight flight = {.start = start, .ray = start->ray, .power = start->power};
    for (bool goes_on = true; goes_on;) {
        pm_rng rng = pm_rng_at(&tracing->source, start->photon, flight.bounce + 1);
        pm_meeting at;
        fly(tracing, &flight, &rng, &at);
        if (at.kind == PM_EVENT_ESCAPED) {
            tell_end(tracing, &flight, &at, PM_EVENT_ESCAPED);
            return PM_OK;
        }
        PM_TRY(hand_over(tracing, &flight, &at));
        if (flight.bounce >= tracing->max_bounces || flight.specular >= tracing->max_specular) {
            tell_end(tracing, &flight, &at, PM_EVENT_CUT);
            return PM_OK;
        }
        PM_TRY(at.kind == PM_EVENT_MEDIUM
                   ? scatter_in_medium(tracing, &flight, &rng, &at, &goes_on)
                   : scatter(tracing, &flight, &rng, &at, &goes_on));
    }
    return PM_OK;
}

pm_status pm_trace_photons(const pm_tracing *tracing, const pm_start *starts, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        PM_TRY(follow(tracing, &starts[i]));
    }
    return PM_OK;
}

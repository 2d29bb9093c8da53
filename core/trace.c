// A photon's life is one loop: fly, meet, deposit, roulette, turn.
#include "trace.h"

#include <stddef.h>

/// The photon on its way.
typedef struct {
    const pm_start *start;
    pm_ray ray;
    pm_spectrum power;
    uint32_t bounce;   // events so far
    uint32_t specular; // S events in a row, up to now
} pm_flight;

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

/// The next surface that does something to light; null surfaces are passed.
static bool fly(const pm_tracing *tracing, pm_flight *flight, pm_hit *hit, pm_lobes *lobes)
{
    const pm_scene *scene = tracing->world->scene;
    while (pm_closest(tracing->world, &flight->ray, hit)) {
        pm_vec3 wi = pm_vec_negate(flight->ray.direction);
        pm_material_lobes(scene, hit, wi, flight->ray.wavelength, lobes);
        if (!lobes->passes) {
            return true;
        }
        flight->ray = pm_hit_ray(hit, flight->ray.direction, flight->ray.wavelength,
                                 lobes->medium_beyond);
    }
    return false;
}

static void tell(const pm_tracing *tracing, const pm_flight *flight, pm_event event)
{
    if (tracing->sink.event == NULL) {
        return;
    }
    event.bounce = flight->bounce;
    event.direction = flight->ray.direction;
    event.from = flight->ray.origin;
    event.position = event.hit == NULL ? event.from : event.hit->position;
    event.arriving = flight->power;
    tracing->sink.event(tracing->sink.context, flight->start, &event);
}

static pm_status hand_over(const pm_tracing *tracing, const pm_flight *flight,
                           const pm_hit *hit, const pm_lobes *lobes)
{
    bool caustic = flight->bounce > 0 && flight->specular == flight->bounce;
    if (!lobes->diffuse || (tracing->caustic_only && !caustic)) {
        return PM_OK;
    }
    pm_deposit deposit = {
        .position = hit->position,
        .direction = flight->ray.direction,
        .normal = lobes->normal,
        .power = flight->power,
        .photon = flight->start->photon,
        .bounce = flight->bounce,
        .light = flight->start->light,
        .caustic = caustic,
        .first = flight->bounce == 0,
    };
    return tracing->sink.deposit(tracing->sink.context, &deposit);
}

/// Roulette at a surface; the flight goes on changed. Writes whether it does.
static pm_status scatter(const pm_tracing *tracing, pm_flight *flight, const pm_hit *hit,
                         const pm_lobes *lobes, bool *goes_on)
{
    pm_rng rng = pm_rng_at(&tracing->source, flight->start->photon, flight->bounce + 1);
    pm_roulette outcome;
    PM_TRY(pm_trace_roulette(flight->power, lobes->lobe, lobes->count, tracing->rule, &rng,
                             &outcome));
    pm_event event = {.kind = PM_EVENT_SURFACE, .hit = hit, .lobes = lobes};
    event.chosen = outcome.power;
    *goes_on = false;
    if (outcome.lobe == PM_NONE) {
        tell(tracing, flight, event);
        return PM_OK;
    }
    bool specular = lobes->lobe[outcome.lobe].specular;
    event.scatter = specular ? 'S' : 'D';
    if (tracing->caustic_only && !specular) {
        event.kind = PM_EVENT_DONE;
        tell(tracing, flight, event);
        return PM_OK;
    }
    pm_scatter turn;
    pm_material_sample(lobes, outcome.lobe, &rng, &turn);
    event.carried = pm_spectrum_mul(outcome.power, turn.weight);
    // A rough lobe may draw a direction into the surface, which carries nothing.
    *goes_on = !pm_spectrum_is_black(event.carried);
    event.scatter = *goes_on ? event.scatter : 0;
    tell(tracing, flight, event);

    flight->power = event.carried;
    flight->ray = pm_hit_ray(hit, turn.wo, flight->ray.wavelength, turn.medium);
    flight->bounce++;
    flight->specular = specular ? flight->specular + 1 : 0;
    return PM_OK;
}

static pm_status follow(const pm_tracing *tracing, const pm_start *start)
{
    pm_flight flight = {.start = start, .ray = start->ray, .power = start->power};
    for (bool goes_on = true; goes_on;) {
        pm_hit hit;
        pm_lobes lobes;
        if (!fly(tracing, &flight, &hit, &lobes)) {
            tell(tracing, &flight, (pm_event){.kind = PM_EVENT_ESCAPED});
            return PM_OK;
        }
        PM_TRY(hand_over(tracing, &flight, &hit, &lobes));
        if (flight.bounce >= tracing->max_bounces || flight.specular >= tracing->max_specular) {
            tell(tracing, &flight,
                 (pm_event){.kind = PM_EVENT_CUT, .hit = &hit, .lobes = &lobes});
            return PM_OK;
        }
        PM_TRY(scatter(tracing, &flight, &hit, &lobes, &goes_on));
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

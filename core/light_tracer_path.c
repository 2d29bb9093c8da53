// Fly, meet, connect to the camera, turn; until the roulette ends it.
#include "light_tracer_path.h"

#include "camera.h"
#include "medium.h"
#include "reference_flight.h"
#include "wavelength.h"

#include <stdlib.h>

/// What all paths share.
typedef struct {
    const pm_light_tracing *tracing;
    double per_film;
} light_run;

/// A light path on its way.
typedef struct {
    pm_ray ray;
    pm_spectrum power;
    uint32_t events, specular; // S events in a row
    bool spread;               // a D or V event was among them
    bool coloured;             // it took a wavelength at some time
} pm_flight;

/// How a point is seen by the camera.
typedef struct {
    size_t pixel;
    pm_vec3 way;   // from the point, unit
    double factor; // radiance of the pixel over power times f cos(x), or over power times the
                   // share of it that a medium sends there per solid angle
} pm_view;

static pm_status push(pm_splats *splats, pm_splat splat)
{
    if (splats->count == splats->room) {
        size_t room = splats->room == 0 ? 4096 : 2 * splats->room;
        pm_splat *grown = realloc(splats->splat, room * sizeof *grown);
        if (grown == NULL) {
            return PM_FAIL(PM_ENOMEM, "no memory for %zu connections to the camera", room);
        }
        splats->splat = grown;
        splats->room = room;
    }
    splats->splat[splats->count++] = splat;
    return PM_OK;
}

// --- to the camera --------------------------------------------------------------------------

/// The layer of a path that comes to the camera after one more event, 'S', 'D' or 'V'.
static pm_layer layer_of(const pm_flight *flight, char scatter)
{
    pm_layer_events events = {
        .count = flight->events + 1,
        .first = scatter,
        .later_spread = flight->spread,
    };
    return pm_layer_of(events);
}

/// Whether the camera looks at the point. Surfaces between are not asked.
static bool find_view(const light_run *run, pm_vec3 point, pm_view *view)
{
    const pm_camera *camera = &run->tracing->world->scene->camera;
    int x;
    int y;
    if (!pm_camera_pixel(camera, point, &x, &y)) {
        return false;
    }
    pm_vec3 way = pm_vec_sub(camera->position, point);
    double distance2 = pm_vec_dot(way, way);
    view->way = pm_vec_scale(way, 1.0 / sqrt(distance2));
    double cos_axis = -pm_vec_dot(view->way, camera->forward);
    view->factor = run->per_film / (distance2 * cos_axis * cos_axis * cos_axis);
    view->pixel = (size_t)y * (size_t)camera->width + (size_t)x;
    return true;
}

/// Adds what each lobe sends along the view.
static pm_status splat_lobes(const pm_flight *flight, const pm_lobes *lobes,
                             const pm_view *view, pm_splats *splats)
{
    double factor = view->factor * fabs(pm_vec_dot(view->way, lobes->normal));
    for (int i = 0; i < lobes->count; i++) {
        pm_spectrum value = pm_material_value(lobes, i, view->way);
        if (pm_spectrum_is_black(value)) {
            continue;
        }
        pm_spectrum radiance = pm_spectrum_scale(pm_spectrum_mul(flight->power, value), factor);
        size_t layer = layer_of(flight, lobes->lobe[i].specular ? 'S' : 'D');
        PM_TRY(push(splats, (pm_splat){view->pixel * PM_LAYER_COUNT + layer, radiance}));
    }
    return PM_OK;
}

/// Adds what the medium sends along the view.
static pm_status splat_medium(const light_run *run, const pm_flight *flight,
                              const pm_view *view, pm_splats *splats)
{
    const pm_medium *medium = &run->tracing->world->scene->media[flight->ray.medium];
    double phase = pm_medium_phase(medium, pm_vec_dot(flight->ray.direction, view->way));
    pm_spectrum radiance =
        pm_spectrum_scale(pm_spectrum_mul(flight->power, medium->albedo), phase * view->factor);
    if (pm_spectrum_is_black(radiance)) {
        return PM_OK;
    }
    size_t layer = layer_of(flight, 'V');
    return push(splats, (pm_splat){view->pixel * PM_LAYER_COUNT + layer, radiance});
}

/// The share of light that gets from where the path is to the camera.
static double clear_to_camera(const light_run *run, const pm_flight *flight,
                              const pm_reference_meeting *at, pm_vec3 way)
{
    const pm_camera *camera = &run->tracing->world->scene->camera;
    pm_ray ray = {at->position, way, HUGE_VAL, 0.0, flight->ray.medium};
    if (at->place == PM_REFERENCE_SURFACE) {
        ray = pm_hit_ray(&at->hit, way, 0.0, at->lobes.medium_here);
    }
    way = pm_vec_sub(camera->position, ray.origin);
    ray.t_max = pm_vec_length(way);
    ray.direction = pm_vec_scale(way, 1.0 / ray.t_max);
    return pm_medium_clear(run->tracing->world, &ray);
}

/// The connection to the camera, if it sees the point.
static pm_status connect(const light_run *run, const pm_flight *flight,
                         const pm_reference_meeting *at, pm_splats *splats)
{
    pm_view view;
    if (!find_view(run, at->position, &view)) {
        return PM_OK;
    }
    size_t before = splats->count;
    PM_TRY(at->place == PM_REFERENCE_SURFACE ? splat_lobes(flight, &at->lobes, &view, splats)
                                             : splat_medium(run, flight, &view, splats));
    if (splats->count == before) {
        return PM_OK;
    }
    double clear = clear_to_camera(run, flight, at, view.way);
    for (size_t i = before; i < splats->count; i++) {
        splats->splat[i].radiance = pm_spectrum_scale(splats->splat[i].radiance, clear);
    }
    splats->count = clear > 0.0 ? splats->count : before;
    return PM_OK;
}

// --- the path -------------------------------------------------------------------------------

/// To the next event; null surfaces are none.
static void fly(const pm_intersector *world, pm_flight *flight, pm_rng *rng,
                pm_reference_meeting *at)
{
    double left = PM_REFERENCE_UNDRAWN;
    pm_reference_fly(world, &flight->ray, rng, &left, at);
    while (at->place == PM_REFERENCE_SURFACE && at->lobes.passes) {
        flight->ray = pm_reference_beyond(&flight->ray, at);
        pm_reference_fly(world, &flight->ray, rng, &left, at);
    }
}

/// After an event, along `ray`. Whether the path goes on: not after a first event that eye
/// paths deal with.
static bool go_on(const pm_light_tracing *tracing, pm_flight *flight, char scatter, bool smooth,
                  pm_ray ray)
{
    bool wanted = flight->events > 0 || smooth || tracing->everything;
    flight->ray = ray;
    flight->events++;
    flight->specular = scatter == 'S' ? flight->specular + 1 : 0;
    flight->spread = flight->spread || scatter != 'S';
    return wanted && !pm_spectrum_is_black(flight->power);
}

/// Goes on by one lobe. Writes whether it does.
static pm_status turn(const pm_light_tracing *tracing, const pm_reference_meeting *at,
                      pm_rng *rng, pm_flight *flight, bool *goes_on)
{
    const pm_lobes *lobes = &at->lobes;
    pm_roulette outcome;
    PM_TRY(pm_trace_roulette(flight->power, lobes->lobe, lobes->count, tracing->rule, rng,
                             &outcome));
    *goes_on = outcome.lobe != PM_NONE;
    if (!*goes_on) {
        return PM_OK;
    }
    pm_scatter scatter;
    pm_material_sample(lobes, outcome.lobe, rng, &scatter);
    bool specular = lobes->lobe[outcome.lobe].specular;
    // Past a D event the path is all three channels again.
    double wavelength = specular ? flight->ray.wavelength : 0.0;
    flight->power = pm_spectrum_mul(outcome.power, scatter.weight);
    *goes_on = go_on(tracing, flight, specular ? 'S' : 'D', scatter.pdf == 0.0,
                     pm_hit_ray(&at->hit, scatter.wo, wavelength, scatter.medium));
    return PM_OK;
}

/// Goes on from a collision in a medium. Writes whether it does.
static pm_status turn_in_medium(const pm_light_tracing *tracing, pm_vec3 position, pm_rng *rng,
                                pm_flight *flight, bool *goes_on)
{
    const pm_medium *medium = &tracing->world->scene->media[flight->ray.medium];
    pm_lobe lobe = {.albedo = medium->albedo};
    pm_roulette outcome;
    PM_TRY(pm_trace_roulette(flight->power, &lobe, 1, tracing->rule, rng, &outcome));
    *goes_on = outcome.lobe != PM_NONE;
    if (*goes_on) {
        pm_vec3 onward = pm_medium_turn(medium, flight->ray.direction, rng);
        flight->power = outcome.power;
        *goes_on = go_on(tracing, flight, 'V', false,
                         (pm_ray){position, onward, HUGE_VAL, 0.0, flight->ray.medium});
    }
    return PM_OK;
}

/// One event. Writes whether the path goes on.
static pm_status meet(const light_run *run, uint64_t photon, pm_flight *flight,
                      pm_splats *splats, bool *goes_on)
{
    const pm_light_tracing *tracing = run->tracing;
    pm_rng rng = pm_rng_at(&tracing->source, photon, flight->events + 1);
    pm_reference_meeting at;
    *goes_on = false;
    fly(tracing->world, flight, &rng, &at);
    if (at.place == PM_REFERENCE_OUTSIDE ||
        (at.place == PM_REFERENCE_SURFACE && at.lobes.count == 0)) {
        return PM_OK;
    }
    if (flight->events >= tracing->caps.bounces || flight->specular >= tracing->caps.specular) {
        splats->cut++;
        return PM_OK;
    }
    if (flight->events > 0 || tracing->everything) {
        PM_TRY(connect(run, flight, &at, splats));
    }
    if (at.place == PM_REFERENCE_MEDIUM) {
        return turn_in_medium(tracing, at.position, &rng, flight, goes_on);
    }
    if (at.lobes.disperses) {
        double share = flight->coloured ? pm_rng_draw(&rng)
                                        : pm_wavelength_spread(&tracing->source, photon);
        flight->coloured = true;
        pm_reference_colour(tracing->world->scene, share, &flight->ray, &flight->power, &at);
    }
    return turn(tracing, &at, &rng, flight, goes_on);
}

pm_status pm_light_tracer_path(const pm_light_tracing *tracing, double per_film,
                               const pm_start *start, pm_splats *splats)
{
    light_run run = {tracing, per_film};
    pm_flight flight = {.ray = start->ray, .power = start->power};
    for (bool goes_on = true; goes_on;) {
        PM_TRY(meet(&run, start->photon, &flight, splats, &goes_on));
    }
    return PM_OK;
}

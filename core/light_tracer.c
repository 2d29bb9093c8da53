// Light paths are traced on any thread, and what they add to the film is added in their order,
// so the picture does not depend on how many threads there are.
#include "light_tracer.h"

#include "camera.h"
#include "chunks.h"

#include <stdlib.h>

/// What one connection to the camera adds.
typedef struct {
    size_t place; // in the film
    pm_spectrum radiance;
} pm_splat;

/// What one thread works in.
typedef struct {
    pm_start starts[PM_CHUNK];
    pm_splat *splat;
    size_t count, room;
    uint64_t cut;
} pm_splatter;

/// What all threads share.
typedef struct {
    const pm_light_tracing *tracing;
    pm_emission emission;
    double per_film; // 1 over paths times the area of a pixel at distance 1
    pm_spectrum *film;
    uint64_t cut;
} pm_light_run;

/// A light path on its way.
typedef struct {
    pm_ray ray;
    pm_spectrum power;
    uint32_t events, specular; // S events in a row
    bool diffuse;              // a D event was among them
} pm_flight;

static pm_status push(pm_splatter *splatter, pm_splat splat)
{
    if (splatter->count == splatter->room) {
        size_t room = splatter->room == 0 ? 4096 : 2 * splatter->room;
        pm_splat *grown = realloc(splatter->splat, room * sizeof *grown);
        if (grown == NULL) {
            return PM_FAIL(PM_ENOMEM, "no memory for %zu connections to the camera", room);
        }
        splatter->splat = grown;
        splatter->room = room;
    }
    splatter->splat[splatter->count++] = splat;
    return PM_OK;
}

/// The layer of a path that comes to the camera after one more event, of this kind.
static pm_layer layer_of(const pm_flight *flight, bool specular)
{
    pm_layer_events events = {
        .count = flight->events + 1,
        .first = specular ? 'S' : 'D',
        .later_spread = flight->diffuse,
    };
    return pm_layer_of(events);
}

/// Adds what each lobe sends along `wo` to the camera, at the film's place of `pixel`.
static pm_status splat_lobes(const pm_flight *flight, const pm_lobes *lobes, pm_vec3 wo,
                             double factor, size_t pixel, pm_splatter *splatter)
{
    for (int i = 0; i < lobes->count; i++) {
        pm_spectrum value = pm_material_value(lobes, i, wo);
        if (pm_spectrum_is_black(value)) {
            continue;
        }
        pm_spectrum radiance = pm_spectrum_scale(pm_spectrum_mul(flight->power, value), factor);
        size_t layer = layer_of(flight, lobes->lobe[i].specular);
        PM_TRY(push(splatter, (pm_splat){pixel * PM_LAYER_COUNT + layer, radiance}));
    }
    return PM_OK;
}

/// The connection to the camera, if it sees the point.
static pm_status connect(const pm_light_run *run, const pm_flight *flight, const pm_hit *hit,
                         const pm_lobes *lobes, pm_splatter *splatter)
{
    const pm_camera *camera = &run->tracing->world->scene->camera;
    int x;
    int y;
    if (!pm_camera_pixel(camera, hit->position, &x, &y)) {
        return PM_OK;
    }
    pm_vec3 way = pm_vec_sub(camera->position, hit->position);
    double distance2 = pm_vec_dot(way, way);
    pm_vec3 wo = pm_vec_scale(way, 1.0 / sqrt(distance2));
    double cos_axis = -pm_vec_dot(wo, camera->forward);
    double cosine = fabs(pm_vec_dot(wo, lobes->normal));
    double factor = run->per_film * cosine / (distance2 * cos_axis * cos_axis * cos_axis);
    size_t pixel = (size_t)y * (size_t)camera->width + (size_t)x;

    size_t before = splatter->count;
    PM_TRY(splat_lobes(flight, lobes, wo, factor, pixel, splatter));
    pm_ray ray = pm_hit_ray(hit, wo, 0.0, lobes->medium_here);
    way = pm_vec_sub(camera->position, ray.origin);
    ray.t_max = pm_vec_length(way);
    ray.direction = pm_vec_scale(way, 1.0 / ray.t_max);
    if (splatter->count > before && pm_blocked(run->tracing->world, &ray)) {
        splatter->count = before;
    }
    return PM_OK;
}

/// The next surface that is an event.
static bool meet(const pm_intersector *world, pm_flight *flight, pm_hit *hit, pm_lobes *lobes)
{
    while (pm_closest(world, &flight->ray, hit)) {
        pm_vec3 direction = flight->ray.direction;
        double wavelength = flight->ray.wavelength;
        pm_material_lobes(world->scene, hit, &flight->ray, lobes);
        if (!lobes->passes) {
            return true;
        }
        flight->ray = pm_hit_ray(hit, direction, wavelength, lobes->medium_beyond);
    }
    return false;
}

/// Goes on by one lobe. Writes whether it does: not after a first event that eye paths deal
/// with.
static pm_status turn(const pm_light_tracing *tracing, uint64_t photon, const pm_hit *hit,
                      const pm_lobes *lobes, pm_flight *flight, bool *goes_on)
{
    pm_rng rng = pm_rng_at(&tracing->source, photon, flight->events + 1);
    pm_roulette outcome;
    PM_TRY(pm_trace_roulette(flight->power, lobes->lobe, lobes->count, tracing->rule, &rng,
                             &outcome));
    *goes_on = outcome.lobe != PM_NONE;
    if (!*goes_on) {
        return PM_OK;
    }
    pm_scatter scatter;
    pm_material_sample(lobes, outcome.lobe, &rng, &scatter);
    bool smooth = scatter.pdf == 0.0;
    bool specular = lobes->lobe[outcome.lobe].specular;
    bool wanted = flight->events > 0 || smooth || tracing->everything;
    flight->power = pm_spectrum_mul(outcome.power, scatter.weight);
    *goes_on = wanted && !pm_spectrum_is_black(flight->power);
    flight->ray = pm_hit_ray(hit, scatter.wo, flight->ray.wavelength, scatter.medium);
    flight->events++;
    flight->specular = specular ? flight->specular + 1 : 0;
    flight->diffuse = flight->diffuse || !specular;
    return PM_OK;
}

static pm_status follow(const pm_light_run *run, const pm_start *start, pm_splatter *splatter)
{
    const pm_light_tracing *tracing = run->tracing;
    pm_flight flight = {.ray = start->ray, .power = start->power};
    pm_hit hit;
    pm_lobes lobes;
    for (bool goes_on = true; goes_on && meet(tracing->world, &flight, &hit, &lobes);) {
        if (lobes.count == 0) {
            return PM_OK;
        }
        if (flight.events >= tracing->caps.bounces ||
            flight.specular >= tracing->caps.specular) {
            splatter->cut++;
            return PM_OK;
        }
        if (flight.events > 0 || tracing->everything) {
            PM_TRY(connect(run, &flight, &hit, &lobes, splatter));
        }
        PM_TRY(turn(tracing, start->photon, &hit, &lobes, &flight, &goes_on));
    }
    return PM_OK;
}

static pm_status splatter_begin(const void *context, void **worker)
{
    (void)context;
    *worker = calloc(1, sizeof(pm_splatter));
    return *worker != NULL ? PM_OK : PM_FAIL(PM_ENOMEM, "no memory for light paths");
}

static void splatter_end(void *worker)
{
    if (worker != NULL) {
        free(((pm_splatter *)worker)->splat);
        free(worker);
    }
}

static pm_status trace_chunk(const void *context, void *worker, uint64_t first, uint32_t count)
{
    const pm_light_run *run = context;
    pm_splatter *splatter = worker;
    splatter->count = 0;
    splatter->cut = 0;
    PM_TRY(pm_emit_photons(&run->emission, first, count, splatter->starts));
    for (uint32_t i = 0; i < count; i++) {
        PM_TRY(follow(run, &splatter->starts[i], splatter));
    }
    return PM_OK;
}

static pm_status take_chunk(void *context, const void *worker)
{
    pm_light_run *run = context;
    const pm_splatter *splatter = worker;
    for (size_t i = 0; i < splatter->count; i++) {
        pm_spectrum *pixel = &run->film[splatter->splat[i].place];
        *pixel = pm_spectrum_add(*pixel, splatter->splat[i].radiance);
    }
    run->cut += splatter->cut;
    return PM_OK;
}

static pm_status run_chunks(pm_light_run *run)
{
    pm_progress progress = pm_progress_begin("light paths", run->emission.count);
    pm_chunks chunks = {
        .count = run->emission.count,
        .progress = &progress,
        .context = run,
        .begin = splatter_begin,
        .work = trace_chunk,
        .take = take_chunk,
        .end = splatter_end,
    };
    pm_status status = pm_chunks_run(&chunks);
    pm_progress_end(&progress);
    return status;
}

/// Lights to be traced from, in a scene that holds no others. Shapes still name lights by their
/// old numbers; emission does not ask them.
static int choose_lights(const pm_light_tracing *tracing, pm_light *chosen)
{
    const pm_scene *scene = tracing->world->scene;
    int count = 0;
    for (int i = 0; i < scene->light_count; i++) {
        if (tracing->everything || pm_light_tracer_takes(&scene->lights[i])) {
            chosen[count++] = scene->lights[i];
        }
    }
    return count;
}

/// Everything, with room for the shares of all lights of `scene`, which are those that count.
static pm_status run_lights(pm_light_run *run, const pm_scene *scene, uint64_t *share)
{
    const pm_light_tracing *tracing = run->tracing;
    PM_TRY(pm_emit_share(scene, NULL, tracing->count, share));
    uint64_t sent = 0;
    for (int i = 0; i < scene->light_count; i++) {
        sent += share[i];
    }
    if (sent == 0) {
        return PM_OK;
    }
    const pm_camera *camera = &scene->camera;
    double area = 4.0 * camera->tan_x * camera->tan_y / camera->width / camera->height;
    run->emission = (pm_emission){scene, tracing->source, tracing->count, share, NULL};
    run->per_film = 1.0 / (area * (double)tracing->count);
    return run_chunks(run);
}

pm_status pm_light_tracer_run(const pm_light_tracing *tracing, pm_spectrum *film, uint64_t *cut)
{
    pm_light_run run = {.tracing = tracing, .film = film};
    pm_scene scene = *tracing->world->scene;
    size_t room = (size_t)scene.light_count + 1;
    pm_light *lights = calloc(room, sizeof *lights);
    uint64_t *share = calloc(room, sizeof *share);
    pm_status status = PM_OK;
    if (lights == NULL || share == NULL) {
        status = PM_FAIL(PM_ENOMEM, "no memory for %d lights", scene.light_count);
    } else {
        scene.light_count = choose_lights(tracing, lights);
        scene.lights = lights;
        status = run_lights(&run, &scene, share);
        *cut += run.cut;
    }
    free(lights);
    free(share);
    return status;
}

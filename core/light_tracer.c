// Light paths are traced on any thread, and what they add to the film is added in their order,
// so the picture does not depend on how many threads there are.
#include "light_tracer.h"

#include "chunks.h"
#include "light_tracer_path.h"

#include <stdlib.h>

/// What one thread works in.
typedef struct {
    pm_start starts[PM_CHUNK];
    pm_splats splats;
} pm_splatter;

/// What all threads share.
typedef struct {
    const pm_light_tracing *tracing;
    pm_emission emission;
    double per_film; // 1 over paths times the area of a pixel at distance 1
    pm_spectrum *film;
    uint64_t cut;
} pm_light_run;

static pm_status splatter_begin(const void *context, void **worker)
{
    (void)context;
    *worker = calloc(1, sizeof(pm_splatter));
    return *worker != NULL ? PM_OK : PM_FAIL(PM_ENOMEM, "no memory for light paths");
}

static void splatter_end(void *worker)
{
    if (worker != NULL) {
        free(((pm_splatter *)worker)->splats.splat);
        free(worker);
    }
}

static pm_status trace_chunk(const void *context, void *worker, uint64_t first, uint32_t count)
{
    const pm_light_run *run = context;
    pm_splatter *splatter = worker;
    splatter->splats.count = 0;
    splatter->splats.cut = 0;
    PM_TRY(pm_emit_photons(&run->emission, first, count, splatter->starts));
    for (uint32_t i = 0; i < count; i++) {
        PM_TRY(pm_light_tracer_path(run->tracing, run->per_film, &splatter->starts[i],
                                    &splatter->splats));
    }
    return PM_OK;
}

static pm_status take_chunk(void *context, const void *worker)
{
    pm_light_run *run = context;
    const pm_splats *splats = &((const pm_splatter *)worker)->splats;
    for (size_t i = 0; i < splats->count; i++) {
        pm_spectrum *pixel = &run->film[splats->splat[i].place];
        *pixel = pm_spectrum_add(*pixel, splats->splat[i].radiance);
    }
    run->cut += splats->cut;
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

// The second half of a picture: eye rays, tile by tile. A pixel depends on nothing but its own
// random numbers and the maps, so tiles may be dealt to any thread.
#include "render.h"

#include "camera.h"
#include "clock.h"
#include "interrupt.h"
#include "lattice.h"
#include "photon_dots.h"
#include "pixel.h"
#include "progress.h"

#include <stdlib.h>
#include <string.h>

#define TILE 16
#define SPLITS 2 // S events of an eye path at which reflection and refraction are both followed

typedef struct {
    const pm_intersector *world;
    const pm_render_settings *settings;
    const pm_render_maps *maps;
    pm_picture picture;
    int tiles_x, tiles_y;
    pm_eye_report *report;
    pm_progress progress;
    pm_status status;
    char message[1024];
} pm_eye_pass;

/// What one thread asks with.
typedef struct {
    pm_compose compose;
    pm_gather gather;
    uint64_t cut;
    uint64_t lookups;
} pm_eye_worker;

static void choose_layers(const pm_render_settings *settings, bool wanted[PM_LAYER_COUNT])
{
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        wanted[layer] = settings->only == PM_NONE || settings->only == layer;
    }
}

static pm_status worker_make(const pm_eye_pass *pass, pm_eye_worker *worker)
{
    const pm_render_settings *settings = pass->settings;
    uint32_t unused;
    *worker = (pm_eye_worker){
        .compose = {.world = pass->world,
                    .source = {settings->seed, PM_STREAM_CAMERA, 0},
                    .rule = settings->roulette,
                    .splits = SPLITS},
        .gather = {.settings = settings->light},
    };
    pm_photon_pass_caps(pass->world->scene, settings->max_bounces, &unused,
                        &worker->compose.max_specular);
    choose_layers(settings, worker->compose.wanted);
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        worker->gather.map[kind] = pass->maps->has[kind] ? &pass->maps->map[kind] : NULL;
    }
    worker->gather.scratch = calloc(settings->light.estimate.k, sizeof *worker->gather.scratch);
    if (worker->gather.scratch == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %u neighbours", settings->light.estimate.k);
    }
    return PM_OK;
}

/// Adds one eye sample to a pixel's sums.
static void add_sample(pm_pixel *pixel, const pm_eye *eye)
{
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        pixel->layer[layer] = pm_spectrum_add(pixel->layer[layer], eye->layer[layer]);
    }
    pixel->depth += eye->depth;
    pixel->normal = pm_vec_add(pixel->normal, eye->normal);
    pixel->emitter = pixel->emitter || eye->emitter;
}

static void finish_pixel(pm_pixel *pixel, const pm_gather *gather, uint32_t spp, uint32_t hits)
{
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        pixel->layer[layer] = pm_spectrum_scale(pixel->layer[layer], 1.0 / spp);
    }
    if (hits > 0) {
        pixel->depth /= hits;
        pixel->normal = pm_vec_scale(pixel->normal, 1.0 / hits);
    }
    if (gather->lookups > 0) {
        pixel->radius = gather->radius_sum / (double)gather->lookups;
        pixel->count = (double)gather->found_sum / (double)gather->lookups;
    }
}

static pm_status render_pixel(const pm_eye_pass *pass, pm_eye_worker *worker, int x, int y)
{
    const pm_camera *camera = &pass->world->scene->camera;
    uint64_t index = (uint64_t)y * (uint64_t)camera->width + (uint64_t)x;
    uint32_t spp = pass->settings->light.spp;
    pm_rng rng = pm_rng_at(&worker->compose.source, index, 0);
    double shift[2];
    shift[0] = pm_rng_draw(&rng);
    shift[1] = pm_rng_draw(&rng);
    worker->gather.radius_sum = 0.0;
    worker->gather.found_sum = worker->gather.lookups = 0;
    pm_pixel pixel = {0};
    uint32_t hits = 0;
    for (uint32_t s = 0; s < spp; s++) {
        double u[2];
        pm_lattice_point(shift, s, spp, u);
        pm_ray ray =
            pm_camera_ray(camera, (x + u[0]) / camera->width, (y + u[1]) / camera->height);
        pm_eye eye = {0};
        PM_TRY(pm_compose_eye(&worker->compose, &ray, index, s, index * spp + s, &eye));
        add_sample(&pixel, &eye);
        hits += eye.hit;
        worker->cut += eye.cut;
    }
    worker->lookups += worker->gather.lookups;
    finish_pixel(&pixel, &worker->gather, spp, hits);
    pm_picture_set(&pass->picture, index, &pixel);
    return PM_OK;
}

static pm_status render_tile(const pm_eye_pass *pass, pm_eye_worker *worker, int tile)
{
    const pm_camera *camera = &pass->world->scene->camera;
    int left = tile % pass->tiles_x * TILE;
    int top = tile / pass->tiles_x * TILE;
    for (int y = top; y < top + TILE && y < camera->height; y++) {
        for (int x = left; x < left + TILE && x < camera->width; x++) {
            PM_TRY(render_pixel(pass, worker, x, y));
        }
    }
    return pm_interrupt_check();
}

static void tile_done(pm_eye_pass *pass, pm_status status)
{
    pm_progress_add(&pass->progress, 1);
    if (status != PM_OK && pass->status == PM_OK) {
        pass->status = status;
        strncpy(pass->message, pm_status_message(), sizeof pass->message - 1);
    }
}

static void run_tiles(pm_eye_pass *pass)
{
    int tiles = pass->tiles_x * pass->tiles_y;
#pragma omp parallel
    {
        pm_eye_worker worker;
        pm_status made = worker_make(pass, &worker);
        if (made == PM_OK) {
            pm_gather_sources(&worker.gather, &worker.compose);
        }
#pragma omp for schedule(dynamic, 1)
        for (int tile = 0; tile < tiles; tile++) {
            pm_status seen;
#pragma omp atomic read
            seen = pass->status;
            if (seen == PM_OK) {
                pm_status status = made == PM_OK ? render_tile(pass, &worker, tile) : made;
#pragma omp critical
                tile_done(pass, status);
            }
        }
#pragma omp critical
        {
            pass->report->cut += worker.cut + worker.gather.cut;
            pass->report->lookups += worker.lookups;
        }
        free(worker.gather.scratch);
    }
}

static pm_status run_eye_pass(pm_eye_pass *pass)
{
    const pm_camera *camera = &pass->world->scene->camera;
    pass->tiles_x = (camera->width + TILE - 1) / TILE;
    pass->tiles_y = (camera->height + TILE - 1) / TILE;
    pass->progress =
        pm_progress_begin("rendering", (uint64_t)pass->tiles_x * (uint64_t)pass->tiles_y);
    run_tiles(pass);
    pm_progress_end(&pass->progress);
    if (pass->status != PM_OK) {
        pm_status_clear();
        return pm_status_fail(pass->status, "%s", pass->message);
    }
    return PM_OK;
}

pm_status pm_render_image(const pm_intersector *world, const pm_render_settings *settings,
                          const pm_render_maps *maps, pm_image *image, pm_eye_report *report)
{
    double start = pm_seconds_now();
    double cpu_start = pm_cpu_seconds_now();
    pm_image made;
    PM_TRY(pm_picture_make(world->scene->camera.width, world->scene->camera.height, &made));
    pm_eye_report counts = {0};
    pm_eye_pass pass = {
        .world = world,
        .settings = settings,
        .maps = maps,
        .picture = pm_picture_planes(&made),
        .report = &counts,
    };
    pm_status status = settings->view_photons ? pm_photon_dots(world, maps, &pass.picture)
                                              : run_eye_pass(&pass);
    if (status != PM_OK) {
        pm_image_free(&made);
        return status;
    }
    counts.seconds = pm_seconds_now() - start;
    counts.cpu = pm_cpu_seconds_now() - cpu_start;
    *image = made;
    *report = counts;
    return PM_OK;
}

// The second half of a picture: eye rays. A pixel depends on nothing but its own random numbers
// and the maps, so tiles may be dealt to any thread.
#include "render.h"

#include "camera.h"
#include "caps.h"
#include "clock.h"
#include "lattice.h"
#include "lookup.h"
#include "photon_dots.h"
#include "pixel.h"
#include "tiles.h"

#include <stdlib.h>

#define COLOURS 16 // wavelengths a pixel that glass disperses is seen in, over all its samples
#define SPLITS 2 // S events of an eye path at which reflection and refraction are both followed

/// What all threads share.
typedef struct {
    const pm_intersector *world;
    const pm_render_settings *settings;
    const pm_render_maps *maps;
    pm_picture picture;
    pm_eye_report *report;
} pm_eye_pass;

/// What one thread asks with.
typedef struct {
    pm_compose compose;
    pm_gather gather;
    uint64_t cut;
    uint64_t lookups;
} pm_eye_worker;

/// As many entries as the widest of all lookups may find.
static uint32_t scratch_size(const pm_render_settings *settings, const pm_render_maps *maps)
{
    uint32_t size = PM_SHADOW_K;
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        pm_estimate_settings asked = pm_lookup_settings(
            &settings->light.estimate, settings->reach[kind], &maps->map[kind]);
        size = asked.k > size ? asked.k : size;
    }
    return size;
}

static void choose_layers(const pm_render_settings *settings, bool wanted[PM_LAYER_COUNT])
{
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        wanted[layer] = settings->only == PM_NONE || settings->only == layer;
    }
}

static void worker_set_up(const pm_eye_pass *pass, pm_eye_worker *worker)
{
    const pm_render_settings *settings = pass->settings;
    worker->compose.world = pass->world;
    worker->compose.source = (pm_rng_source){settings->seed, PM_STREAM_CAMERA, settings->pass};
    worker->compose.rule = settings->roulette;
    worker->compose.splits = SPLITS;
    worker->compose.samples = settings->light.spp;
    worker->compose.colours = (COLOURS + settings->light.spp - 1) / settings->light.spp;
    worker->compose.max_specular =
        pm_caps_of(pass->world->scene, settings->max_bounces).specular;
    choose_layers(settings, worker->compose.wanted);
    const pm_render_maps *maps = pass->maps;
    worker->gather.settings = settings->light;
    worker->gather.irradiance = maps->irradiance.count > 0 ? &maps->irradiance : NULL;
    worker->gather.shadows = maps->shadows.light_count > 0 ? &maps->shadows : NULL;
    worker->gather.beams = maps->beams.levels > 0 ? &maps->beams : NULL;
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        worker->gather.map[kind] = maps->has[kind] ? &maps->map[kind] : NULL;
        worker->gather.reach[kind] = settings->reach[kind];
    }
    pm_gather_sources(&worker->gather, &worker->compose);
}

static pm_status worker_begin(const void *context, void **out)
{
    const pm_eye_pass *pass = context;
    uint32_t entries = scratch_size(pass->settings, pass->maps);
    pm_eye_worker *worker = calloc(1, sizeof *worker);
    *out = worker;
    if (worker != NULL) {
        worker->gather.scratch = calloc(entries, sizeof *worker->gather.scratch);
    }
    if (worker == NULL || worker->gather.scratch == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %u neighbours", entries);
    }
    worker_set_up(pass, worker);
    return PM_OK;
}

static void worker_end(void *context, void *given)
{
    const pm_eye_pass *pass = context;
    pm_eye_worker *worker = given;
    if (worker == NULL) {
        return;
    }
    pass->report->cut += worker->cut + worker->gather.cut;
    pass->report->lookups += worker->lookups;
    pass->report->near += worker->gather.near;
    pass->report->shadow_rays += worker->gather.shadow_rays;
    pass->report->shadow_spared += worker->gather.shadow_spared;
    free(worker->gather.scratch);
    free(worker);
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

static pm_status render_pixel(const void *context, void *given, int x, int y)
{
    const pm_eye_pass *pass = context;
    pm_eye_worker *worker = given;
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

static pm_status run_eye_pass(pm_eye_pass *pass)
{
    const pm_camera *camera = &pass->world->scene->camera;
    pm_tiles tiles = {
        .what = "rendering",
        .width = camera->width,
        .height = camera->height,
        .context = pass,
        .begin = worker_begin,
        .pixel = render_pixel,
        .end = worker_end,
    };
    return pm_tiles_run(&tiles);
}

void pm_render_look_over(const pm_image *image, pm_eye_report *report)
{
    pm_picture picture = pm_picture_planes(image);
    size_t pixels = (size_t)image->width * (size_t)image->height;
    report->black = true;
    report->too_bright = 0;
    for (size_t i = 0; i < pixels; i++) {
        bool finite = true;
        for (int c = 0; c < 3; c++) {
            float value = picture.total[c][i];
            finite = finite && isfinite(value);
            report->black = report->black && value == 0.0f;
        }
        report->too_bright += finite ? 0 : 1;
    }
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
    pm_render_look_over(&made, &counts);
    counts.seconds = pm_seconds_now() - start;
    counts.cpu = pm_cpu_seconds_now() - cpu_start;
    *image = made;
    *report = counts;
    return PM_OK;
}

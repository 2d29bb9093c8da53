// A pass from the eye writes the two halves of every pixel, a pass from the lights adds to
// them, and the whole is their mean.
#include "reference.h"

#include "camera.h"
#include "clock.h"
#include "compare.h"
#include "lattice.h"
#include "light.h"
#include "light_tracer.h"
#include "pixel.h"
#include "reference_blind.h"
#include "reference_path.h"
#include "tiles.h"

#include <stdlib.h>

_Static_assert(PM_REFERENCE_BLIND_ROOM <= sizeof((pm_reference_report *)0)->blind,
               "a report holds every sentence");

/// Wavelengths of a pixel's samples step by this share of the range: the square root of 2 less
/// 1, which keeps them apart from each other and from the lattice of the film.
#define HUE_STEP 0.41421356237309505

/// What all threads share.
typedef struct {
    const pm_reference_settings *settings;
    pm_reference_eye eye;
    pm_picture whole, half[2];
    size_t pixels;
    uint64_t cut;
} pm_reference_pass;

pm_reference_settings pm_reference_defaults(void)
{
    return (pm_reference_settings){.seed = 1, .spp = 256};
}

static pm_status worker_begin(const void *context, void **worker)
{
    (void)context;
    uint64_t *cut = calloc(1, sizeof *cut);
    *worker = cut;
    return cut != NULL ? PM_OK : PM_FAIL(PM_ENOMEM, "no memory for a thread's count");
}

static void worker_end(void *context, void *worker)
{
    pm_reference_pass *pass = context;
    const uint64_t *cut = worker;
    if (cut != NULL) {
        pass->cut += *cut;
        free(worker);
    }
}

/// The samples of one half: evenly spread over the pixel among themselves, independent of the
/// other half.
static pm_status sample_half(const pm_reference_pass *pass, int half, int x, int y,
                             pm_reference_sum *sum)
{
    const pm_camera *camera = &pass->eye.world->scene->camera;
    uint64_t pixel = (uint64_t)y * (uint64_t)camera->width + (uint64_t)x;
    uint32_t count = pass->settings->spp / 2;
    uint64_t first = pixel * pass->settings->spp + (uint64_t)half * count;
    pm_rng rng = pm_rng_at(&pass->eye.source, first, 0);
    double shift[2];
    shift[0] = pm_rng_draw(&rng);
    shift[1] = pm_rng_draw(&rng);
    double turn = pm_rng_draw(&rng);
    for (uint32_t i = 0; i < count; i++) {
        double u[2];
        pm_lattice_point(shift, i, count, u);
        pm_ray ray =
            pm_camera_ray(camera, (x + u[0]) / camera->width, (y + u[1]) / camera->height);
        double hue = turn + HUE_STEP * i;
        PM_TRY(pm_reference_path(&pass->eye, &ray, first + i, hue - floor(hue), sum));
    }
    return PM_OK;
}

static pm_pixel mean_of(const pm_reference_sum *sum, uint32_t count)
{
    pm_pixel pixel = {.emitter = sum->emitter};
    for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
        pixel.layer[layer] = pm_spectrum_scale(sum->layer[layer], 1.0 / count);
    }
    return pixel;
}

static pm_pixel surface_of(const pm_reference_sum sum[2])
{
    pm_pixel pixel = {.emitter = sum[0].emitter || sum[1].emitter};
    uint64_t hits = sum[0].hits + sum[1].hits;
    if (hits > 0) {
        double share = 1.0 / (double)hits;
        pixel.depth = (sum[0].depth + sum[1].depth) * share;
        pixel.normal = pm_vec_scale(pm_vec_add(sum[0].normal, sum[1].normal), share);
    }
    return pixel;
}

static pm_status trace_pixel(const void *context, void *worker, int x, int y)
{
    const pm_reference_pass *pass = context;
    uint64_t *cut = worker;
    size_t index = (size_t)y * (size_t)pass->eye.world->scene->camera.width + (size_t)x;
    pm_reference_sum sum[2] = {0};
    for (int half = 0; half < 2; half++) {
        PM_TRY(sample_half(pass, half, x, y, &sum[half]));
        pm_pixel pixel = mean_of(&sum[half], pass->settings->spp / 2);
        pm_picture_set(&pass->half[half], index, &pixel);
        *cut += sum[half].cut;
    }
    pm_pixel surface = surface_of(sum);
    pm_picture_set(&pass->whole, index, &surface);
    return PM_OK;
}

static pm_status run_eye(pm_reference_pass *pass)
{
    const pm_camera *camera = &pass->eye.world->scene->camera;
    pm_tiles tiles = {
        .what = "path tracing",
        .width = camera->width,
        .height = camera->height,
        .context = pass,
        .begin = worker_begin,
        .pixel = trace_pixel,
        .end = worker_end,
    };
    return pm_tiles_run(&tiles);
}

static void add_film(const pm_picture *half, const pm_spectrum *film, size_t pixels)
{
    for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
        for (int c = 0; c < 3; c++) {
            float *plane = half->layer[layer][c];
            for (size_t i = 0; i < pixels; i++) {
                plane[i] = (float)((double)plane[i] + film[i * PM_LAYER_COUNT + layer].c[c]);
            }
        }
    }
}

/// Light paths of one half, a pass of its own.
static pm_status trace_lights(pm_reference_pass *pass, int half)
{
    pm_spectrum *film = calloc(pass->pixels * PM_LAYER_COUNT, sizeof *film);
    if (film == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for light paths to %zu pixels", pass->pixels);
    }
    uint64_t paths = pass->settings->light_paths;
    pm_light_tracing tracing = {
        .world = pass->eye.world,
        .source = {pass->settings->seed, PM_STREAM_LIGHT_PATHS, (uint32_t)half},
        .count = half == 0 ? paths - paths / 2 : paths / 2,
        .rule = pass->settings->roulette,
        .caps = pass->eye.caps,
    };
    pm_status status = pm_light_tracer_run(&tracing, film, &pass->cut);
    if (status == PM_OK) {
        add_film(&pass->half[half], film, pass->pixels);
    }
    free(film);
    return status;
}

static pm_status run_passes(pm_reference_pass *pass)
{
    PM_TRY(run_eye(pass));
    for (int half = 0; half < 2 && pass->settings->light_paths > 0; half++) {
        PM_TRY(trace_lights(pass, half));
    }
    pm_picture_join(&pass->whole, pass->half, pass->pixels);
    return PM_OK;
}

/// Each half must send at least one path from each light.
static pm_status check_light_paths(const pm_scene *scene, uint64_t paths)
{
    uint64_t lights = 0;
    for (int i = 0; i < scene->light_count; i++) {
        const pm_light *light = &scene->lights[i];
        lights += pm_light_tracer_takes(light) && !pm_spectrum_is_black(light->flux);
    }
    if (paths / 2 < lights || paths / 2 >= PM_EMIT_MAX) {
        return pm_status_fail(PM_EINPUT,
                              "%s: light paths must be 0 or lie between %llu (two a light) and"
                              " %llu, got %llu",
                              scene->path, 2 * (unsigned long long)lights,
                              2 * (unsigned long long)PM_EMIT_MAX - 1,
                              (unsigned long long)paths);
    }
    return PM_OK;
}

/// Checks the settings. Light paths are only traced where there is something for them to find.
static pm_status check(const pm_scene *scene, pm_reference_settings *settings,
                       pm_reference_report *report)
{
    if (settings->spp == 0 || settings->spp % 2 != 0) {
        return pm_status_fail(PM_EINPUT,
                              "--spp: samples of a pixel must be even and above 0, half of them"
                              " for each half of the picture, got %u",
                              settings->spp);
    }
    pm_reference_blind(scene, false, report->blind);
    if (settings->light_paths > 0 && report->blind[0] != '\0') {
        PM_TRY(check_light_paths(scene, settings->light_paths));
        pm_reference_blind(scene, true, report->blind);
        report->light_paths = settings->light_paths;
    }
    settings->light_paths = report->light_paths;
    return PM_OK;
}

static double luminance_at(const pm_picture *picture, size_t i)
{
    return pm_spectrum_luminance(pm_rgb((double)picture->total[0][i],
                                        (double)picture->total[1][i],
                                        (double)picture->total[2][i]));
}

static void look_over(const pm_reference_pass *pass, pm_reference_report *report)
{
    report->black = true;
    for (size_t i = 0; i < pass->pixels; i++) {
        double brightness = luminance_at(&pass->whole, i);
        double one = luminance_at(&pass->half[0], i);
        double two = luminance_at(&pass->half[1], i);
        bool finite = isfinite(brightness) && isfinite(one) && isfinite(two);
        report->too_bright += finite ? 0 : 1;
        report->black = report->black && brightness == 0.0;
    }
}

/// Root mean square of what the halves say the noise of their mean is, over the mean.
static double error_of(const pm_reference_pass *pass, const pm_compare_pair *pair)
{
    double squares = 0.0;
    double sum = 0.0;
    for (size_t i = 0; i < pass->pixels; i++) {
        if (pair->counted[i]) {
            double one = luminance_at(&pass->half[0], i);
            double two = luminance_at(&pass->half[1], i);
            squares += 0.25 * (one - two) * (one - two);
            sum += luminance_at(&pass->whole, i);
        }
    }
    double count = (double)pair->count;
    return sum == 0.0 ? 0.0 : sqrt(squares / count) / (sum / count);
}

/// Over the pixels that compare counts; over all where it counts none.
static pm_status estimate_error(const pm_reference_pass *pass, const pm_image *image,
                                pm_reference_report *report)
{
    static const char *const names[2] = {"the picture", "the picture"};
    report->rel_error = (double)NAN;
    if (report->too_bright > 0) {
        return PM_OK;
    }
    pm_compare_pair pair;
    pm_status status = pm_compare_pair_make(image, image, names, true, &pair);
    if (status == PM_EINPUT) { // no pixel is left
        pm_status_clear();
        status = pm_compare_pair_make(image, image, names, false, &pair);
    }
    PM_TRY(status);
    report->rel_error = error_of(pass, &pair);
    pm_compare_pair_free(&pair);
    return PM_OK;
}

static pm_status make_picture(pm_reference_pass *pass, pm_image *image,
                              pm_reference_report *report)
{
    const pm_camera *camera = &pass->eye.world->scene->camera;
    PM_TRY(pm_picture_make_halved(camera->width, camera->height, image));
    pass->whole = pm_picture_planes(image);
    pass->half[0] = pm_picture_half(image, 0);
    pass->half[1] = pm_picture_half(image, 1);
    pass->pixels = (size_t)camera->width * (size_t)camera->height;
    PM_TRY(run_passes(pass));
    look_over(pass, report);
    report->cut = pass->cut;
    return estimate_error(pass, image, report);
}

pm_status pm_reference_image(const pm_intersector *world, const pm_reference_settings *settings,
                             pm_image *image, pm_reference_report *report)
{
    double start = pm_seconds_now();
    pm_reference_settings checked = *settings;
    pm_reference_report made_report = {0};
    PM_TRY(check(world->scene, &checked, &made_report));
    pm_reference_pass pass = {
        .settings = &checked,
        .eye = {.world = world,
                .source = {checked.seed, PM_STREAM_REFERENCE, 0},
                .rule = checked.roulette,
                .caps = pm_caps_of(world->scene, checked.max_bounces),
                .sky = pm_light_sky(world->scene)},
    };
    pm_image made = {0};
    pm_status status = make_picture(&pass, &made, &made_report);
    if (status != PM_OK) {
        pm_image_free(&made);
        return status;
    }
    made_report.seconds = pm_seconds_now() - start;
    *image = made;
    *report = made_report;
    return PM_OK;
}

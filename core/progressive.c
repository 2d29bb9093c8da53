// A pass is an ordinary picture with its own random numbers and a reach for each map; what it
// brings is added plane by plane, in double.
#include "progressive.h"

#include "first_radius.h"
#include "interrupt.h"
#include "pixel.h"

#include <math.h>
#include <stdlib.h>

// Up to here the schedule is multiplied out; beyond, a series is as exact.
#define PRODUCT_MOST 65536u

// --- the schedule ----------------------------------------------------------------------------

/// Gamma(n + a) / Gamma(n + 1) by its series in 1 / n; at PRODUCT_MOST the next term is 1e-17.
static double gamma_ratio(double n, double a)
{
    double power = a - 1.0;
    double first = 0.5 * power * a / n;
    double second = power * (power - 1.0) / 24.0 * (3.0 * a * a - a) / (n * n);
    return pow(n, power) * (1.0 + first + second);
}

/// What is left of the square of the radius, of a ball of its cube, in this pass.
static double shrunk(uint64_t pass)
{
    const double a = PM_PROGRESSIVE_ALPHA;
    if (pass > PRODUCT_MOST) {
        return gamma_ratio((double)pass, a) / tgamma(1.0 + a);
    }
    double left = 1.0;
    for (uint64_t i = 1; i < pass; i++) {
        left *= ((double)i + a) / ((double)i + 1.0);
    }
    return left;
}

double pm_progressive_radius(uint64_t pass, int dimensions)
{
    double left = shrunk(pass);
    return dimensions == 3 ? cbrt(left) : sqrt(left);
}

int pm_progressive_dimensions(const pm_render_settings *settings, pm_map_kind kind)
{
    return kind == PM_MAP_VOLUME && settings->light.media == PM_MEDIA_MARCH ? 3 : 2;
}

// --- radii -----------------------------------------------------------------------------------

/// Photons that an eye path does not ask the map of `kind` about.
static uint16_t skipped(const pm_render_settings *settings, pm_map_kind kind)
{
    switch (kind) {
    case PM_MAP_GLOBAL:
        return settings->light.rays == 0 ? PM_PHOTON_FIRST | PM_PHOTON_CAUSTIC : 0;
    case PM_MAP_VOLUME:
        return PM_PHOTON_FIRST;
    default:
        return 0;
    }
}

/// The first radius of a map that has photons, where it is not known yet.
static pm_status find_first(const pm_render_settings *settings, const pm_render_maps *maps,
                            pm_map_kind kind, double *first)
{
    const pm_estimate_settings *estimate = &settings->light.estimate;
    if (*first > 0.0 || !maps->has[kind]) {
        return PM_OK;
    }
    if (isfinite(estimate->radius)) {
        *first = estimate->radius;
        return PM_OK;
    }
    return pm_first_radius(&maps->map[kind], estimate->k, skipped(settings, kind), first);
}

static pm_status set_reaches(const pm_render_maps *maps, pm_render_settings *settings,
                             double first[PM_MAP_COUNT])
{
    for (pm_map_kind kind = 0; kind < PM_MAP_COUNT; kind++) {
        PM_TRY(find_first(settings, maps, kind, &first[kind]));
        int dimensions = pm_progressive_dimensions(settings, kind);
        uint64_t pass = (uint64_t)settings->pass + 1;
        settings->reach[kind] = first[kind] * pm_progressive_radius(pass, dimensions);
    }
    return PM_OK;
}

// --- sums ------------------------------------------------------------------------------------

static size_t pixels_of(const pm_progressive *progressive)
{
    return (size_t)progressive->width * (size_t)progressive->height;
}

pm_status pm_progressive_begin(const pm_scene *scene, pm_progressive *progressive)
{
    progressive->width = scene->camera.width;
    progressive->height = scene->camera.height;
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        PM_TRY(pm_audit_make(scene, &progressive->map[kind].pass.audit));
    }
    size_t pixels = pixels_of(progressive);
    progressive->sum = calloc(pixels * PM_SUM_PLANES, sizeof *progressive->sum);
    return progressive->sum != NULL ? PM_OK
                                    : PM_FAIL(PM_ENOMEM, "no memory for the sums of %dx%d",
                                              progressive->width, progressive->height);
}

void pm_progressive_free(pm_progressive *progressive)
{
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        pm_pass_report_free(&progressive->map[kind].pass);
    }
    free(progressive->sum);
    *progressive = (pm_progressive){0};
}

static void add_plane(const pm_progressive *progressive, int plane, const float *part)
{
    size_t pixels = pixels_of(progressive);
    double *sum = progressive->sum + (size_t)plane * pixels;
    for (size_t i = 0; i < pixels; i++) {
        sum[i] += (double)part[i];
    }
}

static void add_hits(const pm_progressive *progressive, const float *depth)
{
    size_t pixels = pixels_of(progressive);
    double *sum = progressive->sum + (size_t)PM_SUM_HITS * pixels;
    for (size_t i = 0; i < pixels; i++) {
        sum[i] += depth[i] > 0.0f ? 1.0 : 0.0;
    }
}

static void add_image(const pm_progressive *progressive, const pm_image *image)
{
    pm_picture part = pm_picture_planes(image);
    for (int c = 0; c < 3; c++) {
        for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
            add_plane(progressive, 3 * layer + c, part.layer[layer][c]);
        }
        add_plane(progressive, PM_SUM_NORMAL + c, part.normal[c]);
    }
    add_plane(progressive, PM_SUM_DEPTH, part.depth);
    add_plane(progressive, PM_SUM_RADIUS, part.radius);
    add_plane(progressive, PM_SUM_COUNT, part.count);
    add_plane(progressive, PM_SUM_EMITTER, part.emitter);
    add_hits(progressive, part.depth);
}

static void add_eye(const pm_eye_report *part, pm_eye_report *sum)
{
    sum->seconds += part->seconds;
    sum->cpu += part->cpu;
    sum->lookups += part->lookups;
    sum->cut += part->cut;
    sum->near += part->near;
    sum->shadow_rays += part->shadow_rays;
    sum->shadow_spared += part->shadow_spared;
}

static void add_books(const pm_pass_report *part, pm_pass_report *sum)
{
    pm_audit_add(&sum->audit, &part->audit);
    sum->emitted += part->emitted;
    sum->deposits += part->deposits;
    sum->deposited = pm_spectrum_add(sum->deposited, part->deposited);
    sum->seconds += part->seconds;
    sum->emit_cpu += part->emit_cpu;
    sum->trace_cpu += part->trace_cpu;
    sum->store_cpu += part->store_cpu;
}

static void add_maps(const pm_render_maps *maps, pm_progressive *progressive)
{
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        pm_progressive_map *to = &progressive->map[kind];
        if (maps->has[kind]) {
            pm_map_sum part = pm_map_sum_of(&maps->map[kind]);
            pm_map_sum_add(&to->sum, &part);
            add_books(&maps->pass[kind], &to->pass);
            to->balance_seconds += maps->balance_seconds[kind];
        }
    }
    progressive->shadow_photons += maps->shadow_photons;
    progressive->places += maps->irradiance.count;
    progressive->shadow_seconds += maps->shadow_seconds;
    progressive->irradiance_seconds += maps->irradiance_seconds;
    progressive->beams_seconds += maps->beams_seconds;
}

// --- passes ----------------------------------------------------------------------------------

static pm_status check(const pm_scene *scene, const pm_render_settings *settings,
                       const pm_progressive *progressive)
{
    if (settings->stored > 0 || settings->view_photons) {
        return PM_FAIL(PM_EINPUT, "%s",
                       "passes emit a number of photons and make pictures: no stored number, "
                       "no photons as dots");
    }
    if (progressive->passes >= PM_PROGRESSIVE_MOST) {
        return PM_FAIL(PM_EINPUT, "there are at most %u passes", PM_PROGRESSIVE_MOST);
    }
    if (progressive->sum != NULL && (progressive->width != scene->camera.width ||
                                     progressive->height != scene->camera.height)) {
        return PM_FAIL(PM_EINPUT, "passes are of one size, got %dx%d after %dx%d",
                       scene->camera.width, scene->camera.height, progressive->width,
                       progressive->height);
    }
    return PM_OK;
}

/// Maps, their radii, and the picture of one pass.
static pm_status do_pass(const pm_intersector *world, pm_render_settings *settings,
                         double first[PM_MAP_COUNT], pm_render_maps *maps, pm_image *image,
                         pm_eye_report *eye)
{
    PM_TRY(pm_interrupt_check());
    pm_render_maps_renew(maps);
    PM_TRY(pm_render_trace_maps(world, settings, maps));
    PM_TRY(set_reaches(maps, settings, first));
    PM_TRY(pm_render_ready_maps(world, settings, maps));
    return pm_render_image(world, settings, maps, image, eye);
}

pm_status pm_progressive_pass(const pm_intersector *world, const pm_render_settings *settings,
                              pm_progressive *progressive, pm_render_maps *maps)
{
    PM_TRY(check(world->scene, settings, progressive));
    if (progressive->sum == NULL) {
        PM_TRY(pm_progressive_begin(world->scene, progressive));
    }
    pm_render_settings own = *settings;
    own.pass = progressive->passes;
    double first[PM_MAP_COUNT];
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        first[kind] = progressive->map[kind].first;
    }
    pm_image image;
    pm_eye_report eye;
    PM_TRY(do_pass(world, &own, first, maps, &image, &eye));
    add_image(progressive, &image);
    pm_image_free(&image);
    add_eye(&eye, &progressive->eye);
    add_maps(maps, progressive);
    for (int kind = 0; kind < PM_MAP_COUNT; kind++) {
        progressive->map[kind].first = first[kind];
    }
    progressive->passes++;
    return PM_OK;
}

// --- what all passes together are ------------------------------------------------------------

static double sum_at(const pm_progressive *progressive, int plane, size_t i)
{
    return progressive->sum[(size_t)plane * pixels_of(progressive) + i];
}

static pm_pixel mean_pixel(const pm_progressive *progressive, size_t i)
{
    double passes = progressive->passes;
    double hits = sum_at(progressive, PM_SUM_HITS, i);
    pm_pixel pixel = {
        .radius = sum_at(progressive, PM_SUM_RADIUS, i) / passes,
        .count = sum_at(progressive, PM_SUM_COUNT, i) / passes,
        .emitter = sum_at(progressive, PM_SUM_EMITTER, i) > 0.0,
    };
    for (int plane = 0; plane < PM_SUM_DEPTH; plane++) {
        pixel.layer[plane / 3].c[plane % 3] = sum_at(progressive, plane, i) / passes;
    }
    if (hits > 0.0) {
        pixel.depth = sum_at(progressive, PM_SUM_DEPTH, i) / hits;
        pixel.normal = pm_vec(sum_at(progressive, PM_SUM_NORMAL, i) / hits,
                              sum_at(progressive, PM_SUM_NORMAL + 1, i) / hits,
                              sum_at(progressive, PM_SUM_NORMAL + 2, i) / hits);
    }
    return pixel;
}

pm_status pm_progressive_image(const pm_progressive *progressive, pm_image *image,
                               pm_eye_report *report)
{
    if (progressive->passes == 0) {
        return PM_FAIL(PM_EINPUT, "%s", "there is no picture before the first pass");
    }
    pm_image made;
    PM_TRY(pm_picture_make(progressive->width, progressive->height, &made));
    pm_picture planes = pm_picture_planes(&made);
    for (size_t i = 0; i < pixels_of(progressive); i++) {
        pm_pixel pixel = mean_pixel(progressive, i);
        pm_picture_set(&planes, i, &pixel);
    }
    *report = progressive->eye;
    pm_render_look_over(&made, report);
    *image = made;
    return PM_OK;
}

/// The books of one map, as one pass would have them.
static pm_status mean_books(const pm_scene *scene, const pm_progressive_map *from,
                            uint32_t passes, pm_pass_report *mean)
{
    *mean = from->pass;
    mean->share = NULL;
    mean->deposited = pm_spectrum_scale(from->pass.deposited, 1.0 / passes);
    mean->audit = (pm_audit){0};
    PM_TRY(pm_audit_make(scene, &mean->audit));
    pm_audit_add(&mean->audit, &from->pass.audit);
    pm_audit_scale(&mean->audit, 1.0 / passes);
    return PM_OK;
}

pm_status pm_progressive_books(const pm_scene *scene, const pm_render_settings *settings,
                               const pm_progressive *progressive, pm_render_maps *maps)
{
    PM_TRY(pm_render_plan(scene, settings, maps));
    for (int kind = 0; kind < PM_MAP_COUNT && progressive->passes > 0; kind++) {
        const pm_progressive_map *from = &progressive->map[kind];
        maps->has[kind] = maps->photons[kind] > 0;
        maps->balance_seconds[kind] = from->balance_seconds;
        PM_TRY(mean_books(scene, from, progressive->passes, &maps->pass[kind]));
    }
    maps->shadow_photons = progressive->shadow_photons;
    maps->shadow_seconds = progressive->shadow_seconds;
    maps->irradiance_seconds = progressive->irradiance_seconds;
    maps->beams_seconds = progressive->beams_seconds;
    return PM_OK;
}

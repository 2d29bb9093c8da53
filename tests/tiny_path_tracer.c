// Invariant: a path goes on by one lobe with the lobe's mean albedo as its probability, and
// what it has met is spelled in letters. In a medium every stretch draws its own free way; an
// exponential one forgets how far it has come.
#include "tiny_path_tracer.h"

#include "camera.h"
#include "material.h"
#include "test.h"
#include "wavelength.h"

#include <string.h>

enum { BLOCK = 1000, LETTERS = 256 };

typedef struct {
    pm_ray ray;
    pm_spectrum weight;
    char met[LETTERS]; // S, D and V, from the eye on
    int events;
} tiny_path;

static pm_layer sort_path(const char *met)
{
    if (met[0] == '\0') {
        return PM_LAYER_EMISSION;
    }
    if (met[0] == 'S') {
        return PM_LAYER_SPECULAR;
    }
    if (met[0] == 'V') {
        return PM_LAYER_VOLUME;
    }
    if (met[1] == '\0') {
        return PM_LAYER_DIRECT;
    }
    return strpbrk(met + 1, "DV") == NULL ? PM_LAYER_CAUSTIC : PM_LAYER_INDIRECT;
}

static void see(pm_spectrum radiance, const tiny_path *path, pm_spectrum layer[PM_LAYER_COUNT])
{
    pm_layer into = sort_path(path->met);
    layer[into] = pm_spectrum_add(layer[into], pm_spectrum_mul(path->weight, radiance));
}

static void see_lamp(const pm_scene *scene, const pm_hit *hit, const tiny_path *path,
                     pm_spectrum layer[PM_LAYER_COUNT])
{
    int light = scene->shapes[hit->shape].light;
    if (light != PM_NONE && pm_vec_dot(path->ray.direction, hit->normal) < 0.0) {
        see(scene->lights[light].emitted, path, layer);
    }
}

static void see_sky(const pm_scene *scene, const tiny_path *path,
                    pm_spectrum layer[PM_LAYER_COUNT])
{
    for (int i = 0; i < scene->light_count; i++) {
        if (scene->lights[i].type == PM_LIGHT_CONSTANT) {
            see(scene->lights[i].emitted, path, layer);
        }
    }
}

static char letter_of(const pm_lobes *lobes, int which)
{
    pm_lobe_type type = lobes->lobe[which].type;
    if (type == PM_LOBE_GLOSSY) {
        return lobes->material->alpha <= 0.1 ? 'S' : 'D';
    }
    return type == PM_LOBE_DIFFUSE || type == PM_LOBE_COATED ? 'D' : 'S';
}

/// Goes on by one of the lobes; false when the path is absorbed.
static bool turn(const pm_hit *hit, const pm_lobes *lobes, pm_rng *rng, tiny_path *path)
{
    double left = pm_rng_draw(rng);
    for (int i = 0; i < lobes->count; i++) {
        double p = pm_spectrum_mean(lobes->lobe[i].albedo);
        if (left >= p) {
            left -= p;
            continue;
        }
        pm_scatter scatter;
        pm_material_sample(lobes, i, rng, &scatter);
        pm_spectrum factor = pm_spectrum_mul(lobes->lobe[i].albedo, scatter.weight);
        factor = pm_spectrum_scale(factor, scatter.radiance / p);
        path->weight = pm_spectrum_mul(path->weight, factor);
        char letter = letter_of(lobes, i);
        double wavelength = letter == 'S' ? path->ray.wavelength : 0.0;
        path->met[path->events++] = letter;
        path->ray = pm_hit_ray(hit, scatter.wo, wavelength, scatter.medium);
        CHECK(path->events < LETTERS);
        return !pm_spectrum_is_black(path->weight);
    }
    return false;
}

/// Henyey and Greenstein's function by refusal: `peak` is its highest value.
static pm_vec3 drawn_way(pm_vec3 before, double g, pm_rng *rng)
{
    double peak = pow(1.0 + fabs(g), 2.0) / pow(1.0 - fabs(g), 2.0) / (1.0 + fabs(g));
    for (;;) {
        double z = 2.0 * pm_rng_draw(rng) - 1.0;
        double turn = 2.0 * PM_PI * pm_rng_draw(rng);
        double height = pm_rng_draw(rng);
        double sine = sqrt(1.0 - z * z);
        pm_vec3 way = pm_vec(sine * cos(turn), sine * sin(turn), z);
        double cosine = pm_vec_dot(before, way);
        double value = (1.0 - g * g) / pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
        if (height * peak < value) {
            return way;
        }
    }
}

/// Whether the path collides before it has gone `length`, and where it goes on then, if at all.
static bool collides(const pm_scene *scene, tiny_path *path, double length, pm_rng *rng,
                     bool *goes_on)
{
    if (path->ray.medium == PM_NONE) {
        return false;
    }
    const pm_medium *medium = &scene->media[path->ray.medium];
    double way = -log(1.0 - pm_rng_draw(rng)) / medium->sigma_t;
    if (way >= length) {
        return false;
    }
    double p = pm_spectrum_mean(medium->albedo);
    *goes_on = pm_rng_draw(rng) < p;
    path->weight = pm_spectrum_mul(path->weight,
                                   pm_spectrum_scale(medium->albedo, p > 0.0 ? 1.0 / p : 0.0));
    path->met[path->events++] = 'V';
    CHECK(path->events < LETTERS);
    path->ray.origin = pm_vec_along(path->ray.origin, path->ray.direction, way);
    path->ray.direction = drawn_way(path->ray.direction, medium->g, rng);
    path->ray.wavelength = 0.0;
    return true;
}

/// At the surface `hit`; false when the path ends there.
static bool meet(const pm_scene *scene, const pm_hit *hit, pm_rng *rng, tiny_path *path,
                 pm_spectrum layer[PM_LAYER_COUNT])
{
    pm_lobes lobes;
    see_lamp(scene, hit, path, layer);
    pm_material_lobes(scene, hit, &path->ray, &lobes);
    if (lobes.passes) {
        path->ray =
            pm_hit_ray(hit, path->ray.direction, path->ray.wavelength, lobes.medium_beyond);
        return true;
    }
    if (lobes.disperses) {
        path->ray.wavelength = pm_wavelength_at(pm_rng_draw(rng));
        path->weight =
            pm_spectrum_mul(path->weight, pm_wavelength_weight(path->ray.wavelength));
        pm_material_lobes(scene, hit, &path->ray, &lobes);
    }
    return turn(hit, &lobes, rng, path);
}

static void follow(const pm_intersector *world, tiny_path *path, pm_rng *rng,
                   pm_spectrum layer[PM_LAYER_COUNT])
{
    for (bool goes_on = true; goes_on;) {
        pm_hit hit;
        bool met = pm_closest(world, &path->ray, &hit);
        if (collides(world->scene, path, met ? hit.t : HUGE_VAL, rng, &goes_on)) {
            continue;
        }
        if (!met) {
            see_sky(world->scene, path, layer);
            return;
        }
        goes_on = meet(world->scene, &hit, rng, path, layer);
    }
}

static void trace_one(const pm_intersector *world, uint64_t index, pm_pictures_means *sums)
{
    const pm_rng_source source = {.seed = 7, .stream = PM_STREAM_TEST};
    pm_rng rng = pm_rng_at(&source, index, 0);
    double u = pm_rng_draw(&rng);
    double v = pm_rng_draw(&rng);
    tiny_path path = {.ray = pm_camera_ray(&world->scene->camera, u, v),
                      .weight = pm_gray(1.0)};
    pm_spectrum layer[PM_LAYER_COUNT] = {0};
    follow(world, &path, &rng, layer);
    pm_pictures_add(sums, layer);
}

static void add(pm_pictures_means *all, const pm_pictures_means *block)
{
    for (int l = 0; l < PM_LAYER_COUNT; l++) {
        all->mean[l] = pm_spectrum_add(all->mean[l], block->mean[l]);
        all->variance[l] = pm_spectrum_add(all->variance[l], block->variance[l]);
    }
}

pm_pictures_means pm_tiny_trace(const pm_intersector *world, uint32_t paths)
{
    for (int i = 0; i < world->scene->light_count; i++) {
        pm_light_type type = world->scene->lights[i].type;
        CHECK(type == PM_LIGHT_AREA || type == PM_LIGHT_CONSTANT);
    }
    int blocks = (int)((paths + BLOCK - 1) / BLOCK);
    pm_pictures_means all = {0};
    for (int b = 0; b < blocks; b++) {
        pm_pictures_means block = {0};
        for (uint64_t i = 0; i < BLOCK; i++) {
            trace_one(world, (uint64_t)b * BLOCK + i, &block);
        }
        add(&all, &block);
    }
    pm_pictures_finish(&all, (double)blocks * BLOCK);
    return all;
}

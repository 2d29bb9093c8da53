// Invariant: a path goes on by one lobe with the lobe's mean albedo as its probability, and
// what it has met is spelled in letters.
#include "tiny_path_tracer.h"

#include "camera.h"
#include "material.h"
#include "test.h"

#include <string.h>

enum { BLOCK = 1000, LETTERS = 256 };

typedef struct {
    pm_ray ray;
    pm_spectrum weight;
    char met[LETTERS]; // S and D, from the eye on
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
    if (met[1] == '\0') {
        return PM_LAYER_DIRECT;
    }
    return strchr(met + 1, 'D') == NULL ? PM_LAYER_CAUSTIC : PM_LAYER_INDIRECT;
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
        path->met[path->events++] = letter_of(lobes, i);
        path->ray = pm_hit_ray(hit, scatter.wo, 0.0, scatter.medium);
        CHECK(path->events < LETTERS);
        return !pm_spectrum_is_black(path->weight);
    }
    return false;
}

static void follow(const pm_intersector *world, tiny_path *path, pm_rng *rng,
                   pm_spectrum layer[PM_LAYER_COUNT])
{
    for (bool goes_on = true; goes_on;) {
        pm_hit hit;
        if (!pm_closest(world, &path->ray, &hit)) {
            see_sky(world->scene, path, layer);
            return;
        }
        pm_lobes lobes;
        pm_material_lobes(world->scene, &hit, &path->ray, &lobes);
        CHECK(!lobes.passes);
        see_lamp(world->scene, &hit, path, layer);
        goes_on = turn(&hit, &lobes, rng, path);
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

// The eye path goes on at S events only; every diffuse surface on it is asked for its light and
// ends it as far as D is concerned.
#include "compose.h"

#include "lattice.h"

#include <stddef.h>

/// Where light found in `layer` belongs: once the path has had an S event, to specular.
static pm_layer layer_on(const pm_eye_path *path, pm_layer layer)
{
    return path->specular > 0 ? PM_LAYER_SPECULAR : layer;
}

static void add(const pm_eye_path *path, pm_layer into, pm_spectrum radiance, pm_eye *eye)
{
    eye->layer[into] =
        pm_spectrum_add(eye->layer[into], pm_spectrum_mul(path->weight, radiance));
}

typedef pm_status (*pm_source_fn)(void *context, const pm_vertex *at, pm_spectrum *radiance);

static pm_status ask(const pm_compose *compose, pm_source_fn source, const pm_vertex *at,
                     const pm_eye_path *path, pm_layer layer, pm_eye *eye)
{
    pm_layer into = layer_on(path, layer);
    if (source == NULL || !compose->wanted[into]) {
        return PM_OK;
    }
    pm_spectrum radiance = pm_gray(0.0);
    PM_TRY(source(compose->ask.context, at, &radiance));
    add(path, into, radiance, eye);
    return PM_OK;
}

/// What shines where the path meets nothing. Asked for the mask's sake even where its layer is
/// not wanted.
static pm_status ask_sky(const pm_compose *compose, const pm_eye_path *path, pm_eye *eye)
{
    pm_layer into = layer_on(path, PM_LAYER_EMISSION);
    if (compose->ask.sky == NULL) {
        return PM_OK;
    }
    pm_spectrum radiance = pm_gray(0.0);
    PM_TRY(compose->ask.sky(compose->ask.context, &path->ray, &radiance));
    eye->emitter = eye->emitter || !pm_spectrum_is_black(radiance);
    if (compose->wanted[into]) {
        add(path, into, radiance, eye);
    }
    return PM_OK;
}

/// What a medium scatters into the eye path on its way to the vertex, or away.
static pm_status ask_volume(const pm_compose *compose, pm_eye_path *path, bool met,
                            const pm_vertex *at, pm_eye *eye)
{
    pm_eye_path before = *path;
    pm_stretch through;
    pm_layer into = layer_on(path, PM_LAYER_VOLUME);
    if (!pm_eye_path_attenuate(compose->world->scene, path, met, at, &through)) {
        return PM_OK;
    }
    through.number = ++eye->stretches;
    if (compose->ask.volume == NULL || !compose->wanted[into]) {
        return PM_OK;
    }
    pm_spectrum radiance = pm_gray(0.0);
    PM_TRY(compose->ask.volume(compose->ask.context, &through, &radiance));
    add(&before, into, radiance, eye);
    return PM_OK;
}

static pm_status ask_diffuse(const pm_compose *compose, const pm_vertex *at,
                             const pm_eye_path *path, pm_eye *eye)
{
    const pm_compose_sources *sources = &compose->ask;
    if (at->lobes.diffuse) {
        PM_TRY(ask(compose, sources->direct, at, path, PM_LAYER_DIRECT, eye));
        PM_TRY(ask(compose, sources->caustic, at, path, PM_LAYER_CAUSTIC, eye));
        PM_TRY(ask(compose, sources->indirect, at, path, PM_LAYER_INDIRECT, eye));
    }
    return PM_OK;
}

static void note_first(const pm_vertex *at, const pm_eye_path *path, pm_eye *eye)
{
    if (!eye->hit) {
        eye->hit = true;
        eye->depth = pm_vec_length(pm_vec_sub(at->hit.position, path->from));
        eye->normal = at->lobes.normal;
    }
}

static bool emits_towards(const pm_scene *scene, const pm_vertex *at)
{
    return scene->shapes[at->hit.shape].light != PM_NONE &&
           pm_vec_dot(at->lobes.wi, at->hit.normal) > 0.0;
}

/// The next surface that does something to the path. A lamp shines even where its surface is
/// null: photons and shadow rays start on it all the same.
static pm_status next_vertex(const pm_compose *compose, pm_eye_path *path, pm_vertex *at,
                             pm_eye *eye, bool *found)
{
    while (true) {
        *found = pm_eye_path_meet(compose->world, path, at);
        PM_TRY(ask_volume(compose, path, *found, at, eye));
        if (!*found) {
            return ask_sky(compose, path, eye);
        }
        if (emits_towards(compose->world->scene, at)) {
            eye->emitter = true;
            PM_TRY(ask(compose, compose->ask.emitted, at, path, PM_LAYER_EMISSION, eye));
        }
        if (!at->lobes.passes) {
            return PM_OK;
        }
        pm_eye_path_pass(path, at);
    }
}

/// Whether an S lobe there is rough: it shows lamps by chance only, and they are asked, too.
static bool glints(const pm_lobes *lobes)
{
    for (int i = 0; i < lobes->count; i++) {
        if (lobes->lobe[i].specular && lobes->lobe[i].type == PM_LOBE_GLOSSY) {
            return true;
        }
    }
    return false;
}

/// Lamps shown by the S event that the path is about to have.
static pm_status ask_glint(const pm_compose *compose, const pm_vertex *at,
                           const pm_eye_path *path, pm_eye *eye)
{
    pm_source_fn source = glints(&at->lobes) ? compose->ask.glint : NULL;
    return ask(compose, source, at, path, PM_LAYER_SPECULAR, eye);
}

static pm_status follow(const pm_compose *compose, pm_eye_path path, pm_vertex at,
                        uint64_t index, pm_eye *eye);

static pm_status follow_every_lobe(const pm_compose *compose, const pm_eye_path *path,
                                   const pm_vertex *at, uint64_t index, pm_rng *rng,
                                   pm_eye *eye)
{
    for (int i = 0; i < at->lobes.count; i++) {
        if (!at->lobes.lobe[i].specular) {
            continue;
        }
        pm_spectrum weight = pm_spectrum_mul(path->weight, at->lobes.lobe[i].albedo);
        pm_eye_path branch = pm_eye_path_turned(path, at, i, weight, rng);
        PM_TRY(follow(compose, branch, *at, index, eye));
    }
    return PM_OK;
}

/// All that happens at a vertex: the light asked for there, and the turns taken.
static pm_status leave(const pm_compose *compose, pm_eye_path *path, const pm_vertex *at,
                       uint64_t index, pm_eye *eye, bool *goes_on)
{
    *goes_on = false;
    PM_TRY(ask_diffuse(compose, at, path, eye));
    if (!pm_eye_path_may_turn(path, at, compose->max_specular, &eye->cut)) {
        return PM_OK;
    }
    PM_TRY(ask_glint(compose, at, path, eye));
    pm_rng rng = pm_rng_at(&compose->source, index, at->vertex);
    if (path->specular < compose->splits) {
        return follow_every_lobe(compose, path, at, index, &rng, eye);
    }
    return pm_eye_path_choose(path, at, compose->rule, &rng, goes_on);
}

/// Where in each of its shares of the range an eye sample takes its wavelengths: the samples of
/// a pixel go through a share evenly, from a start that all of them have in common.
static double phase(const pm_compose *compose, const pm_vertex *at)
{
    pm_rng rng = pm_rng_at(&compose->source, at->pixel, UINT32_MAX);
    uint32_t samples = compose->samples > 0 ? compose->samples : 1;
    return pm_lattice_apart(pm_rng_draw(&rng), at->sample, samples);
}

/// The path splits into even shares of the range of wavelengths, each a vertex of its own.
static pm_status follow_every_colour(const pm_compose *compose, const pm_eye_path *path,
                                     const pm_vertex *at, uint64_t index, pm_eye *eye)
{
    uint32_t count = compose->colours > 0 ? compose->colours : 1;
    double within = phase(compose, at);
    for (uint32_t i = 0; i < count; i++) {
        pm_eye_path coloured = *path;
        pm_vertex there = *at;
        there.vertex = ++eye->vertices;
        pm_eye_path_colour(compose->world->scene, (i + within) / count, 1.0 / count, &coloured,
                           &there);
        bool goes_on;
        PM_TRY(leave(compose, &coloured, &there, index, eye, &goes_on));
        if (goes_on) {
            PM_TRY(follow(compose, coloured, there, index, eye));
        }
    }
    return PM_OK;
}

static pm_status follow(const pm_compose *compose, pm_eye_path path, pm_vertex at,
                        uint64_t index, pm_eye *eye)
{
    // A rough lobe may have sent the path into the surface: with weight 0, to its end.
    for (bool goes_on = true; goes_on && !pm_spectrum_is_black(path.weight);) {
        bool found;
        PM_TRY(next_vertex(compose, &path, &at, eye, &found));
        if (!found) {
            return PM_OK;
        }
        at.vertex = ++eye->vertices;
        note_first(&at, &path, eye);
        if (at.lobes.disperses) {
            return follow_every_colour(compose, &path, &at, index, eye);
        }
        PM_TRY(leave(compose, &path, &at, index, eye, &goes_on));
    }
    return PM_OK;
}

pm_status pm_compose_eye(const pm_compose *compose, const pm_ray *ray, uint64_t pixel,
                         uint32_t sample, uint64_t index, pm_eye *eye)
{
    pm_vertex at = {.pixel = pixel, .sample = sample};
    return follow(compose, pm_eye_path_along(ray), at, index, eye);
}

/// What a medium scatters into a gather ray on its way to the vertex, or away.
static pm_status ask_haze(const pm_compose *compose, pm_eye_path *path, bool met,
                          const pm_vertex *at, pm_rng *rng, pm_spectrum *radiance)
{
    pm_spectrum weight = path->weight;
    pm_stretch through;
    if (!pm_eye_path_attenuate(compose->world->scene, path, met, at, &through) ||
        compose->ask.haze == NULL) {
        return PM_OK;
    }
    pm_spectrum scattered = pm_gray(0.0);
    PM_TRY(compose->ask.haze(compose->ask.context, &through, rng, &scattered));
    *radiance = pm_spectrum_add(*radiance, pm_spectrum_mul(weight, scattered));
    return PM_OK;
}

static pm_status ask_global(const pm_compose *compose, const pm_eye_path *path,
                            const pm_vertex *end, pm_rng *rng, pm_spectrum *radiance)
{
    if (!end->lobes.diffuse || compose->ask.global == NULL) {
        return PM_OK;
    }
    pm_spectrum leaving = pm_gray(0.0);
    PM_TRY(compose->ask.global(compose->ask.context, end, rng, &leaving));
    *radiance = pm_spectrum_add(*radiance, pm_spectrum_mul(path->weight, leaving));
    return PM_OK;
}

pm_status pm_compose_gather(const pm_compose *compose, const pm_ray *ray, const pm_vertex *at,
                            pm_rng *rng, pm_spectrum *radiance, uint64_t *cut)
{
    *radiance = pm_gray(0.0);
    pm_eye_path path = pm_eye_path_along(ray);
    pm_vertex end = *at;
    for (bool goes_on = true; goes_on && !pm_spectrum_is_black(path.weight);) {
        bool met = pm_eye_path_meet(compose->world, &path, &end);
        PM_TRY(ask_haze(compose, &path, met, &end, rng, radiance));
        if (!met) {
            return PM_OK;
        }
        if (end.lobes.passes) {
            pm_eye_path_pass(&path, &end);
            continue;
        }
        PM_TRY(ask_global(compose, &path, &end, rng, radiance));
        if (end.lobes.disperses) {
            pm_eye_path_colour(compose->world->scene, pm_rng_draw(rng), 1.0, &path, &end);
        }
        goes_on = pm_eye_path_may_turn(&path, &end, compose->max_specular, cut);
        if (goes_on) {
            PM_TRY(pm_eye_path_choose(&path, &end, compose->rule, rng, &goes_on));
        }
    }
    return PM_OK;
}

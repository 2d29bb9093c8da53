// The eye path goes on at S events only; every diffuse surface on it is asked for its light and
// ends it as far as D is concerned.
#include "compose.h"

#include "medium.h"
#include "wavelength.h"

#include <stddef.h>

/// An eye path on its way.
typedef struct {
    pm_ray ray;
    pm_spectrum weight; // factor on radiance found at its end
    uint32_t specular;  // S events so far
    pm_vec3 from;       // the last of them, or where the path began
    double pdf;         // with which that event drew the ray, as in pm_vertex
} pm_path;

static pm_path path_along(const pm_ray *ray)
{
    return (pm_path){.ray = *ray, .weight = pm_gray(1.0), .from = ray->origin};
}

/// The next surface on the path, null ones too.
static bool meet(const pm_compose *compose, const pm_path *path, pm_vertex *at)
{
    const pm_ray *ray = &path->ray;
    if (!pm_closest(compose->world, ray, &at->hit)) {
        return false;
    }
    pm_material_lobes(compose->world->scene, &at->hit, ray, &at->lobes);
    at->from = path->from;
    at->pdf = path->pdf;
    return true;
}

/// The ray beyond a null surface.
static pm_ray beyond(const pm_ray *ray, const pm_vertex *at)
{
    return pm_hit_ray(&at->hit, ray->direction, ray->wavelength, at->lobes.medium_beyond);
}

/// Where light found in `layer` belongs: once the path has had an S event, to specular.
static pm_layer layer_on(const pm_path *path, pm_layer layer)
{
    return path->specular > 0 ? PM_LAYER_SPECULAR : layer;
}

static void add(const pm_path *path, pm_layer into, pm_spectrum radiance, pm_eye *eye)
{
    eye->layer[into] =
        pm_spectrum_add(eye->layer[into], pm_spectrum_mul(path->weight, radiance));
}

typedef pm_status (*pm_source_fn)(void *context, const pm_vertex *at, pm_spectrum *radiance);

static pm_status ask(const pm_compose *compose, pm_source_fn source, const pm_vertex *at,
                     const pm_path *path, pm_layer layer, pm_eye *eye)
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
static pm_status ask_sky(const pm_compose *compose, const pm_path *path, pm_eye *eye)
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

/// The stretch of medium that the path's ray runs through before it `met` something, and what
/// the medium leaves of all that lies behind. False where the ray runs in none.
static bool pass_medium(const pm_compose *compose, pm_path *path, bool met, const pm_vertex *at,
                        pm_stretch *through)
{
    if (path->ray.medium == PM_NONE) {
        return false;
    }
    *through = (pm_stretch){.ray = path->ray, .pixel = at->pixel, .sample = at->sample};
    through->ray.t_max = met ? at->hit.t : HUGE_VAL;
    const pm_medium *medium = &compose->world->scene->media[path->ray.medium];
    double left = pm_medium_transmittance(medium, through->ray.t_max);
    path->weight = pm_spectrum_scale(path->weight, left);
    return true;
}

/// What a medium scatters into the eye path on its way to the vertex, or away.
static pm_status ask_volume(const pm_compose *compose, pm_path *path, bool met,
                            const pm_vertex *at, pm_eye *eye)
{
    pm_path before = *path;
    pm_stretch through;
    pm_layer into = layer_on(path, PM_LAYER_VOLUME);
    if (!pass_medium(compose, path, met, at, &through)) {
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
                             const pm_path *path, pm_eye *eye)
{
    const pm_compose_sources *sources = &compose->ask;
    if (at->lobes.diffuse) {
        PM_TRY(ask(compose, sources->direct, at, path, PM_LAYER_DIRECT, eye));
        PM_TRY(ask(compose, sources->caustic, at, path, PM_LAYER_CAUSTIC, eye));
        PM_TRY(ask(compose, sources->indirect, at, path, PM_LAYER_INDIRECT, eye));
    }
    return PM_OK;
}

static void note_first(const pm_vertex *at, const pm_path *path, pm_eye *eye)
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
static pm_status next_vertex(const pm_compose *compose, pm_path *path, pm_vertex *at,
                             pm_eye *eye, bool *found)
{
    while (true) {
        *found = meet(compose, path, at);
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
        path->ray = beyond(&path->ray, at);
    }
}

/// The S lobes of a vertex, in the order of its lobes; writes their places there.
static int specular_lobes(const pm_lobes *lobes, pm_lobe *only, int *place)
{
    int count = 0;
    for (int i = 0; i < lobes->count; i++) {
        if (lobes->lobe[i].specular) {
            only[count] = lobes->lobe[i];
            place[count++] = i;
        }
    }
    return count;
}

/// Whether the path may have one more S event here; counts the ends that only the cap makes.
static bool may_turn(const pm_compose *compose, const pm_path *path, const pm_vertex *at,
                     uint64_t *cut)
{
    pm_lobe lobes[PM_LOBES_MAX];
    int place[PM_LOBES_MAX];
    bool turns = specular_lobes(&at->lobes, lobes, place) > 0;
    bool capped = path->specular >= compose->max_specular;
    *cut += turns && capped;
    return turns && !capped;
}

/// The path after S lobe `which`; `weight` holds that lobe's albedo already.
static pm_path turned(const pm_path *path, const pm_vertex *at, int which, pm_spectrum weight,
                      pm_rng *rng)
{
    pm_scatter scatter;
    pm_material_sample(&at->lobes, which, rng, &scatter);
    weight = pm_spectrum_scale(pm_spectrum_mul(weight, scatter.weight), scatter.radiance);
    return (pm_path){
        .ray = pm_hit_ray(&at->hit, scatter.wo, path->ray.wavelength, scatter.medium),
        .weight = weight,
        .specular = path->specular + 1,
        .from = at->hit.position,
        .pdf = scatter.pdf,
    };
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
static pm_status ask_glint(const pm_compose *compose, const pm_vertex *at, const pm_path *path,
                           pm_eye *eye)
{
    pm_source_fn source = glints(&at->lobes) ? compose->ask.glint : NULL;
    return ask(compose, source, at, path, PM_LAYER_SPECULAR, eye);
}

static pm_status follow(const pm_compose *compose, pm_path path, pm_vertex at, uint64_t index,
                        pm_eye *eye);

static pm_status follow_every_lobe(const pm_compose *compose, const pm_path *path,
                                   const pm_vertex *at, uint64_t index, pm_rng *rng,
                                   pm_eye *eye)
{
    pm_lobe lobes[PM_LOBES_MAX];
    int place[PM_LOBES_MAX];
    int count = specular_lobes(&at->lobes, lobes, place);
    for (int i = 0; i < count; i++) {
        pm_spectrum weight = pm_spectrum_mul(path->weight, lobes[i].albedo);
        pm_path branch = turned(path, at, place[i], weight, rng);
        PM_TRY(follow(compose, branch, *at, index, eye));
    }
    return PM_OK;
}

/// One lobe by roulette; false when the path ends.
static pm_status choose_lobe(const pm_compose *compose, pm_path *path, const pm_vertex *at,
                             pm_rng *rng, bool *goes_on)
{
    pm_lobe lobes[PM_LOBES_MAX];
    int place[PM_LOBES_MAX];
    int count = specular_lobes(&at->lobes, lobes, place);
    pm_roulette outcome;
    PM_TRY(pm_trace_roulette(path->weight, lobes, count, compose->rule, rng, &outcome));
    *goes_on = outcome.lobe != PM_NONE;
    if (*goes_on) {
        *path = turned(path, at, place[outcome.lobe], outcome.power, rng);
    }
    return PM_OK;
}

/// All that happens at a vertex: the light asked for there, and the turns taken.
static pm_status leave(const pm_compose *compose, pm_path *path, const pm_vertex *at,
                       uint64_t index, pm_eye *eye, bool *goes_on)
{
    *goes_on = false;
    PM_TRY(ask_diffuse(compose, at, path, eye));
    if (!may_turn(compose, path, at, &eye->cut)) {
        return PM_OK;
    }
    PM_TRY(ask_glint(compose, at, path, eye));
    pm_rng rng = pm_rng_at(&compose->source, index, at->vertex);
    if (path->specular < compose->splits) {
        return follow_every_lobe(compose, path, at, index, &rng, eye);
    }
    return choose_lobe(compose, path, at, &rng, goes_on);
}

/// The path with a wavelength, at a vertex that disperses; `share` of the whole.
static void take_wavelength(const pm_compose *compose, double u, double share, pm_path *path,
                            pm_vertex *at)
{
    path->ray.wavelength = pm_wavelength_at(u);
    pm_spectrum weight = pm_wavelength_weight(path->ray.wavelength);
    path->weight = pm_spectrum_scale(pm_spectrum_mul(path->weight, weight), share);
    pm_material_lobes(compose->world->scene, &at->hit, &path->ray, &at->lobes);
}

/// The path splits into even shares of the range of wavelengths, each a vertex of its own.
static pm_status follow_every_colour(const pm_compose *compose, const pm_path *path,
                                     const pm_vertex *at, uint64_t index, pm_eye *eye)
{
    uint32_t count = compose->colours > 0 ? compose->colours : 1;
    pm_rng rng = pm_rng_at(&compose->source, index, at->vertex);
    double shift = pm_rng_draw(&rng);
    for (uint32_t i = 0; i < count; i++) {
        pm_path coloured = *path;
        pm_vertex there = *at;
        there.vertex = ++eye->vertices;
        bool goes_on;
        take_wavelength(compose, (i + shift) / count, 1.0 / count, &coloured, &there);
        PM_TRY(leave(compose, &coloured, &there, index, eye, &goes_on));
        if (goes_on) {
            PM_TRY(follow(compose, coloured, there, index, eye));
        }
    }
    return PM_OK;
}

static pm_status follow(const pm_compose *compose, pm_path path, pm_vertex at, uint64_t index,
                        pm_eye *eye)
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
    return follow(compose, path_along(ray), at, index, eye);
}

/// What a medium scatters into a gather ray on its way to the vertex, or away.
static pm_status ask_haze(const pm_compose *compose, pm_path *path, bool met,
                          const pm_vertex *at, pm_rng *rng, pm_spectrum *radiance)
{
    pm_spectrum weight = path->weight;
    pm_stretch through;
    if (!pass_medium(compose, path, met, at, &through) || compose->ask.haze == NULL) {
        return PM_OK;
    }
    pm_spectrum scattered = pm_gray(0.0);
    PM_TRY(compose->ask.haze(compose->ask.context, &through, rng, &scattered));
    *radiance = pm_spectrum_add(*radiance, pm_spectrum_mul(weight, scattered));
    return PM_OK;
}

static pm_status ask_global(const pm_compose *compose, const pm_path *path,
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
    pm_path path = path_along(ray);
    pm_vertex end = *at;
    for (bool goes_on = true; goes_on && !pm_spectrum_is_black(path.weight);) {
        bool met = meet(compose, &path, &end);
        PM_TRY(ask_haze(compose, &path, met, &end, rng, radiance));
        if (!met) {
            return PM_OK;
        }
        if (end.lobes.passes) {
            path.ray = beyond(&path.ray, &end);
            continue;
        }
        PM_TRY(ask_global(compose, &path, &end, rng, radiance));
        if (end.lobes.disperses) {
            take_wavelength(compose, pm_rng_draw(rng), 1.0, &path, &end);
        }
        goes_on = may_turn(compose, &path, &end, cut);
        if (goes_on) {
            PM_TRY(choose_lobe(compose, &path, &end, rng, &goes_on));
        }
    }
    return PM_OK;
}

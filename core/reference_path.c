// fly, see what shines, draw points on lights, turn; until the roulette ends it. In a medium
// the flight ends where the optical depth drawn for it is used up.
#include "reference_path.h"

#include "direct.h"
#include "light.h"
#include "medium.h"
#include "reference_flight.h"

/// The path so far.
typedef struct {
    pm_ray ray;
    pm_spectrum weight; // factor on radiance found at its end
    pm_layer_events events;
    pm_vec3 from; // the last event, where lights were drawn
    double pdf;   // [1/sr] of the ray, where drawing lights could have found it; else 0
    double hue;   // share of the range for its first wavelength; below 0 once that was taken
} pm_eye_path;

static void add(pm_reference_sum *sum, pm_layer_events events, pm_spectrum weight,
                pm_spectrum radiance)
{
    pm_spectrum *layer = &sum->layer[pm_layer_of(events)];
    *layer = pm_spectrum_add(*layer, pm_spectrum_mul(weight, radiance));
}

/// A path from the eye came to a light through S events alone.
static void note_emitter(const pm_eye_path *path, pm_reference_sum *sum)
{
    sum->emitter = sum->emitter || path->events.specular == path->events.count;
}

/// Light of what lies around the scene.
static void see_sky(const pm_reference_eye *eye, const pm_eye_path *path, pm_reference_sum *sum)
{
    if (!pm_spectrum_is_black(eye->sky)) {
        note_emitter(path, sum);
        add(sum, path->events, path->weight, eye->sky);
    }
}

static bool shines(const pm_scene *scene, const pm_reference_meeting *at)
{
    bool front = pm_vec_dot(at->lobes.wi, at->hit.normal) > 0.0;
    return scene->shapes[at->hit.shape].light != PM_NONE && front;
}

/// Light of the surface itself.
static void see(const pm_scene *scene, const pm_eye_path *path, const pm_reference_meeting *at,
                pm_reference_sum *sum)
{
    if (!shines(scene, at)) {
        return;
    }
    note_emitter(path, sum);
    pm_spectrum radiance = pm_light_emitted(scene, &at->hit, at->lobes.wi);
    if (path->pdf > 0.0) {
        double drawn = pm_light_pdf(scene, &at->hit, path->from, path->ray.direction);
        radiance = pm_spectrum_scale(radiance, pm_direct_weight(path->pdf, drawn));
    }
    add(sum, path->events, path->weight, radiance);
}

static void note_first(const pm_eye_path *path, const pm_reference_meeting *at,
                       pm_reference_sum *sum)
{
    if (path->events.count == 0) {
        sum->hits++;
        sum->depth += pm_vec_length(pm_vec_sub(at->hit.position, path->from));
        sum->normal = pm_vec_add(sum->normal, at->lobes.normal);
    }
}

// --- flying ---------------------------------------------------------------------------------

/// What lies ahead of a path that ends in a medium: depth, normal and mask know no fog.
static void glance(const pm_reference_eye *eye, pm_eye_path past, pm_reference_sum *sum)
{
    const pm_scene *scene = eye->world->scene;
    pm_reference_meeting at;
    while (pm_closest(eye->world, &past.ray, &at.hit)) {
        pm_material_lobes(scene, &at.hit, &past.ray, &at.lobes);
        if (shines(scene, &at)) {
            note_emitter(&past, sum);
        }
        if (!at.lobes.passes) {
            note_first(&past, &at, sum);
            return;
        }
        past.ray = pm_reference_beyond(&past.ray, &at);
    }
    if (!pm_spectrum_is_black(eye->sky)) {
        note_emitter(&past, sum);
    }
}

/// To the next event. A null lamp shines and lets the path pass, and what lies behind is seen
/// from the last event still.
static void fly(const pm_reference_eye *eye, pm_eye_path *path, pm_rng *rng,
                pm_reference_meeting *at, pm_reference_sum *sum)
{
    double left = PM_REFERENCE_UNDRAWN;
    for (;;) {
        pm_reference_fly(eye->world, &path->ray, rng, &left, at);
        if (at->place != PM_REFERENCE_SURFACE) {
            return;
        }
        see(eye->world->scene, path, at, sum);
        if (!at->lobes.passes) {
            return;
        }
        path->ray = pm_reference_beyond(&path->ray, at);
    }
}

// --- at a surface ---------------------------------------------------------------------------

/// f |cos| towards a drawn point, apart for D lobes and S lobes, each lobe by its own weight:
/// the same path could have gone there by that lobe.
static void respond(const pm_lobes *lobes, const pm_light_sample *drawn,
                    pm_spectrum response[2])
{
    double cosine = fabs(pm_vec_dot(drawn->direction, lobes->normal));
    response[0] = response[1] = pm_gray(0.0);
    for (int i = 0; i < lobes->count; i++) {
        pm_spectrum value = pm_material_value(lobes, i, drawn->direction);
        double share = cosine;
        if (drawn->pdf > 0.0) {
            double found = pm_material_pdf(lobes, i, drawn->direction);
            share *= pm_direct_weight(drawn->pdf, found);
        }
        pm_spectrum *into = &response[lobes->lobe[i].specular];
        *into = pm_spectrum_add(*into, pm_spectrum_scale(value, share));
    }
}

static void ask_light(const pm_reference_eye *eye, const pm_light *light,
                      const pm_eye_path *path, const pm_reference_meeting *at,
                      const double u[2], pm_reference_sum *sum)
{
    pm_light_sample drawn;
    if (!pm_light_sample_from(eye->world->scene, light, at->hit.position, u, &drawn)) {
        return;
    }
    pm_spectrum response[2];
    respond(&at->lobes, &drawn, response);
    if (pm_spectrum_is_black(response[0]) && pm_spectrum_is_black(response[1])) {
        return;
    }
    pm_vec3 from = pm_hit_leave(&at->hit, drawn.direction);
    double clear = pm_light_clear(eye->world, from, at->lobes.medium_here, &drawn);
    for (int specular = 0; specular < 2 && clear > 0.0; specular++) {
        pm_spectrum radiance = pm_spectrum_mul(response[specular], drawn.radiance);
        add(sum, pm_layer_event(path->events, specular ? 'S' : 'D'), path->weight,
            pm_spectrum_scale(radiance, clear));
    }
}

/// Whether some lobe has a value towards directions that it did not choose itself.
static bool spreads(const pm_lobes *lobes)
{
    for (int i = 0; i < lobes->count; i++) {
        pm_lobe_type type = lobes->lobe[i].type;
        if (type == PM_LOBE_DIFFUSE || type == PM_LOBE_COATED || type == PM_LOBE_GLOSSY) {
            return true;
        }
    }
    return false;
}

static void ask_lights(const pm_reference_eye *eye, const pm_eye_path *path,
                       const pm_reference_meeting *at, pm_rng *rng, pm_reference_sum *sum)
{
    const pm_scene *scene = eye->world->scene;
    for (int i = 0; i < scene->light_count && spreads(&at->lobes); i++) {
        double u[2];
        u[0] = pm_rng_draw(rng);
        u[1] = pm_rng_draw(rng);
        ask_light(eye, &scene->lights[i], path, at, u, sum);
    }
}

/// Goes on by one lobe. Writes whether it does.
static pm_status turn(const pm_reference_eye *eye, pm_eye_path *path,
                      const pm_reference_meeting *at, pm_rng *rng, bool *goes_on)
{
    pm_roulette outcome;
    PM_TRY(pm_trace_roulette(path->weight, at->lobes.lobe, at->lobes.count, eye->rule, rng,
                             &outcome));
    *goes_on = outcome.lobe != PM_NONE;
    if (!*goes_on) {
        return PM_OK;
    }
    pm_scatter scatter;
    pm_material_sample(&at->lobes, outcome.lobe, rng, &scatter);
    path->weight =
        pm_spectrum_scale(pm_spectrum_mul(outcome.power, scatter.weight), scatter.radiance);
    bool specular = at->lobes.lobe[outcome.lobe].specular;
    // Past a D event the path is all three channels again.
    double wavelength = specular ? path->ray.wavelength : 0.0;
    path->events = pm_layer_event(path->events, specular ? 'S' : 'D');
    path->ray = pm_hit_ray(&at->hit, scatter.wo, wavelength, scatter.medium);
    path->from = at->hit.position;
    path->pdf = scatter.pdf;
    *goes_on = !pm_spectrum_is_black(path->weight);
    return PM_OK;
}

static pm_status scatter_at_surface(const pm_reference_eye *eye, pm_eye_path *path,
                                    pm_reference_meeting *at, pm_rng *rng,
                                    pm_reference_sum *sum, bool *goes_on)
{
    if (at->lobes.disperses) {
        double share = path->hue < 0.0 ? pm_rng_draw(rng) : path->hue;
        path->hue = -1.0;
        pm_reference_colour(eye->world->scene, share, &path->ray, &path->weight, at);
    }
    ask_lights(eye, path, at, rng, sum);
    return turn(eye, path, at, rng, goes_on);
}

// --- in a medium ----------------------------------------------------------------------------

static void ask_light_from_medium(const pm_reference_eye *eye, const pm_light *light,
                                  const pm_eye_path *path, pm_vec3 position, const double u[2],
                                  pm_reference_sum *sum)
{
    const pm_scene *scene = eye->world->scene;
    const pm_medium *medium = &scene->media[path->ray.medium];
    pm_light_sample drawn;
    if (!pm_light_sample_from(scene, light, position, u, &drawn)) {
        return;
    }
    double phase = pm_medium_phase(medium, pm_vec_dot(path->ray.direction, drawn.direction));
    double share = drawn.pdf > 0.0 ? pm_direct_weight(drawn.pdf, phase) : 1.0;
    double clear = pm_light_clear(eye->world, position, path->ray.medium, &drawn);
    add(sum, pm_layer_event(path->events, 'V'), pm_spectrum_mul(path->weight, medium->albedo),
        pm_spectrum_scale(drawn.radiance, phase * share * clear));
}

static pm_status scatter_in_medium(const pm_reference_eye *eye, pm_eye_path *path,
                                   pm_vec3 position, pm_rng *rng, pm_reference_sum *sum,
                                   bool *goes_on)
{
    const pm_scene *scene = eye->world->scene;
    const pm_medium *medium = &scene->media[path->ray.medium];
    for (int i = 0; i < scene->light_count && !pm_spectrum_is_black(medium->albedo); i++) {
        double u[2];
        u[0] = pm_rng_draw(rng);
        u[1] = pm_rng_draw(rng);
        ask_light_from_medium(eye, &scene->lights[i], path, position, u, sum);
    }
    pm_lobe lobe = {.albedo = medium->albedo};
    pm_roulette outcome;
    PM_TRY(pm_trace_roulette(path->weight, &lobe, 1, eye->rule, rng, &outcome));
    *goes_on = outcome.lobe != PM_NONE;
    if (*goes_on) {
        pm_vec3 onward = pm_medium_turn(medium, path->ray.direction, rng);
        path->pdf = pm_medium_phase(medium, pm_vec_dot(path->ray.direction, onward));
        path->weight = outcome.power;
        path->events = pm_layer_event(path->events, 'V');
        path->ray = (pm_ray){position, onward, HUGE_VAL, 0.0, path->ray.medium};
        path->from = position;
    }
    return PM_OK;
}

// --- the whole path -------------------------------------------------------------------------

static bool capped(const pm_reference_eye *eye, const pm_eye_path *path)
{
    return path->events.count >= eye->caps.bounces ||
           path->events.specular >= eye->caps.specular;
}

/// Notes what the eye has before it where the path has come to. Whether there is an event.
static bool arrive(const pm_reference_eye *eye, const pm_eye_path *path,
                   const pm_reference_meeting *at, pm_reference_sum *sum)
{
    if (at->place == PM_REFERENCE_OUTSIDE) {
        see_sky(eye, path, sum);
        return false;
    }
    if (at->place == PM_REFERENCE_SURFACE) {
        note_first(path, at, sum);
        return at->lobes.count > 0;
    }
    if (path->events.specular == path->events.count) {
        glance(eye, *path, sum);
    }
    return true;
}

pm_status pm_reference_path(const pm_reference_eye *eye, const pm_ray *ray, uint64_t index,
                            double hue, pm_reference_sum *sum)
{
    pm_eye_path path = {.ray = *ray, .weight = pm_gray(1.0), .from = ray->origin, .hue = hue};
    for (bool goes_on = true; goes_on;) {
        pm_rng rng = pm_rng_at(&eye->source, index, path.events.count + 1);
        pm_reference_meeting at;
        fly(eye, &path, &rng, &at, sum);
        if (!arrive(eye, &path, &at, sum)) {
            return PM_OK;
        }
        if (capped(eye, &path)) {
            sum->cut++;
            return PM_OK;
        }
        PM_TRY(at.place == PM_REFERENCE_MEDIUM
                   ? scatter_in_medium(eye, &path, at.position, &rng, sum, &goes_on)
                   : scatter_at_surface(eye, &path, &at, &rng, sum, &goes_on));
    }
    return PM_OK;
}

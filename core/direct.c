// L = sum over lights of f * (what arrives without the surface) * cos / pdf, where nothing is
// between.
//
// Points on lights are drawn for every lobe. A glossy lobe draws directions as well, as many as
// there are points on a lamp, and shares each lamp with those by the balance heuristic. Wide
// lobes leave lamps to the points, but for those so near that a few points of them outshine the
// rest: these they share with one even spread of directions. The constant light is found by
// drawn directions alone.
#include "direct.h"

#include "lattice.h"
#include "light.h"
#include "medium.h"
#include "shape.h"

#include <stddef.h>

/// Who is lit, and whether its D or its S lobes are asked about.
typedef struct {
    const pm_hit *hit;
    const pm_lobes *lobes;
    bool specular;
} receiver;

/// Within how many times its extent, from its middle, a lamp is near. At this distance its
/// brightest point is about 9 times as bright as its farthest.
#define NEAR 2.0

static bool is_glossy(const pm_lobe *lobe)
{
    return lobe->type == PM_LOBE_GLOSSY;
}

static bool is_near(const pm_light *light, pm_vec3 point)
{
    double distance = pm_vec_length(pm_vec_sub(light->position, point));
    return light->type == PM_LIGHT_AREA && distance < NEAR * light->extent;
}

// --- points drawn on lights -----------------------------------------------------------------

/// f * cos towards a sample of a light, of each lobe the share that this sample has; 0 where
/// the surface does not look. Wide lobes share it only when it is `near`.
static pm_spectrum response(const receiver *to, const pm_light_sample *sample, bool near)
{
    pm_spectrum sum = pm_gray(0.0);
    for (int i = 0; i < to->lobes->count; i++) {
        const pm_lobe *lobe = &to->lobes->lobe[i];
        if (lobe->specular != to->specular) {
            continue;
        }
        pm_spectrum value = pm_material_value(to->lobes, i, sample->direction);
        if ((is_glossy(lobe) || near) && sample->pdf > 0.0) {
            double other = pm_material_pdf(to->lobes, i, sample->direction);
            value = pm_spectrum_scale(value, pm_direct_weight(sample->pdf, other));
        }
        sum = pm_spectrum_add(sum, value);
    }
    double cosine = pm_vec_dot(sample->direction, to->lobes->normal);
    return pm_spectrum_scale(sum, pm_most(0.0, cosine));
}

/// Share of the light that gets to the receiver.
static double clear(pm_direct_query *query, const receiver *to, const pm_light_sample *sample)
{
    query->rays++;
    pm_vec3 from = pm_hit_leave(to->hit, sample->direction);
    return pm_light_clear(query->world, from, to->lobes->medium_here, sample);
}

/// What the shadow photons say of one light, once they were asked.
typedef struct {
    bool asked;
    pm_shadow_answer answer;
} advice;

/// Surfaces whose lobes are all S hold no shadow photons, so their S lobes do not ask.
static pm_shadow_answer ask_photons(pm_direct_query *query, int light, const receiver *to,
                                    advice *known)
{
    if (query->shadows == NULL || to->specular) {
        return PM_SHADOW_UNSURE;
    }
    if (!known->asked) {
        pm_estimate_point point = {to->hit->position, to->lobes->normal};
        known->answer = pm_shadow_ask(query->shadows, light, &point, query->scratch);
        known->asked = true;
    }
    return known->answer;
}

/// What one draw of one light brings.
static pm_spectrum from_light(pm_direct_query *query, int light, const double u[2],
                              const receiver *to, advice *known)
{
    const pm_scene *scene = query->world->scene;
    pm_vec3 here = to->hit->position;
    pm_light_sample sample;
    if (!pm_light_sample_from(scene, &scene->lights[light], here, u, &sample)) {
        return pm_gray(0.0);
    }
    pm_spectrum f = response(to, &sample, is_near(&scene->lights[light], here));
    pm_spectrum arriving = pm_spectrum_mul(f, sample.radiance);
    if (pm_spectrum_is_black(arriving)) {
        return arriving;
    }
    pm_shadow_answer answer = ask_photons(query, light, to, known);
    // Photons know what stands in the way, not what media take.
    bool spared =
        answer == PM_SHADOW_DARK || (answer == PM_SHADOW_LIT && scene->medium_count == 0);
    query->spared += spared;
    if (spared) {
        return answer == PM_SHADOW_LIT ? arriving : pm_gray(0.0);
    }
    return pm_spectrum_scale(arriving, clear(query, to, &sample));
}

/// Point number `s` of the query's lattice.
static void lattice_point(const pm_direct_query *query, uint32_t s, uint32_t samples,
                          double u[2])
{
    pm_lattice_point(query->shift, query->first + s * query->step, samples * query->step, u);
}

static pm_spectrum from_lights(pm_direct_query *query, const receiver *to)
{
    const pm_scene *scene = query->world->scene;
    pm_spectrum sum = pm_gray(0.0);
    for (int i = 0; i < scene->light_count; i++) {
        uint32_t samples = scene->lights[i].type == PM_LIGHT_AREA ? query->samples : 1;
        advice known = {0};
        for (uint32_t s = 0; s < samples; s++) {
            double u[2];
            lattice_point(query, s, samples, u);
            pm_spectrum one = from_light(query, i, u, to, &known);
            sum = pm_spectrum_add(sum, pm_spectrum_scale(one, 1.0 / samples));
        }
    }
    return sum;
}

// --- directions drawn by lobes --------------------------------------------------------------

/// A direction, drawn by one glossy lobe or, by the cosine, for all wide ones.
typedef struct {
    pm_vec3 direction;
    double pdf; // [1/sr]
    bool wide;
} drawn;

/// The share that a drawn direction has of the lamp that it met, if any.
static pm_spectrum meet_lamp(const pm_scene *scene, const receiver *to, const pm_hit *met,
                             const drawn *way)
{
    pm_vec3 here = to->hit->position;
    double other = pm_light_pdf(scene, met, here, way->direction);
    if (other == 0.0) {
        return pm_gray(0.0);
    }
    if (way->wide && !is_near(&scene->lights[scene->shapes[met->shape].light], here)) {
        return pm_gray(0.0);
    }
    pm_spectrum lamp = pm_light_emitted(scene, met, pm_vec_negate(way->direction));
    return pm_spectrum_scale(lamp, pm_direct_weight(way->pdf, other));
}

/// What comes along a drawn direction: of each lamp on the way its share, and the sky in full;
/// media take theirs. Lamps of null surface shine and let pass.
static pm_spectrum look_along(pm_direct_query *query, const receiver *to, const drawn *way)
{
    const pm_scene *scene = query->world->scene;
    pm_ray ray = pm_hit_ray(to->hit, way->direction, 0.0, to->lobes->medium_here);
    pm_spectrum sum = pm_gray(0.0);
    double left = 1.0; // share of what comes from here on that media let through
    pm_hit met;
    query->rays++;
    while (pm_closest(query->world, &ray, &met)) {
        left *= pm_medium_share(scene, ray.medium, met.t);
        pm_spectrum lamp = meet_lamp(scene, to, &met, way);
        sum = pm_spectrum_add(sum, pm_spectrum_scale(lamp, left));
        if (!pm_shape_is_null(scene, &scene->shapes[met.shape])) {
            return sum;
        }
        ray = pm_medium_beyond(scene, &ray, &met);
    }
    left *= pm_medium_share(scene, ray.medium, HUGE_VAL);
    return pm_spectrum_add(sum, pm_spectrum_scale(pm_light_sky(scene), left));
}

/// Lamps' share and sky by the directions of glossy lobe `which`.
static pm_spectrum from_lobe(pm_direct_query *query, const receiver *to, int which)
{
    pm_spectrum albedo = to->lobes->lobe[which].albedo;
    pm_spectrum sum = pm_gray(0.0);
    for (uint32_t s = 0; s < query->samples; s++) {
        pm_scatter scatter;
        pm_material_sample(to->lobes, which, &query->rng, &scatter);
        pm_spectrum weight = pm_spectrum_mul(albedo, scatter.weight);
        if (!pm_spectrum_is_black(weight)) {
            drawn way = {scatter.wo, scatter.pdf, false};
            pm_spectrum seen = look_along(query, to, &way);
            sum = pm_spectrum_add(sum, pm_spectrum_mul(weight, seen));
        }
    }
    return pm_spectrum_scale(sum, 1.0 / query->samples);
}

/// f pi of all wide D lobes towards `direction`: their share of the sky, drawn by the cosine.
static pm_spectrum wide_response(const pm_lobes *lobes, pm_vec3 direction)
{
    pm_spectrum sum = pm_gray(0.0);
    for (int i = 0; i < lobes->count; i++) {
        if (!lobes->lobe[i].specular && !is_glossy(&lobes->lobe[i])) {
            sum = pm_spectrum_add(sum, pm_material_value(lobes, i, direction));
        }
    }
    return pm_spectrum_scale(sum, PM_PI);
}

/// Sky and near lamps along one direction.
static pm_spectrum look_wide(pm_direct_query *query, const receiver *to, pm_vec3 direction,
                             bool near)
{
    if (near) {
        drawn way = {direction, pm_vec_dot(direction, to->lobes->normal) / PM_PI, true};
        return look_along(query, to, &way);
    }
    pm_light_sample sky = {.direction = direction, .endless = true};
    return pm_spectrum_scale(pm_light_sky(query->world->scene), clear(query, to, &sky));
}

/// Sky and, where one is `near`, lamps on all wide D lobes together, by an even spread of
/// directions.
static pm_spectrum from_wide(pm_direct_query *query, const receiver *to, bool near)
{
    pm_frame frame = pm_frame_around(to->lobes->normal);
    pm_spectrum sum = pm_gray(0.0);
    for (uint32_t s = 0; s < query->samples; s++) {
        double u[2];
        lattice_point(query, s, query->samples, u);
        pm_vec3 direction = pm_frame_cosine(&frame, u);
        pm_spectrum f = wide_response(to->lobes, direction);
        if (!pm_spectrum_is_black(f)) {
            pm_spectrum seen = look_wide(query, to, direction, near);
            sum = pm_spectrum_add(sum, pm_spectrum_mul(f, seen));
        }
    }
    return pm_spectrum_scale(sum, 1.0 / query->samples);
}

static bool has_near_lamp(const pm_scene *scene, pm_vec3 here)
{
    for (int i = 0; i < scene->light_count; i++) {
        if (is_near(&scene->lights[i], here)) {
            return true;
        }
    }
    return false;
}

static bool has_lamp(const pm_scene *scene)
{
    for (int i = 0; i < scene->light_count; i++) {
        if (scene->lights[i].type == PM_LIGHT_AREA) {
            return true;
        }
    }
    return false;
}

/// What only drawn directions find.
static pm_spectrum from_lobes(pm_direct_query *query, const receiver *to)
{
    pm_spectrum sum = pm_gray(0.0);
    const pm_scene *scene = query->world->scene;
    bool dark = pm_spectrum_is_black(pm_light_sky(scene));
    bool near = has_near_lamp(scene, to->hit->position);
    if (!dark || near) {
        sum = from_wide(query, to, near);
    }
    if (pm_material_is_lambertian(to->lobes) || (dark && !has_lamp(scene))) {
        return sum;
    }
    for (int i = 0; i < to->lobes->count; i++) {
        if (!to->lobes->lobe[i].specular && is_glossy(&to->lobes->lobe[i])) {
            sum = pm_spectrum_add(sum, from_lobe(query, to, i));
        }
    }
    return sum;
}

pm_spectrum pm_direct(pm_direct_query *query, const pm_hit *hit, const pm_lobes *lobes)
{
    receiver to = {hit, lobes, false};
    pm_spectrum drawn_on_lights = from_lights(query, &to);
    return pm_spectrum_add(drawn_on_lights, from_lobes(query, &to));
}

pm_spectrum pm_direct_glint(pm_direct_query *query, const pm_hit *hit, const pm_lobes *lobes)
{
    receiver to = {hit, lobes, true};
    for (int i = 0; i < lobes->count; i++) {
        if (lobes->lobe[i].specular && is_glossy(&lobes->lobe[i])) {
            return from_lights(query, &to);
        }
    }
    return pm_gray(0.0);
}

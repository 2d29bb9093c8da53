// L = sum over lights of the integral along the ray of sigma_s Tr p(cos) (what arrives without
// the medium) Tr' over the densities drawn, where nothing is between.
//
// Points on lights are drawn for every light that has them, then a place on the ray that suits
// this point. A lamp that the ray passes closely is so bright there that a few points of it
// outshine the rest: it shares what it brings with directions drawn by the phase function from
// places drawn on their own. The constant light is found by such directions alone.
#include "single.h"

#include "lattice.h"
#include "light.h"
#include "medium.h"
#include "shape.h"
#include "span.h"

#include <stddef.h>

/// Within how many times its extent from the ray a lamp is near.
#define NEAR 1.0

/// Who asks about which light.
typedef struct {
    pm_direct_query *query;
    const pm_ray *along;
    const pm_medium *medium;
    const pm_light *light; // NULL: all constant ones
    bool near;             // a lamp close to the ray
} asker;

/// A place on the ray at which light may be scattered.
typedef struct {
    double t; // [m] from the ray's start
    pm_vec3 position;
    double pdf;    // [1/m] of the draw
    double weight; // share of the light there that is scattered and gets back to the start, a
                   // metre, over pdf
} place;

static place place_on(const asker *by, const pm_span *span, double u)
{
    double t = pm_span_draw(span, u);
    double sigma_t = by->medium->sigma_t;
    double pdf = pm_span_pdf(span, t);
    return (place){
        .t = t,
        .position = pm_vec_along(by->along->origin, by->along->direction, t),
        .pdf = pdf,
        .weight = sigma_t * exp(-sigma_t * t) / pdf,
    };
}

/// The whole ray, about a point of the light.
static pm_span span_about(const asker *by, pm_vec3 centre, double blur)
{
    pm_span span = pm_span_all(by->along, by->medium->sigma_t);
    pm_span_about(&span, by->along, centre, blur);
    return span;
}

/// Where directions are drawn: for a lamp about its middle, blurred by its extent.
static pm_span span_of_directions(const asker *by)
{
    if (by->light == NULL) {
        return pm_span_all(by->along, by->medium->sigma_t);
    }
    return span_about(by, by->light->position, by->light->extent);
}

/// Phase function of light that comes from `direction` and goes back along the ray.
static double phase(const asker *by, pm_vec3 direction)
{
    return pm_medium_phase(by->medium, pm_vec_dot(direction, by->along->direction));
}

/// Point number `s` of the query's lattice.
static void lattice_point(const pm_direct_query *query, uint32_t s, double u[2])
{
    uint32_t point = query->first + s * query->step;
    pm_lattice_point(query->shift, point, query->samples * query->step, u);
}

// --- points drawn on lights -----------------------------------------------------------------

/// The part of the ray that the light may reach, about the point drawn on it. False when there
/// is none.
static bool span_of_point(const asker *by, const double point[2], pm_span *span)
{
    *span = pm_span_all(by->along, by->medium->sigma_t);
    pm_vec3 centre;
    if (pm_light_place(by->query->world->scene, by->light, point, &centre)) {
        pm_span_about(span, by->along, centre, 0.0);
    }
    return by->light->type != PM_LIGHT_SPOT || pm_span_clip(span, by->along, by->light);
}

/// The share of a lamp that points on it have beside directions drawn.
static double share_of_point(const asker *by, const place *at, const pm_light_sample *sample)
{
    if (!by->near) {
        return 1.0;
    }
    pm_span other = span_of_directions(by);
    return pm_direct_weight(at->pdf * sample->pdf,
                            pm_span_pdf(&other, at->t) * phase(by, sample->direction));
}

/// One draw: `u` of the place on the ray, `point` on the light.
static pm_spectrum from_point(const asker *by, double u, const double point[2])
{
    const pm_intersector *world = by->query->world;
    pm_span span;
    if (!span_of_point(by, point, &span) || span.ends == 0.0) {
        return pm_gray(0.0);
    }
    place at = place_on(by, &span, u);
    pm_light_sample sample;
    if (at.weight == 0.0 ||
        !pm_light_sample_from(world->scene, by->light, at.position, point, &sample)) {
        return pm_gray(0.0);
    }
    by->query->rays++;
    double clear = pm_light_clear(world, at.position, by->along->medium, &sample);
    double share = share_of_point(by, &at, &sample) * phase(by, sample.direction);
    return pm_spectrum_scale(sample.radiance, at.weight * share * clear);
}

static pm_spectrum from_points(const asker *by)
{
    pm_direct_query *query = by->query;
    pm_spectrum sum = pm_gray(0.0);
    for (uint32_t s = 0; s < query->samples; s++) {
        double u[2];
        lattice_point(query, s, u);
        const double point[2] = {u[1], pm_rng_draw(&query->rng)};
        sum = pm_spectrum_add(sum, from_point(by, u[0], point));
    }
    return pm_spectrum_scale(sum, 1.0 / query->samples);
}

// --- directions drawn by the phase function -------------------------------------------------

/// The share of the lamp that a drawn direction has where it met it at `met`.
static double share_of_direction(const asker *by, const place *at, pm_vec3 direction,
                                 const pm_hit *met)
{
    const pm_scene *scene = by->query->world->scene;
    double point = pm_light_pdf(scene, met, at->position, direction);
    pm_span other = span_about(by, met->position, 0.0);
    return pm_direct_weight(at->pdf * phase(by, direction), pm_span_pdf(&other, at->t) * point);
}

/// The share of the lamp, or the sky, that comes along a drawn direction.
static pm_spectrum look_along(const asker *by, const place *at, pm_vec3 direction)
{
    const pm_scene *scene = by->query->world->scene;
    pm_ray ray = {at->position, direction, HUGE_VAL, 0.0, by->along->medium};
    pm_spectrum sum = pm_gray(0.0);
    double left = 1.0; // share of what comes from here on that media let through
    pm_hit met;
    while (pm_closest(by->query->world, &ray, &met)) {
        const pm_shape *shape = &scene->shapes[met.shape];
        left *= pm_medium_share(scene, ray.medium, met.t);
        if (by->near && shape->light == by->light - scene->lights) {
            pm_spectrum lamp = pm_light_emitted(scene, &met, pm_vec_negate(direction));
            double share = share_of_direction(by, at, direction, &met);
            sum = pm_spectrum_add(sum, pm_spectrum_scale(lamp, share * left));
        }
        if (!pm_shape_is_null(scene, shape)) {
            return sum;
        }
        ray = pm_medium_beyond(scene, &ray, &met);
    }
    left *= pm_medium_share(scene, ray.medium, HUGE_VAL);
    return by->near ? sum : pm_spectrum_scale(pm_light_sky(scene), left);
}

static pm_spectrum from_directions(const asker *by)
{
    pm_direct_query *query = by->query;
    pm_span span = span_of_directions(by);
    pm_spectrum sum = pm_gray(0.0);
    for (uint32_t s = 0; s < query->samples; s++) {
        double u[2];
        lattice_point(query, s, u);
        place at = place_on(by, &span, u[0]);
        pm_vec3 direction = pm_medium_turn(by->medium, by->along->direction, &query->rng);
        if (at.weight > 0.0) {
            query->rays++;
            pm_spectrum seen = look_along(by, &at, direction);
            sum = pm_spectrum_add(sum, pm_spectrum_scale(seen, at.weight));
        }
    }
    return pm_spectrum_scale(sum, 1.0 / query->samples);
}

// --- all of it ------------------------------------------------------------------------------

/// Whether the ray passes a lamp within NEAR of its extent.
static bool is_near(const pm_light *light, const pm_ray *along)
{
    if (light->type != PM_LIGHT_AREA) {
        return false;
    }
    pm_vec3 way = pm_vec_sub(light->position, along->origin);
    double foot = pm_vec_dot(way, along->direction);
    double t = pm_most(0.0, pm_least(along->t_max, foot));
    pm_vec3 nearest = pm_vec_along(way, along->direction, -t);
    return pm_vec_length(nearest) < NEAR * light->extent;
}

static pm_spectrum from_light(asker *by, const pm_light *light)
{
    by->light = light;
    by->near = is_near(light, by->along);
    pm_spectrum sum = from_points(by);
    return by->near ? pm_spectrum_add(sum, from_directions(by)) : sum;
}

static pm_spectrum from_sky(asker *by)
{
    by->light = NULL;
    by->near = false;
    bool dark = pm_spectrum_is_black(pm_light_sky(by->query->world->scene));
    return dark ? pm_gray(0.0) : from_directions(by);
}

pm_spectrum pm_single(pm_direct_query *query, const pm_ray *along)
{
    const pm_scene *scene = query->world->scene;
    pm_spectrum sum = pm_gray(0.0);
    if (along->medium == PM_NONE) {
        return sum;
    }
    asker by = {.query = query, .along = along, .medium = &scene->media[along->medium]};
    bool scatters = !pm_spectrum_is_black(by.medium->albedo);
    if (!scatters || pm_medium_depth(by.medium, along->t_max) == 0.0) {
        return sum;
    }
    for (int i = 0; i < scene->light_count; i++) {
        const pm_light *light = &scene->lights[i];
        if (light->type != PM_LIGHT_CONSTANT) {
            sum = pm_spectrum_add(sum, from_light(&by, light));
        }
    }
    sum = pm_spectrum_add(sum, from_sky(&by));
    return pm_spectrum_mul(sum, by.medium->albedo);
}

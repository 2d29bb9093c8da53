// Light of lamps and skies scattered once into a ray, against quadrature.
#include "single.h"

#include "glows.h"
#include "integrals.h"
#include "medium.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"

// --- lamps ----------------------------------------------------------------------------------

static double over_v(double v, void *context)
{
    pm_glows_integrand *in = context;
    in->v[1] = v;
    return pm_glows_scattered(in->t, in);
}

static double over_u(double u, void *context)
{
    pm_glows_integrand *in = context;
    in->v[0] = u;
    return pm_integral(over_v, in, 0.0, 1.0);
}

static double over_lamp(double t, void *context)
{
    pm_glows_integrand *in = context;
    in->t = t;
    return pm_integral(over_u, in, 0.0, 1.0);
}

/// A square lamp of side 0.5 at z = 0 that faces down, in endless fog.
static void begin_lamp(pm_scenes *s, double g, bool extent)
{
    pm_glows_fog(s, 0.6, 0.8, g);
    int dark = pm_scenes_diffuse(s, pm_gray(0.0));
    int lamp = pm_scenes_add(s, pm_scenes_square(0.5, 0.0, true), dark, dark);
    pm_scenes_lamp(s, lamp, pm_gray(4.0));
    s->lights[0].extent = extent ? sqrt(0.125) : 0.0;
    pm_scenes_ready(s);
}

/// From x = -1 to 1 below the lamp.
static double glow_below(const pm_scenes *s, const pm_ray *along)
{
    pm_glows_integrand in = {s, *along, {0.0}, 0.0};
    double sum = 0.0;
    for (int piece = 0; piece < 4; piece++) {
        sum += pm_integral(over_lamp, &in, 0.5 * piece, 0.5 * (piece + 1));
    }
    return sum;
}

static void lamps_in_endless_fog(void)
{
    // Far off, near by, and grazing; without and with the help of drawn directions.
    static const double heights[3] = {1.0, 0.3, 0.04};
    for (int i = 0; i < 3; i++) {
        pm_scenes s;
        begin_lamp(&s, 0.3 * i, false);
        pm_vec3 from = pm_vec(-1.0, 0.05, -heights[i]);
        pm_ray along = pm_glows_ray(from, pm_vec(1.0, 0.0, 0.0), 2.0);
        double want = glow_below(&s, &along);
        pm_glows_check(&s, &along, want, 0.025);
        s.lights[0].extent = sqrt(0.125);
        pm_glows_check(&s, &along, want, 0.025);
        pm_scenes_free(&s);
    }
}

static void rays_that_end_on_a_lamp(void)
{
    // Straight below its middle: the lamp fills half of all directions in the end.
    pm_scenes s;
    begin_lamp(&s, 0.0, true);
    pm_glows_integrand in = {
        &s, pm_glows_ray(pm_vec(0.01, 0.02, -1.0), pm_vec(0.0, 0.0, 1.0), 1.0), {0.0}, 0.0};
    double want = pm_integral(over_lamp, &in, 0.0, 0.9);
    want += pm_integral(over_lamp, &in, 0.9, 0.99);
    // The last centimetre: half of all directions see it, up to 4 times 0.01 / 0.25.
    double last = 0.6 * 0.8 * 0.5 * 4.0 * exp(-0.6) * 0.01;
    pm_glows_answer many = pm_glows_ask(&s, &in.along, 16, 400);
    CHECK_NEAR(many.mean, want + last, 5.0 * many.sd + 0.08 * last);
    CHECK(many.sd < 0.015 * want);
    pm_scenes_free(&s);
}

static void backs_of_lamps_are_dark(void)
{
    pm_scenes s;
    begin_lamp(&s, 0.0, true);
    pm_ray above = pm_glows_ray(pm_vec(-1.0, 0.0, 0.1), pm_vec(1.0, 0.0, 0.0), 2.0);
    CHECK_NEAR(pm_glows_ask(&s, &above, 4, 100).mean, 0.0, 0.0);
    pm_scenes_free(&s);
}

// --- skies ----------------------------------------------------------------------------------

/// Of the sky around a ball of radius 1, from direction `cosine` at in->t of its diameter.
static double from_sky(double cosine, void *context)
{
    const pm_glows_integrand *in = context;
    const pm_medium *fog = &in->s->media[0];
    double x = in->t - 1.0; // from the middle
    double way = -x * cosine + sqrt(1.0 - x * x * (1.0 - cosine * cosine));
    return 2.0 * PM_PI * pm_medium_phase(fog, cosine) * exp(-fog->sigma_t * way);
}

static double over_sky(double t, void *context)
{
    pm_glows_integrand *in = context;
    const pm_medium *fog = &in->s->media[0];
    in->t = t;
    return fog->sigma_t * fog->albedo.c[1] * exp(-fog->sigma_t * t) *
           pm_integral(from_sky, in, -1.0, 1.0);
}

static void skies_around_a_ball(void)
{
    static const double asymmetry[3] = {0.0, 0.7, -0.5};
    for (int i = 0; i < 6; i++) {
        pm_scenes s;
        pm_scenes_begin(&s);
        pm_scenes_medium(&s, i < 3 ? 0.7 : 5.0, pm_gray(0.8), asymmetry[i % 3]);
        pm_scenes_bound(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0), 0, PM_NONE);
        pm_scenes_sky(&s, pm_gray(0.5));
        pm_scenes_sky(&s, pm_gray(1.5));
        pm_scenes_ready(&s);
        pm_glows_integrand in = {
            &s, pm_glows_ray(pm_vec(0.0, 0.0, -1.0), pm_vec(0.0, 0.0, 1.0), 2.0), {0.0}, 0.0};
        pm_glows_check(&s, &in.along, 2.0 * pm_integral(over_sky, &in, 0.0, 2.0),
                       i < 3 ? 0.02 : 0.07);
        pm_scenes_free(&s);
    }
}

static void shadow_rays_are_few(void)
{
    pm_scenes s;
    begin_lamp(&s, 0.0, true);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, -2.0), pm_gray(1.0));
    pm_ray far_off = pm_glows_ray(pm_vec(-1.0, 0.0, -1.0), pm_vec(1.0, 0.0, 0.0), 2.0);
    pm_ray near_by = pm_glows_ray(pm_vec(-1.0, 0.0, -0.1), pm_vec(1.0, 0.0, 0.0), 2.0);
    pm_direct_query query = {.world = &s.world, .samples = 1, .step = 1};
    pm_single(&query, &far_off);
    CHECK(query.rays == 2);
    pm_single(&query, &near_by);
    CHECK(query.rays == 5);
    s.media[0].albedo = pm_gray(0.0);
    CHECK(pm_spectrum_is_black(pm_single(&query, &near_by)) && query.rays == 5);
    near_by.medium = PM_NONE;
    CHECK(pm_spectrum_is_black(pm_single(&query, &near_by)) && query.rays == 5);
    pm_scenes_free(&s);
}

PM_TESTS({"single_lamp.1", "a lamp's glow is that of the integral, far off and near by",
          lamps_in_endless_fog},
         {"single_lamp.2", "the glow before a lamp that the ray ends on is finite and sharp",
          rays_that_end_on_a_lamp},
         {"single_lamp.3", "the back of a lamp lights no fog", backs_of_lamps_are_dark},
         {"single_lamp.4", "the sky's light in a ball of fog is that of the integral",
          skies_around_a_ball},
         {"single_lamp.5", "one place needs one shadow ray a light, one more for a near lamp",
          shadow_rays_are_few})

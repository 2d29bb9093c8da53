// Unbiased path tracing against closed forms and against a path tracer that draws no lights:
// 5 sigma and nothing more.
#include "references.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"
#include "tiny_path_tracer.h"

static void room_agrees_with_chance(void)
{
    pm_scenes s;
    pm_references_room(&s, true);
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.95, 0.1), pm_vec(0.0, 1.0, 0.0), 0.9, 20);
    pm_pictures_means want = pm_tiny_trace(&s.world, 200000);
    pm_pictures_means got = pm_references_trace(&s, 200);
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        pm_references_agree((pm_layer)layer, &got, &want);
        CHECK(layer == PM_LAYER_VOLUME || want.mean[layer].c[0] > 0.0);
    }
    pm_scenes_free(&s);
}

/// Everything emits 1 and reflects a half.
static void furnace_begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_globe(s, 1.0, pm_scenes_diffuse(s, pm_rgb(0.5, 0.25, 0.75)));
    pm_scenes_lamp(s, 0, pm_gray(1.0));
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.3, 0.1, -0.2), pm_vec(0.0, 1.0, 0.0), 1.0, 16);
}

static double power_series(double rho, int terms)
{
    double sum = 0.0;
    for (int i = 0; i < terms; i++) {
        sum = 1.0 + rho * sum;
    }
    return sum;
}

/// Checks the picture of a furnace whose paths have at most `events` events.
static void check_furnace(uint32_t max_bounces, int events)
{
    const double rho[3] = {0.5, 0.25, 0.75};
    pm_scenes s;
    furnace_begin(&s);
    pm_reference_settings settings = pm_references_settings(64);
    settings.max_bounces = max_bounces;
    pm_reference_report report;
    pm_image image = pm_references_take(&s, &settings, &report);
    pm_pictures_means got = pm_references_means(&image);
    CHECK((report.cut > 0) == (max_bounces > 0));
    for (int c = 0; c < 3; c++) {
        CHECK_NEAR(got.mean[PM_LAYER_EMISSION].c[c], 1.0, 1e-6);
        CHECK_CLOSE("direct", got.mean[PM_LAYER_DIRECT].c[c], rho[c],
                    got.variance[PM_LAYER_DIRECT].c[c], 0.0);
        double indirect = power_series(rho[c], events + 1) - 1.0 - rho[c];
        CHECK_CLOSE("indirect", got.mean[PM_LAYER_INDIRECT].c[c], indirect,
                    got.variance[PM_LAYER_INDIRECT].c[c], 0.0);
    }
    pm_image_free(&image);
    pm_scenes_free(&s);
}

static void furnace_is_exact(void)
{
    check_furnace(0, 200);
}

static void capped_furnace_is_a_partial_sum(void)
{
    check_furnace(3, 3);
}

/// A floor of albedo 0.8 in z = 0, and a camera that looks at one point of it.
static void floor_begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_add(s, pm_scenes_square(8.0, 0.0, false),
                  pm_scenes_diffuse(s, pm_rgb(0.8, 0.4, 0.2)), PM_NONE);
}

static void floor_ready(pm_scenes *s, double x)
{
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(x, 2.0, 1.0), pm_vec(x, 0.0, 0.0), 1e-6, 1);
}

static pm_spectrum floor_direct(const pm_scenes *s)
{
    pm_reference_settings settings = pm_references_settings(2);
    pm_image image = pm_references_take(s, &settings, NULL);
    pm_spectrum direct = pm_pictures_layer(&image, PM_LAYER_DIRECT);
    pm_image_free(&image);
    return direct;
}

/// The floor at x must shine by albedo / pi times this irradiance.
static void check_floor(const pm_scenes *s, double irradiance)
{
    const double albedo[3] = {0.8, 0.4, 0.2};
    pm_spectrum got = floor_direct(s);
    for (int c = 0; c < 3; c++) {
        double want = albedo[c] / PM_PI * irradiance;
        CHECK_NEAR(got.c[c], want, 1e-5 * want);
    }
}

// cos / d^2 with the height 1.5 and the distance x: 1.5 / (1.5^2 + x^2)^1.5.
static double falling(double x)
{
    return 1.5 / pow(1.5 * 1.5 + x * x, 1.5);
}

static void lights_without_extent_have_closed_forms(void)
{
    const double cone[2] = {0.3, 0.9};
    for (double x = 0.0; x < 1.2; x += 0.25) {
        pm_scenes s;
        floor_begin(&s);
        pm_scenes_point(&s, pm_vec(0.0, 0.0, 1.5), pm_gray(4.0 * PM_PI));
        floor_ready(&s, x);
        check_floor(&s, falling(x));
        pm_scenes_free(&s);

        floor_begin(&s);
        pm_scenes_spot(&s, pm_vec(0.0, 0.0, 1.5), pm_vec(0.0, 0.0, -1.0), cone, pm_gray(1.0));
        floor_ready(&s, x);
        double angle = atan2(x, 1.5);
        double share = fmin(1.0, (0.9 - angle) / 0.6);
        check_floor(&s, share * falling(x));
        pm_scenes_free(&s);

        floor_begin(&s);
        pm_scenes_sun(&s, pm_vec(x, 0.0, -1.0), pm_gray(3.0));
        floor_ready(&s, x);
        check_floor(&s, 3.0 / sqrt(1.0 + x * x));
        pm_scenes_free(&s);
    }
}

/// Form factor from a point to a square lamp of width w at the height h right above it.
static double square_above(double w, double h)
{
    double x = 0.5 * w / h;
    double root = sqrt(1.0 + x * x);
    return 4.0 / PM_PI * (x / root * atan(x / root));
}

static void null_lamp(pm_scenes *s, double width, double height, double radiance)
{
    int lamp = pm_scenes_wear(s, pm_scenes_square(width, height, true), pm_scenes_null(s));
    pm_scenes_lamp(s, lamp, pm_gray(radiance));
}

// Two lamps one above the other; the lower one lets the light of the upper one pass.
static void lamps_have_a_closed_form(void)
{
    pm_scenes s;
    floor_begin(&s);
    null_lamp(&s, 1.0, 0.5, 1.0);
    null_lamp(&s, 2.0, 0.8, 3.0);
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 1.0, 0.2), pm_vec(0.0, 0.0, 0.0), 1e-6, 32);
    pm_pictures_means got = pm_references_trace(&s, 64);
    double want = 0.8 * (square_above(1.0, 0.5) + 3.0 * square_above(2.0, 0.8));
    CHECK_CLOSE("direct", got.mean[PM_LAYER_DIRECT].c[0], want,
                got.variance[PM_LAYER_DIRECT].c[0], 0.0);
    CHECK(got.mean[PM_LAYER_INDIRECT].c[0] == 0.0);
    pm_scenes_free(&s);
}

static void null_lamps_shine_and_let_pass(void)
{
    pm_scenes s;
    floor_begin(&s);
    pm_scenes_sun(&s, pm_vec(0.0, 1.0, -1.0), pm_gray(2.0));
    int lamp = pm_scenes_wear(&s, pm_scenes_square(1.0, 3.0, false), pm_scenes_null(&s));
    pm_scenes_lamp(&s, lamp, pm_gray(0.5));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 4.0), pm_vec(0.0, 0.0, 0.0), 1e-6, 4);
    pm_pictures_means got = pm_references_trace(&s, 2);
    CHECK_NEAR(got.mean[PM_LAYER_EMISSION].c[0], 0.5, 1e-6);
    CHECK_NEAR(got.mean[PM_LAYER_DIRECT].c[0], 0.8 / PM_PI * 2.0 * sqrt(0.5), 1e-6);
    pm_scenes_free(&s);
}

static void backs_absorb(void)
{
    pm_scenes s;
    floor_begin(&s);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, -1.0), pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.5, -2.0), pm_vec(0.0, 0.0, 0.0), 0.1, 4);
    pm_pictures_means got = pm_references_trace(&s, 4);
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        CHECK(pm_spectrum_is_black(got.mean[layer]));
    }
    pm_scenes_free(&s);
}

// No path leaves a convex body twice: a ball of albedo rho shines by rho in a sky of 1.
static void balls_in_a_sky_shine_by_their_albedo(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0),
                   pm_scenes_diffuse(&s, pm_rgb(0.6, 0.3, 0.6)));
    pm_scenes_sky(&s, pm_rgb(1.0, 2.0, 3.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -3.0, 0.0), pm_vec(0.0, 0.0, 0.0), 0.2, 16);
    pm_pictures_means got = pm_references_trace(&s, 64);
    const double want[3] = {0.6, 0.6, 1.8};
    for (int c = 0; c < 3; c++) {
        CHECK_CLOSE("direct", got.mean[PM_LAYER_DIRECT].c[c], want[c],
                    got.variance[PM_LAYER_DIRECT].c[c], 0.0);
    }
    CHECK(pm_spectrum_is_black(got.mean[PM_LAYER_INDIRECT]));
    pm_pictures_look(&s, pm_vec(0.0, -3.0, 0.0), pm_vec(0.0, -9.0, 0.0), 0.2, 4);
    got = pm_references_trace(&s, 4);
    CHECK_NEAR(got.mean[PM_LAYER_EMISSION].c[2], 3.0, 0.0);
    pm_scenes_free(&s);
}

// Inside glass of index n, light from a sky of 1 has the radiance n^2.
static void radiance_grows_in_glass(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0), pm_scenes_glass(&s, 1.5));
    pm_scenes_sky(&s, pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 1.0, 0.0), 0.5, 4);
    pm_pictures_means got = pm_references_trace(&s, 4);
    CHECK_NEAR(got.mean[PM_LAYER_SPECULAR].c[0], 2.25, 1e-6);
    pm_pictures_look(&s, pm_vec(0.0, -3.0, 0.0), pm_vec(0.0, 0.0, 0.0), 0.1, 4);
    got = pm_references_trace(&s, 4);
    CHECK_NEAR(got.mean[PM_LAYER_SPECULAR].c[0], 1.0, 1e-6);
    pm_scenes_free(&s);
}

/// A floor of rough metal between a lamp and a wall, seen from above.
static void check_rough(pm_microfacet_kind kind, double alpha, double width)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int metal = pm_scenes_rough_mirror(&s, kind, alpha);
    pm_scenes_add(&s, pm_scenes_square(4.0, 0.0, false), metal, PM_NONE);
    int lamp = pm_scenes_wear(&s, pm_scenes_square(width, 1.0, true), PM_NONE);
    pm_scenes_lamp(&s, lamp, pm_gray(1.0 / (width * width)));
    pm_shape wall = pm_shapes_rectangle(pm_vec(-2.0, 2.0, 0.0), pm_vec(0.0, 0.0, 3.0),
                                        pm_vec(4.0, 0.0, 0.0));
    pm_scenes_wear(&s, wall, pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -1.0, 1.0), pm_vec(0.0, 0.0, 0.0), 0.5, 16);
    pm_pictures_means want = pm_tiny_trace(&s.world, 60000);
    pm_pictures_means got = pm_references_trace(&s, 64);
    pm_layer seen = alpha <= 0.1 ? PM_LAYER_SPECULAR : PM_LAYER_DIRECT;
    CHECK(want.mean[seen].c[0] > 0.0 && want.mean[PM_LAYER_EMISSION].c[0] == 0.0);
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        pm_references_agree((pm_layer)layer, &got, &want);
    }
    pm_scenes_free(&s);
}

static void rough_metal_shows_lamps_once(void)
{
    check_rough(PM_MICROFACET_GGX, 0.3, 1.5);
    check_rough(PM_MICROFACET_GGX, 0.3, 0.3);
    check_rough(PM_MICROFACET_BECKMANN, 0.1, 1.5);
    check_rough(PM_MICROFACET_BECKMANN, 0.1, 0.3);
}

/// A box of rough plastic with a smooth plastic ball, a pane and rough metal of coloured index.
static void glossy_room_agrees_with_chance(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int walls = pm_scenes_rough_plastic(&s, pm_rgb(0.6, 0.4, 0.2), 1.5, PM_MICROFACET_GGX, 0.2);
    pm_scenes_room(&s, 1.0, walls);
    int lamp = pm_scenes_wear(&s, pm_scenes_square(1.0, 0.95, true), walls);
    pm_scenes_lamp(&s, lamp, pm_rgb(2.0, 1.5, 1.0));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(-0.5, 0.3, -0.6), 0.4),
                   pm_scenes_plastic(&s, pm_rgb(0.2, 0.3, 0.7), 1.5));
    int copper = pm_scenes_rough_metal(&s, pm_rgb(0.2, 0.9, 1.1), pm_rgb(3.9, 2.5, 2.2), 0.1);
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.5, 0.3, -0.5), 0.4), copper);
    pm_scenes_wear(&s, pm_scenes_square(0.8, 0.1, false), pm_scenes_pane(&s, 1.5));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.95, 0.1), pm_vec(0.0, 1.0, 0.0), 0.9, 16);
    pm_pictures_means want = pm_tiny_trace(&s.world, 150000);
    pm_pictures_means got = pm_references_trace(&s, 128);
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        pm_references_agree((pm_layer)layer, &got, &want);
        CHECK(layer == PM_LAYER_VOLUME || want.mean[layer].c[0] > 0.0);
    }
    pm_scenes_free(&s);
}

PM_TESTS({"reference.1", "each layer of a room is what paths find that draw no lights",
          room_agrees_with_chance},
         {"reference.2", "a closed furnace shines by Le / (1 - rho)", furnace_is_exact},
         {"reference.3", "paths of at most n events add up to n + 1 terms of the furnace",
          capped_furnace_is_a_partial_sum},
         {"reference.4", "direct light of a point, a spot and a sun has its closed form",
          lights_without_extent_have_closed_forms},
         {"reference.5", "a floor under two lamps has the light of both form factors",
          lamps_have_a_closed_form},
         {"reference.6", "a null lamp shines, and what lies behind is seen",
          null_lamps_shine_and_let_pass},
         {"reference.7", "the back of a one-sided surface is black", backs_absorb},
         {"reference.8", "a ball in a sky shines by its albedo, and the sky is seen",
          balls_in_a_sky_shine_by_their_albedo},
         {"reference.9", "radiance is n^2 times as high in glass, and as before behind it",
          radiance_grows_in_glass},
         {"reference.10", "rough metal shows lamps as brute force does, whatever their size",
          rough_metal_shows_lamps_once},
         {"reference.11",
          "each layer of a room of plastic, metal and a pane is what paths find"
          " that draw no lights",
          glossy_room_agrees_with_chance})

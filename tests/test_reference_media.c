// The reference in fog: closed forms of what gets through, of single scattering and of closed
// globes, and a path tracer that draws no lights and travels through media by other means.
#include "quadrature.h"
#include "references.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"
#include "tiny_path_tracer.h"

#include <stdio.h>

/// Mean and variance over the film of the whole picture, all layers together.
static void whole_of(const pm_image *image, pm_spectrum *mean, pm_spectrum *variance)
{
    double pixels = (double)image->width * image->height;
    for (int c = 0; c < 3; c++) {
        char name[2][16];
        const float *half[2];
        for (int h = 0; h < 2; h++) {
            snprintf(name[h], sizeof name[h], "half%d.%c", h + 1, "RGB"[c]);
            half[h] = pm_image_plane(image, name[h]);
            CHECK(half[h] != NULL);
        }
        double squares = 0.0;
        double sum = 0.0;
        for (int i = 0; i < image->width * image->height; i++) {
            double difference = (double)half[0][i] - (double)half[1][i];
            sum += 0.5 * ((double)half[0][i] + (double)half[1][i]);
            squares += 0.25 * difference * difference;
        }
        mean->c[c] = sum / pixels;
        variance->c[c] = squares / pixels / pixels;
    }
}

/// Ends the test unless every channel of the whole picture is `want` on average.
static void check_whole(const pm_scenes *s, uint32_t spp, double want)
{
    pm_reference_settings settings = pm_references_settings(spp);
    pm_image image = pm_references_take(s, &settings, NULL);
    pm_spectrum mean;
    pm_spectrum variance;
    whole_of(&image, &mean, &variance);
    for (int c = 0; c < 3; c++) {
        CHECK_THAT(variance.c[c] < 1e-4 * want * want, "too noisy: %g", variance.c[c]);
        CHECK_CLOSE("whole picture", mean.c[c], want, variance.c[c], 0.0);
    }
    pm_image_free(&image);
}

static void agree(const pm_pictures_means *got, const pm_pictures_means *want)
{
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        pm_references_agree((pm_layer)layer, got, want);
    }
}

// --- what gets through ----------------------------------------------------------------------

/// A lamp behind a cube of dark fog, askew, that holds a ball of fog twice as dark. Returns the
/// length of fog that has the depth of what a ray through both their middles passes.
static double dim_lamp_begin(pm_scenes *s, double sigma_t)
{
    pm_scenes_begin(s);
    int fog = pm_scenes_medium(s, sigma_t, pm_gray(0.0), 0.0);
    int dark = pm_scenes_medium(s, 2.0 * sigma_t, pm_gray(0.0), 0.0);
    pm_scenes_bound(s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 0.25), dark, fog);
    pm_frame turned = pm_frame_around(pm_vec(0.6, 0.0, 0.8));
    pm_scenes_bound(s, pm_shapes_cube(&turned, pm_vec(0.0, 0.0, 0.0), 0.5), fog, PM_NONE);
    int lamp = pm_scenes_wear(s, pm_scenes_square(2.0, -1.0, false), PM_NONE);
    pm_scenes_lamp(s, lamp, pm_rgb(1.0, 2.0, 3.0));
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, 0.0, 3.0), pm_vec(0.0, 0.0, 0.0), 1e-6, 32);
    return 1.0 / 0.8 + 0.5; // a cube of side 1, and a ball of width 0.5 once more
}

static void fog_dims_what_lies_behind(void)
{
    for (int i = 0; i < 3; i++) {
        double sigma_t = 0.5 + i;
        pm_scenes s;
        double length = dim_lamp_begin(&s, sigma_t);
        pm_pictures_means got = pm_references_trace(&s, 16);
        for (int c = 0; c < 3; c++) {
            CHECK_CLOSE("emission", got.mean[PM_LAYER_EMISSION].c[c],
                        (c + 1) * exp(-sigma_t * length), got.variance[PM_LAYER_EMISSION].c[c],
                        0.0);
        }
        CHECK(pm_spectrum_is_black(got.mean[PM_LAYER_VOLUME]));
        pm_scenes_free(&s);
    }
}

static void depth_and_mask_know_no_fog(void)
{
    pm_scenes s;
    dim_lamp_begin(&s, 20.0); // hardly any path gets through
    pm_reference_settings settings = pm_references_settings(2);
    pm_image image = pm_references_take(&s, &settings, NULL);
    CHECK_NEAR(pm_pictures_mean(&image, "depth.Z"), 4.0, 1e-5);
    CHECK_NEAR(pm_pictures_mean(&image, "normal.Z"), 1.0, 1e-6);
    CHECK(pm_pictures_mean(&image, "mask.emitter") == 1.0);
    CHECK(pm_pictures_mean(&image, "emission.R") == 0.0);
    pm_image_free(&image);
    s.lights[0].emitted = pm_gray(0.0);
    s.shapes[2].light = PM_NONE;
    pm_scenes_sky(&s, pm_gray(1.0));
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 0.0), pm_vec(1.0, 0.0, 0.0), 1e-6, 32);
    s.scene.camera.medium = 1;
    image = pm_references_take(&s, &settings, NULL);
    CHECK(pm_pictures_mean(&image, "mask.emitter") == 1.0);
    CHECK(pm_pictures_mean(&image, "depth.Z") == 0.0);
    pm_image_free(&image);
    pm_scenes_free(&s);
}

// In a globe of radius 1 the mean over cosines of what a chord of 2 cos lets through is
// 2 [1 - (1 + 2 t) exp(-2 t)] / (2 t)^2.
static void dark_fog_dims_a_globe_by_its_chords(void)
{
    const double rho[3] = {0.5, 0.25, 0.75};
    const double t = 0.7;
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, t, pm_gray(0.0), 0.0);
    pm_scenes_globe(&s, 1.0, pm_scenes_diffuse(&s, pm_rgb(rho[0], rho[1], rho[2])));
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_gray(4.0 * PM_PI * PM_PI));
    s.lights[0].medium = fog;
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 1.0, 0.0), 0.5, 16);
    s.scene.camera.medium = fog;
    pm_pictures_means got = pm_references_trace(&s, 128);
    double chords = 2.0 * (1.0 - (1.0 + 2.0 * t) * exp(-2.0 * t)) / (4.0 * t * t);
    for (int c = 0; c < 3; c++) {
        double direct = rho[c] * exp(-2.0 * t);
        double series = rho[c] * chords / (1.0 - rho[c] * chords);
        CHECK_CLOSE("direct", got.mean[PM_LAYER_DIRECT].c[c], direct,
                    got.variance[PM_LAYER_DIRECT].c[c], 0.0);
        CHECK_CLOSE("indirect", got.mean[PM_LAYER_INDIRECT].c[c], direct * series,
                    got.variance[PM_LAYER_INDIRECT].c[c], 0.0);
    }
    pm_scenes_free(&s);
}

// --- single scattering ----------------------------------------------------------------------

static double phase_at(double g, double cosine)
{
    return 0.25 / PM_PI * (1.0 - g * g) / pow(1.0 + g * g - 2.0 * g * cosine, 1.5);
}

/// A wide layer of fog between z = 0 and -1 under a sun of irradiance 1 at the cosine 0.8, seen
/// at the cosine 0.6 from above or from below. Paths have one event.
static void check_layer(double g, bool above)
{
    const double albedo[3] = {1.0, 0.5, 0.2};
    const double t = 1.5;
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, t, pm_rgb(albedo[0], albedo[1], albedo[2]), g);
    pm_scenes_bound(&s, pm_scenes_square(300.0, 0.0, false), fog, PM_NONE);
    pm_scenes_bound(&s, pm_scenes_square(300.0, -1.0, true), fog, PM_NONE);
    pm_scenes_sun(&s, pm_vec(0.6, 0.0, -0.8), pm_gray(1.0));
    pm_scenes_ready(&s);
    double up = above ? 1.0 : -1.0;
    pm_vec3 middle = pm_vec(0.0, 0.0, -0.5);
    pm_vec3 from = pm_vec_add(middle, pm_vec(0.0, 4.0, 3.0 * up));
    pm_pictures_look(&s, from, middle, 1e-6, 16);
    pm_reference_settings settings = pm_references_settings(64);
    settings.max_bounces = 1;
    pm_image image = pm_references_take(&s, &settings, NULL);
    pm_pictures_means got = pm_references_means(&image);
    double cosine = up * 0.6 * -0.8; // between the sun's way and the way to the eye
    double rate = 1.0 / 0.6 + up / 0.8;
    double through = above ? 1.0 : exp(-t / 0.8);
    double integral = through * (1.0 - exp(-t * rate)) / rate / 0.6;
    for (int c = 0; c < 3; c++) {
        double want = albedo[c] * phase_at(g, cosine) * integral;
        CHECK_CLOSE("volume", got.mean[PM_LAYER_VOLUME].c[c], want,
                    got.variance[PM_LAYER_VOLUME].c[c], 0.0);
    }
    pm_image_free(&image);
    pm_scenes_free(&s);
}

static void single_scattering_in_a_layer_is_closed(void)
{
    for (int i = -1; i <= 1; i++) {
        check_layer(0.6 * i, true);
        check_layer(0.6 * i, false);
    }
}

// A point light at the height h over a line of sight through fog that fills everything.
static void a_point_light_glows_as_quadrature_says(void)
{
    const double t = 0.8;
    const double h = 0.5;
    const double g = 0.4;
    double node[PM_QUADRATURE_MAX];
    double weight[PM_QUADRATURE_MAX];
    pm_quadrature_nodes(PM_QUADRATURE_MAX, node, weight);
    double want = 0.0; // in the angle at the light, which makes 1 / r^2 even
    for (int i = 0; i < PM_QUADRATURE_MAX; i++) {
        double low = atan2(-2.0, h);
        double angle = low + node[i] * (0.5 * PM_PI - low);
        double along = 2.0 + h * tan(angle);
        double seen = exp(-t * (along + h / cos(angle)));
        want += weight[i] * (0.5 * PM_PI - low) / h * seen * t * phase_at(g, -sin(angle));
    }
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, t, pm_gray(0.9), g);
    pm_scenes_point(&s, pm_vec(0.0, h, 0.0), pm_gray(4.0 * PM_PI));
    pm_scenes_wear(&s, pm_scenes_square(0.1, 50.0, false), PM_NONE);
    s.lights[0].medium = fog;
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(-2.0, 0.0, 0.0), pm_vec(0.0, 0.0, 0.0), 1e-6, 32);
    s.scene.camera.medium = fog;
    pm_reference_settings settings = pm_references_settings(32);
    settings.max_bounces = 1;
    pm_image image = pm_references_take(&s, &settings, NULL);
    pm_pictures_means got = pm_references_means(&image);
    double variance = got.variance[PM_LAYER_VOLUME].c[0];
    CHECK_THAT(variance < 1e-4 * want * want, "too noisy");
    CHECK_CLOSE("volume", got.mean[PM_LAYER_VOLUME].c[0], 0.9 * want, variance, 0.0);
    pm_image_free(&image);
    pm_scenes_free(&s);
}

// --- closed furnaces ------------------------------------------------------------------------

/// Walls that shine by 1 - rho and reflect rho, around fog that absorbs nothing.
static void check_furnace(double rho, double sigma_t, double g)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, sigma_t, pm_gray(1.0), g);
    int thick = pm_scenes_medium(&s, 3.0 * sigma_t, pm_gray(1.0), -g);
    pm_scenes_globe(&s, 1.0, pm_scenes_diffuse(&s, pm_gray(rho)));
    pm_scenes_lamp(&s, 0, pm_gray(1.0 - rho));
    pm_scenes_bound(&s, pm_shapes_sphere(pm_vec(0.0, 0.5, 0.1), 0.3), thick, fog);
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(-0.3, 0.3, -0.4), 0.3),
                   pm_scenes_glass(&s, 1.5));
    s.lights[0].medium = fog;
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.3, -0.4, -0.2), pm_vec(0.0, 1.0, 0.0), 1.0, 16);
    s.scene.camera.medium = fog;
    check_whole(&s, 24, 1.0);
    pm_scenes_free(&s);
}

static void fog_in_a_furnace_cannot_be_seen(void)
{
    check_furnace(0.0, 1.0, 0.0);
    check_furnace(0.0, 2.0, 0.8);
    check_furnace(0.5, 1.0, -0.5);
}

// By the way back of light, a ball of fog before a sky of 1 shines at its centre by what
// escapes of a point light there; without absorption that is everything.
static void fog_before_an_even_sky_cannot_be_seen(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    int fog = pm_scenes_medium(&s, 3.0, pm_gray(1.0), 0.6);
    pm_scenes_bound(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0), fog, PM_NONE);
    pm_scenes_sky(&s, pm_gray(1.0));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -4.0, 0.0), pm_vec(0.0, 0.0, 0.0), 0.4, 8);
    pm_reference_settings settings = pm_references_settings(8);
    pm_image image = pm_references_take(&s, &settings, NULL);
    CHECK_NEAR(pm_pictures_mean(&image, "R"), 1.0, 1e-6);
    double shares = pm_pictures_mean(&image, "volume.R");
    CHECK(shares > 0.1 && shares < 0.9);
    pm_image_free(&image);
    pm_scenes_free(&s);
}

// --- against paths that draw no lights ------------------------------------------------------

/// The coloured room of spheres in coloured fog.
static void foggy_room_agrees_with_chance(void)
{
    pm_scenes s;
    pm_references_room(&s, true);
    int fog = pm_scenes_medium(&s, 0.6, pm_rgb(0.9, 0.7, 0.5), 0.5);
    s.lights[0].medium = fog;
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -0.95, 0.1), pm_vec(0.0, 1.0, 0.0), 0.9, 16);
    s.scene.camera.medium = fog;
    pm_pictures_means want = pm_tiny_trace(&s.world, 40000);
    pm_pictures_means got = pm_references_trace(&s, 40);
    agree(&got, &want);
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        CHECK(want.mean[layer].c[0] > 0.0);
    }
    pm_scenes_free(&s);
}

/// A lamp in thin fog, in a ball of it, in other fog that fills a room; the camera outside the
/// ball, a glass ball that holds smoke, and one that holds what is around it.
static void nested_begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    int room = pm_scenes_medium(s, 0.4, pm_rgb(0.5, 0.7, 0.9), 0.0);
    int ball = pm_scenes_medium(s, 1.5, pm_rgb(0.9, 0.6, 0.3), -0.4);
    int smoke = pm_scenes_medium(s, 2.0, pm_gray(0.8), 0.7);
    pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_rgb(0.3, 0.5, 0.7)));
    pm_scenes_bound(s, pm_shapes_sphere(pm_vec(-0.3, 0.3, 0.2), 0.6), ball, room);
    int glass = pm_scenes_glass(s, 1.5);
    int holds = pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.6, 0.3, -0.5), 0.3), glass);
    s->shapes[holds].boundary = true;
    s->shapes[holds].interior = smoke;
    s->shapes[holds].exterior = room;
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(-0.2, -0.05, 0.1), 0.15), glass);
    int lamp = pm_scenes_wear(s, pm_shapes_sphere(pm_vec(-0.3, 0.4, 0.3), 0.25), PM_NONE);
    pm_scenes_lamp(s, lamp, pm_rgb(4.0, 5.0, 6.0));
    s->lights[0].medium = ball;
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.1, -0.95, 0.1), pm_vec(0.0, 0.5, 0.0), 0.9, 16);
    s->scene.camera.medium = room;
}

static void nested_fogs_agree_with_chance(void)
{
    pm_scenes s;
    nested_begin(&s);
    pm_pictures_means want = pm_tiny_trace(&s.world, 40000);
    pm_pictures_means got = pm_references_trace(&s, 40);
    agree(&got, &want);
    CHECK(want.mean[PM_LAYER_CAUSTIC].c[0] > 0.0);
    pm_scenes_free(&s);
}

PM_TESTS({"reference_media.1", "dark fog in dark fog dims a lamp behind both by exp(-depth)",
          fog_dims_what_lies_behind},
         {"reference_media.2", "depth, normal and mask are those of what lies behind fog",
          depth_and_mask_know_no_fog},
         {"reference_media.3", "a globe of dark fog has the light that its chords let through",
          dark_fog_dims_a_globe_by_its_chords},
         {"reference_media.4",
          "a layer in the sun scatters once by its closed form, g's sign too",
          single_scattering_in_a_layer_is_closed},
         {"reference_media.5", "fog around a point light glows as quadrature says",
          a_point_light_glows_as_quadrature_says},
         {"reference_media.6", "fog that absorbs nothing is not seen in a furnace",
          fog_in_a_furnace_cannot_be_seen},
         {"reference_media.7", "a ball of such fog before an even sky is not seen either",
          fog_before_an_even_sky_cannot_be_seen},
         {"reference_media.8",
          "each layer of a foggy room is what paths find that draw no lights",
          foggy_room_agrees_with_chance},
         {"reference_media.9", "fogs in fogs, and glass that holds smoke, agree with them too",
          nested_fogs_agree_with_chance})

// The scenes of the repository, small: `render` against `reference`, layer by layer. Both sort
// paths by the same table, and share scene, materials and lights, but no way of finding light.
//
// Bounds are 5 sigma plus b: nothing for what is not taken from maps, 1.5 % of the layer for
// what is. That b shrinks with the radius is the last test.
#include "camera.h"
#include "references.h"
#include "scene_read.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

enum { SIDE = 32 };

static const double map_slack = 0.015;

/// A scene file in place of a scene made by hand; the caller keeps it where it is.
static void open_scene(pm_scenes *s, const char *path, int side)
{
    *s = (pm_scenes){0};
    CHECK_OK(pm_scene_read(path, NULL, 0, true, &s->scene));
    pm_camera_resize(&s->scene.camera, side, side);
    CHECK_OK(pm_intersect_embree(&s->scene, &s->world));
}

static void close_scene(pm_scenes *s)
{
    pm_intersector_free(&s->world);
    pm_scene_free(&s->scene);
}

/// A scene and what is particular about it.
typedef struct {
    const char *path;
    const char *lit;      // first letters of the layers that it has
    double flatness;      // of the discs
    double radius;        // of all estimates [m]; 0: of the k nearest
    uint64_t light_paths; // of the reference; then what mirrors show is not compared, for the
                          // reference is blind to sunlight that went through glass before
} example;

// On a surface of the radius R a disc of the radius r and the flatness f loses about
// (r / 2 f R)^2 of its photons: with so few of them as here, the default of 0.1 is too flat for
// a narrow tunnel.
static const double tunnel = 0.5;

// Estimates by the k nearest photons see too much light where it is torn into patches smaller
// than their radius, as under water and along the ring; those of one radius for all spread each
// photon's power evenly and keep the sum.
static const uint32_t all_in_reach = 5000;

static pm_render_settings settings_of(const example *e)
{
    pm_render_settings settings = pm_pictures_settings();
    settings.photons[PM_MAP_GLOBAL] = 30000;
    settings.photons[PM_MAP_CAUSTIC] = 30000;
    settings.light.rays = 8;
    settings.light.estimate.k = e->radius > 0.0 ? all_in_reach : 20;
    settings.light.estimate.radius = e->radius > 0.0 ? e->radius : HUGE_VAL;
    settings.light.estimate.flatness = e->flatness;
    return settings;
}

static pm_pictures_means reference_of(const pm_scenes *s, uint64_t light_paths)
{
    if (light_paths == 0) {
        return pm_references_trace(s, 256);
    }
    pm_reference_settings settings = pm_references_settings(32);
    settings.light_paths = light_paths;
    return pm_references_repeat(s, settings, 6);
}

static void check_layer(const example *e, pm_layer layer, const pm_pictures_means *got,
                        const pm_pictures_means *want)
{
    bool mapped = layer != PM_LAYER_EMISSION && layer != PM_LAYER_DIRECT;
    for (int c = 0; c < 3; c++) {
        char what[128];
        double variance = got->variance[layer].c[c] + want->variance[layer].c[c];
        double slack = mapped ? map_slack : 1e-6; // of floats that are summed
        snprintf(what, sizeof what, "%s: %s.%c", e->path, pm_layer_name(layer), "RGB"[c]);
        CHECK_CLOSE(what, got->mean[layer].c[c], want->mean[layer].c[c], variance, slack);
    }
}

static void check_scene(const example *e)
{
    pm_scenes s;
    open_scene(&s, e->path, SIDE);
    pm_pictures_means want = reference_of(&s, e->light_paths);
    pm_pictures_means got = pm_pictures_repeat(&s, settings_of(e), 6);
    for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
        bool named = strchr(e->lit, pm_layer_name(layer)[0]) != NULL;
        CHECK_THAT(named == !pm_spectrum_is_black(got.mean[layer]), "%s: %s is %g", e->path,
                   pm_layer_name(layer), got.mean[layer].c[0]);
        if (layer != PM_LAYER_SPECULAR || e->light_paths == 0) {
            check_layer(e, layer, &got, &want);
        }
    }
    close_scene(&s);
}

static void cornell_diffuse_agrees(void)
{
    check_scene(&(example){"scenes/cornell-diffuse.xml", "edi", 0.1, 0.0, 0});
}

static void cornell_spheres_agrees(void)
{
    check_scene(&(example){"scenes/cornell-spheres.xml", "edsci", 0.1, 0.0, 0});
}

static void cornell_glossy_agrees(void)
{
    check_scene(&(example){"scenes/cornell-glossy.xml", "edsci", 0.1, 0.0, 0});
}

static void lights_agrees(void)
{
    check_scene(&(example){"scenes/lights.xml", "edi", tunnel, 0.0, 0});
}

static void sparse_agrees(void)
{
    check_scene(&(example){"scenes/sparse.xml", "dsci", 0.1, 0.0, 0});
}

static void shell_agrees(void)
{
    check_scene(&(example){"scenes/shell.xml", "di", 0.1, 0.0, 0});
}

static void ring_agrees(void)
{
    check_scene(&(example){"scenes/ring.xml", "dsc", 0.1, 0.02, 60000});
}

static void water_agrees(void)
{
    check_scene(&(example){"scenes/water.xml", "sci", 0.1, 0.05, 60000});
}

/// Mean square of what is wrong with the caustic layer apart from noise: two pictures and the
/// halves of the reference are four independent ones.
static double bias2_of(const pm_scenes *s, double radius, const pm_image *truth)
{
    pm_render_settings settings = settings_of(&(example){.radius = radius, .flatness = 0.1});
    settings.photons[PM_MAP_GLOBAL] = 0;
    settings.photons[PM_MAP_CAUSTIC] = 200000;
    settings.light.rays = 0;
    pm_image one = pm_pictures_take(s, &settings);
    settings.seed = 2;
    pm_image two = pm_pictures_take(s, &settings);
    double sum = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        double a = pm_pictures_at(&one, "caustic.G", i % SIDE, i / SIDE);
        double b = pm_pictures_at(&two, "caustic.G", i % SIDE, i / SIDE);
        double half1 = pm_pictures_at(truth, "half1.caustic.G", i % SIDE, i / SIDE);
        double half2 = pm_pictures_at(truth, "half2.caustic.G", i % SIDE, i / SIDE);
        sum += (a - half1) * (b - half2);
    }
    pm_image_free(&one);
    pm_image_free(&two);
    return sum / (SIDE * SIDE);
}

static void bias_shrinks_with_the_radius(void)
{
    pm_scenes s;
    open_scene(&s, "scenes/ring.xml", SIDE);
    pm_reference_settings settings = pm_references_settings(2);
    settings.light_paths = 500000;
    pm_image truth = pm_references_take(&s, &settings, NULL);
    double before = bias2_of(&s, 0.16, &truth);
    for (double radius = 0.08; radius > 0.03; radius *= 0.5) {
        double bias2 = bias2_of(&s, radius, &truth);
        CHECK_THAT(bias2 < 0.5 * before, "radius %g: bias^2 %g, %g at twice the radius", radius,
                   bias2, before);
        before = bias2;
    }
    pm_image_free(&truth);
    close_scene(&s);
}

PM_TESTS({"agreement.1", "cornell-diffuse: each layer of render is the reference's",
          cornell_diffuse_agrees},
         {"agreement.2", "cornell-spheres: each layer of render is the reference's",
          cornell_spheres_agrees},
         {"agreement.3", "cornell-glossy: each layer of render is the reference's",
          cornell_glossy_agrees},
         {"agreement.4", "lights: each layer of render is the reference's", lights_agrees},
         {"agreement.5", "sparse: each layer of render is the reference's", sparse_agrees},
         {"agreement.6", "shell: each layer of render is the reference's", shell_agrees},
         {"agreement.7", "ring: each layer of render is the reference's", ring_agrees},
         {"agreement.8", "water: each layer of render is the reference's", water_agrees},
         {"agreement.9", "a caustic comes closer to the reference when the radius halves",
          bias_shrinks_with_the_radius})

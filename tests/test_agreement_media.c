// The repository's scenes with fog, small: beams and march against the reference, layer by
// layer, as test_agreement.c does for scenes without. Bounds are 5 sigma + 2 %.
#include "camera.h"
#include "references.h"
#include "scene_read.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

enum { SIDE = 20, RUNS = 5 };

static const double slack = 0.02;

/// A scene, and how it is looked at.
typedef struct {
    const char *path;
    const char *layers; // first letters of those that are compared
    double reach;       // [m] of balls in the fog
    uint32_t spp;       // of the reference
    uint64_t
        light_paths; // of the reference: it finds what glass throws into fog by these alone
} example;

static void open_scene(pm_scenes *s, const char *path)
{
    *s = (pm_scenes){0};
    CHECK_OK(pm_scene_read(path, NULL, 0, true, &s->scene));
    pm_camera_resize(&s->scene.camera, SIDE, SIDE);
    CHECK_OK(pm_intersect_embree(&s->scene, &s->world));
}

static pm_pictures_means reference_of(const pm_scenes *s, const example *e)
{
    if (e->light_paths == 0) {
        return pm_references_trace(s, e->spp);
    }
    pm_reference_settings settings = pm_references_settings(e->spp);
    settings.light_paths = e->light_paths;
    return pm_references_repeat(s, settings, RUNS);
}

static pm_render_settings settings_of(const example *e, pm_media_query query)
{
    pm_render_settings settings = pm_pictures_settings();
    settings.photons[PM_MAP_VOLUME] = 40000;
    settings.light.rays = 8;
    settings.light.estimate.k = 20;
    settings.light.media = query;
    settings.light.step = query == PM_MEDIA_MARCH ? e->reach : 0.0;
    settings.reach[PM_MAP_VOLUME] = e->reach;
    settings.only = query == PM_MEDIA_MARCH ? PM_LAYER_VOLUME : PM_NONE;
    return settings;
}

static void check_query(const pm_scenes *s, const example *e, pm_media_query query,
                        const pm_pictures_means *want)
{
    pm_pictures_means got = pm_pictures_repeat(s, settings_of(e, query), RUNS);
    for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
        bool named = strchr(e->layers, pm_layer_name(layer)[0]) != NULL;
        bool made = query == PM_MEDIA_BEAMS || layer == PM_LAYER_VOLUME;
        for (int c = 0; c < 3 && named && made; c++) {
            char what[128];
            double variance = got.variance[layer].c[c] + want->variance[layer].c[c];
            snprintf(what, sizeof what, "%s: %s.%c by %s", e->path, pm_layer_name(layer),
                     "RGB"[c], query == PM_MEDIA_BEAMS ? "beams" : "march");
            CHECK(got.mean[layer].c[c] > 0.0);
            CHECK_CLOSE(what, got.mean[layer].c[c], want->mean[layer].c[c], variance, slack);
        }
    }
}

static void check_scene(const example *e)
{
    pm_scenes s;
    open_scene(&s, e->path);
    pm_pictures_means want = reference_of(&s, e);
    check_query(&s, e, PM_MEDIA_BEAMS, &want);
    check_query(&s, e, PM_MEDIA_MARCH, &want);
    pm_intersector_free(&s.world);
    pm_scene_free(&s.scene);
}

static void cornell_fog_agrees(void)
{
    check_scene(&(example){"scenes/cornell-fog.xml", "dvi", 0.05, 300, 0});
}

static void sun_agrees(void)
{
    check_scene(&(example){"scenes/sun.xml", "dvi", 0.2, 600, 0});
}

static void glass_fog_agrees(void)
{
    check_scene(&(example){"scenes/glass-fog.xml", "dv", 0.03, 8, 100000});
}

PM_TESTS({"agreement.10", "cornell-fog: beams and march are the reference", cornell_fog_agrees},
         {"agreement.11", "sun: beams and march are the reference", sun_agrees},
         {"agreement.12", "glass-fog: beams and march are the reference", glass_fog_agrees})

// Fog in a room: march, beams and reference find the same light. The first two share photons
// and single scattering, but no estimate; the reference has neither maps nor single.h.
//
// Bounds are 5 sigma + 2 % with balls of 0.1 m, for the march of 0.07 m. Larger ones blur light
// over the edges of the fog: that this shrinks with them is tested, too.
#include "media.h"

#include "references.h"
#include "shapes.h"
#include "test.h"

/// A room of half side 1 with a cube of coloured fog in it, that scatters forward. Camera and
/// light stand outside: photons close to the eye would fill whole pictures, and places close to
/// a point light outshine all others.
static void fog_room(pm_scenes *s)
{
    *s = (pm_scenes){0};
    pm_scenes_begin(s);
    int fog = pm_scenes_medium(s, 1.2, pm_rgb(0.95, 0.7, 0.4), 0.6);
    int walls = pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_rgb(0.3, 0.5, 0.7)));
    s->shapes[walls + 3].material[0] = pm_scenes_diffuse(s, pm_gray(0.1));
    pm_scenes_point(s, pm_vec(0.2, -0.6, 0.7), pm_rgb(12.0, 10.0, 8.0));
    pm_frame upright = pm_shapes_upright();
    pm_scenes_bound(s, pm_shapes_cube(&upright, pm_vec(0.0, 0.3, 0.0), 0.6), fog, PM_NONE);
    pm_pictures_look(s, pm_vec(0.0, -0.95, 0.1), pm_vec(0.0, 0.5, 0.0), 0.8, 10);
    pm_scenes_ready(s);
}

static pm_render_settings settings_of(pm_media_query query, double reach)
{
    pm_render_settings settings = pm_pictures_settings();
    settings.photons[PM_MAP_GLOBAL] = 20000;
    settings.photons[PM_MAP_VOLUME] = 40000;
    settings.light.rays = 4;
    settings.light.estimate.k = 50;
    settings.light.media = query;
    settings.light.step = query == PM_MEDIA_MARCH ? 2.0 * reach : 0.0;
    settings.reach[PM_MAP_VOLUME] = reach;
    return settings;
}

static void agree(const char *what, pm_layer layer, const pm_pictures_means *got,
                  const pm_pictures_means *want, double slack)
{
    for (int c = 0; c < 3; c++) {
        double variance = got->variance[layer].c[c] + want->variance[layer].c[c];
        CHECK(want->mean[layer].c[c] > 0.0);
        CHECK_CLOSE(what, got->mean[layer].c[c], want->mean[layer].c[c], variance, slack);
    }
}

static void both_are_the_reference(void)
{
    pm_scenes s;
    fog_room(&s);
    pm_pictures_means want = pm_references_trace(&s, 900);
    pm_render_settings settings = settings_of(PM_MEDIA_BEAMS, 0.1);
    pm_pictures_means got = pm_pictures_repeat(&s, settings, 4);
    agree("beams: volume", PM_LAYER_VOLUME, &got, &want, 0.02);
    agree("beams: indirect", PM_LAYER_INDIRECT, &got, &want, 0.02);
    agree("direct", PM_LAYER_DIRECT, &got, &want, 1e-6);
    settings = settings_of(PM_MEDIA_MARCH, 0.07);
    settings.only = PM_LAYER_VOLUME;
    got = pm_pictures_repeat(&s, settings, 4);
    agree("march: volume", PM_LAYER_VOLUME, &got, &want, 0.02);
    pm_scenes_free(&s);
}

/// Share of the volume layer that is missing with balls of this reach.
static double missing(const pm_scenes *s, pm_media_query query, double reach,
                      const pm_pictures_means *truth)
{
    pm_render_settings settings = settings_of(query, reach);
    settings.only = PM_LAYER_VOLUME;
    settings.photons[PM_MAP_VOLUME] = 20000;
    pm_pictures_means got = pm_pictures_repeat(s, settings, 2);
    double want = truth->mean[PM_LAYER_VOLUME].c[0];
    return fabs(got.mean[PM_LAYER_VOLUME].c[0] / want - 1.0);
}

static void they_come_closer_when_balls_shrink(void)
{
    pm_scenes s;
    fog_room(&s);
    pm_pictures_means truth = pm_references_trace(&s, 300);
    for (pm_media_query query = 0; query <= PM_MEDIA_MARCH; query++) {
        double large = missing(&s, query, 0.6, &truth);
        double small = missing(&s, query, 0.3, &truth);
        CHECK_THAT(large > 0.05, "query %d: only %g is missing", (int)query, large);
        CHECK_THAT(small < 0.5 * large, "query %d: %g, %g at half the reach", (int)query, large,
                   small);
    }
    pm_scenes_free(&s);
}

static void without_a_volume_map_single_scattering_remains(void)
{
    pm_scenes s;
    fog_room(&s);
    pm_render_settings settings = settings_of(PM_MEDIA_BEAMS, 0.1);
    settings.only = PM_LAYER_VOLUME;
    pm_pictures_means all = pm_pictures_repeat(&s, settings, 2);
    settings.photons[PM_MAP_VOLUME] = 0;
    pm_pictures_means single = pm_pictures_repeat(&s, settings, 2);
    double share = single.mean[PM_LAYER_VOLUME].c[0] / all.mean[PM_LAYER_VOLUME].c[0];
    CHECK_THAT(share > 0.1 && share < 0.4, "single scattering is %g of all", share);
    pm_scenes_free(&s);
}

static void beams_that_are_missing_are_no_darkness(void)
{
    // A map to be asked by beams, and none made: an error, not a black layer.
    pm_scenes s;
    fog_room(&s);
    pm_photon_map map = {.kind = PM_MAP_VOLUME, .scaled = true, .balanced = true};
    pm_compose compose = {.world = &s.world};
    pm_gather gather = {.map[PM_MAP_VOLUME] = &map};
    gather.settings = pm_render_defaults().light;
    pm_gather_sources(&gather, &compose);
    pm_stretch along = {.ray = {.direction = {0.0, 1.0, 0.0}, .t_max = 0.5, .medium = 0}};
    pm_spectrum radiance;
    CHECK_FAILS(pm_media_seen(&gather, &along, &radiance), PM_EINPUT, "has no beams");
    pm_scenes_free(&s);
}

PM_TESTS({"media_agree.1", "beams and march bring the reference's light to fog and walls",
          both_are_the_reference},
         {"media_agree.2", "they come closer to the reference when radius and step halve",
          they_come_closer_when_balls_shrink},
         {"media_agree.3", "without a volume map single scattering remains",
          without_a_volume_map_single_scattering_remains},
         {"media_agree.4", "a volume map without its beams is refused",
          beams_that_are_missing_are_no_darkness})

// What the renderer promises of every picture: layers that add up, the same bits for any number
// of threads and at any scale, channels that say what was seen.
#include "balance.h"
#include "camera.h"
#include "interrupt.h"
#include "photon_map.h"
#include "pictures.h"
#include "scenes.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

#include <omp.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

/// A room with a red wall at -x and a green one at +x, seen along +y, all its lengths times
/// `length` and its lights' powers times `power`.
static void room_begin(pm_scenes *s, double length, double power)
{
    double radiance = power / (length * length);
    pm_scenes_begin(s);
    int white = pm_scenes_diffuse(s, pm_gray(0.7));
    int walls = pm_scenes_room(s, length, white);
    s->shapes[walls].material[0] = pm_scenes_diffuse(s, pm_rgb(0.6, 0.0, 0.0));
    s->shapes[walls + 1].material[0] = pm_scenes_diffuse(s, pm_rgb(0.0, 0.5, 0.0));
    pm_shape lamp = pm_scenes_square(length, 0.75 * length, true);
    pm_scenes_lamp(s, pm_scenes_wear(s, lamp, white), pm_gray(2.0 * radiance));
    pm_scenes_point(s, pm_vec(0.5 * length, -0.25 * length, 0.0), pm_gray(power));
    pm_scenes_wear(
        s, pm_shapes_sphere(pm_vec(-0.4 * length, 0.3 * length, -0.6 * length), 0.375 * length),
        pm_scenes_mirror(s, pm_gray(0.9)));
    pm_scenes_wear(s,
                   pm_shapes_sphere(pm_vec(0.4 * length, 0.0, -0.5 * length), 0.375 * length),
                   pm_scenes_glass(s, 1.5));
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, -0.9 * length, 0.0), pm_vec(0.0, length, 0.0), 1.0, 24);
}

static pm_render_settings gathering(void)
{
    pm_render_settings settings = pm_pictures_settings();
    settings.light.rays = 8;
    settings.light.estimate.k = 40;
    return settings;
}

static void layers_add_up(void)
{
    pm_scenes s;
    room_begin(&s, 1.0, 1.0);
    pm_render_settings settings = gathering();
    pm_image image = pm_pictures_take(&s, &settings);
    for (int i = 0; i < image.width * image.height; i++) {
        for (int c = 0; c < 3; c++) {
            double sum = 0.0;
            for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
                char name[32];
                snprintf(name, sizeof name, "%s.%c", pm_layer_name((pm_layer)layer), "RGB"[c]);
                sum += (double)pm_image_plane(&image, name)[i];
            }
            const char total[2] = {"RGB"[c], '\0'};
            float got = pm_image_plane(&image, total)[i];
            float want = (float)sum;
            CHECK(memcmp(&got, &want, sizeof got) == 0);
            CHECK(isfinite(got) && got >= 0.0f);
        }
    }
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        double mean = pm_spectrum_mean(pm_pictures_layer(&image, (pm_layer)layer));
        CHECK(layer == PM_LAYER_VOLUME ? mean == 0.0 : mean > 0.0);
    }
    pm_image_free(&image);
    pm_scenes_free(&s);
}

static void threads_do_not_matter(void)
{
    const int threads[] = {1, 2, 7};
    pm_scenes s;
    room_begin(&s, 1.0, 1.0);
    pm_render_settings settings = gathering();
    pm_render_maps first = {0};
    pm_image want = {0};
    for (int i = 0; i < 3; i++) {
        omp_set_num_threads(threads[i]);
        pm_render_maps maps = {0};
        pm_image image;
        pm_eye_report report;
        CHECK_OK(pm_render_make_maps(&s.world, &settings, &maps));
        CHECK_OK(pm_render_image(&s.world, &settings, &maps, &image, &report));
        if (i == 0) {
            first = maps;
            want = image;
            continue;
        }
        CHECK_PICTURE(&image, &want, 1.0, NULL);
        for (int kind = 0; kind < PM_MAP_VOLUME; kind++) {
            CHECK(maps.map[kind].count == first.map[kind].count);
            CHECK(memcmp(maps.map[kind].photons, first.map[kind].photons,
                         maps.map[kind].count * sizeof(pm_photon)) == 0);
        }
        pm_image_free(&image);
        pm_render_maps_free(&maps);
    }
    pm_image_free(&want);
    pm_render_maps_free(&first);
    pm_scenes_free(&s);
}

// Everything that draws numbers or counts on the way: rough lobes, a sky, near hits, shadow
// photons, irradiance at photons, caustics from the global map.
static void threads_do_not_matter_to_any_part(void)
{
    const int threads[] = {1, 2, 7};
    pm_scenes s;
    room_begin(&s, 1.0, 1.0);
    int metal = pm_scenes_rough_mirror(&s, PM_MICROFACET_GGX, 0.05);
    s.shapes[1].material[0] = metal;
    int plastic = pm_scenes_rough_plastic(&s, pm_gray(0.5), 1.5, PM_MICROFACET_BECKMANN, 0.2);
    s.shapes[4].material[0] = plastic;
    pm_scenes_sky(&s, pm_gray(1.0));
    pm_intersector_free(&s.world);
    pm_scenes_ready(&s);
    pm_render_settings settings = gathering();
    settings.direct_photons = settings.precompute = settings.light.caustics_global = true;
    pm_image want = {0};
    pm_eye_report first = {0};
    for (int i = 0; i < 3; i++) {
        omp_set_num_threads(threads[i]);
        pm_render_maps maps = {0};
        pm_image image;
        pm_eye_report report;
        CHECK_OK(pm_render_make_maps(&s.world, &settings, &maps));
        CHECK_OK(pm_render_image(&s.world, &settings, &maps, &image, &report));
        CHECK(report.near > 0 && report.shadow_rays > 0 && report.shadow_spared > 0);
        pm_render_maps_free(&maps);
        if (i == 0) {
            want = image;
            first = report;
            continue;
        }
        CHECK_PICTURE(&image, &want, 1.0, NULL);
        CHECK(report.near == first.near && report.lookups == first.lookups);
        CHECK(report.shadow_rays == first.shadow_rays);
        CHECK(report.shadow_spared == first.shadow_spared);
        pm_image_free(&image);
    }
    pm_image_free(&want);
    pm_scenes_free(&s);
}

/// Checks that a channel is `factor` times what it is in `whole`, bit for bit.
static void check_plane(const pm_image *image, const pm_image *whole, const char *name,
                        float factor)
{
    const float *got = pm_image_plane(image, name);
    const float *of = pm_image_plane(whole, name);
    for (int i = 0; i < image->width * image->height; i++) {
        float want = of[i] * factor + 0.0f; // no -0
        CHECK_THAT(memcmp(&got[i], &want, sizeof want) == 0, "%s: got %g, want %g", name,
                   (double)got[i], (double)want);
    }
}

static void one_layer_alone_is_that_of_the_picture(void)
{
    pm_scenes s;
    room_begin(&s, 1.0, 1.0);
    pm_render_settings settings = gathering();
    pm_image all = pm_pictures_take(&s, &settings);
    for (int only = 0; only < PM_LAYER_COUNT; only++) {
        settings.only = only;
        pm_image image = pm_pictures_take(&s, &settings);
        check_plane(&image, &all, "depth.Z", 1.0f);
        check_plane(&image, &all, "normal.X", 1.0f);
        check_plane(&image, &all, "mask.emitter", 1.0f);
        for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
            char name[32];
            snprintf(name, sizeof name, "%s.G", pm_layer_name((pm_layer)layer));
            check_plane(&image, &all, name, layer == only ? 1.0f : 0.0f);
        }
        pm_image_free(&image);
    }
    pm_image_free(&all);
    pm_scenes_free(&s);
}

static void gathering_agrees_with_seeing_the_map(void)
{
    pm_scenes s;
    room_begin(&s, 1.0, 1.0);
    pm_render_settings settings = pm_pictures_settings();
    settings.light.estimate.k = 20;
    pm_pictures_means seen = pm_pictures_repeat(&s, settings, 6);
    settings.light.rays = 32;
    settings.photons[PM_MAP_GLOBAL] = 10000;
    pm_pictures_means gathered = pm_pictures_repeat(&s, settings, 4);
    for (int c = 0; c < 3; c++) {
        double variance =
            seen.variance[PM_LAYER_INDIRECT].c[c] + gathered.variance[PM_LAYER_INDIRECT].c[c];
        CHECK_CLOSE("indirect", gathered.mean[PM_LAYER_INDIRECT].c[c],
                    seen.mean[PM_LAYER_INDIRECT].c[c], variance, 0.04);
    }
    pm_scenes_free(&s);
}

static void channels_say_what_is_seen(void)
{
    pm_scenes s;
    room_begin(&s, 1.0, 1.0);
    pm_render_settings settings = gathering();
    pm_image image = pm_pictures_take(&s, &settings);
    // The middle of the film looks at the far wall, 1.9 away.
    CHECK_NEAR(pm_pictures_at(&image, "depth.Z", 12, 11), 1.9, 0.02);
    CHECK_NEAR(pm_pictures_at(&image, "normal.Y", 12, 11), -1.0, 1e-6);
    CHECK_NEAR(pm_pictures_at(&image, "mask.emitter", 12, 11), 0.0, 0.0);
    CHECK_NEAR(pm_pictures_at(&image, "gather.count", 12, 11), 40.0, 0.0);
    CHECK(pm_pictures_at(&image, "gather.radius", 12, 11) > 0.0);
    // Red is on the left, green on the right; the lamp's edge is up, the floor down.
    CHECK_NEAR(pm_pictures_at(&image, "normal.X", 0, 12), 1.0, 1e-6);
    CHECK(pm_pictures_at(&image, "direct.R", 0, 12) > 0.0);
    CHECK_NEAR(pm_pictures_at(&image, "direct.G", 0, 12), 0.0, 0.0);
    CHECK_NEAR(pm_pictures_at(&image, "normal.X", 23, 12), -1.0, 1e-6);
    CHECK(pm_pictures_at(&image, "direct.G", 23, 12) > 0.0);
    CHECK_NEAR(pm_pictures_at(&image, "direct.R", 23, 12), 0.0, 0.0);
    CHECK_NEAR(pm_pictures_at(&image, "normal.Z", 12, 23), 1.0, 1e-6);
    CHECK_NEAR(pm_pictures_at(&image, "normal.Z", 12, 0), -1.0, 1e-6);
    CHECK_NEAR(pm_pictures_at(&image, "mask.emitter", 12, 1), 1.0, 0.0);
    CHECK_NEAR(pm_pictures_at(&image, "emission.R", 12, 1), 2.0, 1e-6);
    pm_image_free(&image);
    pm_scenes_free(&s);
}

static void nothing_in_sight_is_black(void)
{
    pm_scenes s;
    room_begin(&s, 1.0, 1.0);
    pm_pictures_look(&s, pm_vec(0.0, -5.0, 0.0), pm_vec(0.0, -6.0, 0.0), 0.5, 4);
    pm_render_settings settings = gathering();
    pm_image image = pm_pictures_take(&s, &settings);
    for (int c = 0; c < image.channel_count; c++) {
        CHECK_NEAR(pm_pictures_mean(&image, image.name[c]), 0.0, 0.0);
    }
    pm_image_free(&image);
    pm_scenes_free(&s);
}

static void scale_does_not_matter(void)
{
    const char *const lengths[] = {"depth.Z", "gather.radius", NULL};
    pm_scenes s;
    room_begin(&s, 1.0, 1.0);
    pm_render_settings settings = gathering();
    pm_image want = pm_pictures_take(&s, &settings);
    pm_scenes_free(&s);

    room_begin(&s, 0x1p10, 0x1p20);
    pm_image larger = pm_pictures_take(&s, &settings);
    CHECK_PICTURE(&larger, &want, 1.0, lengths);
    CHECK_NEAR(pm_pictures_mean(&larger, "depth.Z"),
               0x1p10 * pm_pictures_mean(&want, "depth.Z"), 0.0);
    CHECK_NEAR(pm_pictures_mean(&larger, "gather.radius"),
               0x1p10 * pm_pictures_mean(&want, "gather.radius"), 0.0);
    pm_image_free(&larger);
    pm_scenes_free(&s);

    room_begin(&s, 1.0, 0x1p40);
    const char *const kept[] = {"depth.Z",  "gather.radius", "normal.X",     "normal.Y",
                                "normal.Z", "gather.count",  "mask.emitter", NULL};
    pm_image brighter = pm_pictures_take(&s, &settings);
    CHECK_PICTURE(&brighter, &want, 0x1p40, kept);
    pm_image_free(&brighter);
    pm_scenes_free(&s);
    pm_image_free(&want);
}

// --- photons as dots -------------------------------------------------------------------------

static void put_photon(pm_photon_map *map, pm_vec3 position, bool first, bool caustic)
{
    pm_deposit deposit = {
        .position = position,
        .direction = pm_vec(0.0, 1.0, 0.0),
        .normal = pm_vec(0.0, -1.0, 0.0),
        .power = pm_gray(3.0),
        .first = first,
        .caustic = caustic,
    };
    CHECK_OK(pm_store_push(map, &deposit));
}

static void a_photon_lights_the_pixel_it_is_seen_in(void)
{
    pm_scenes s;
    room_begin(&s, 1.0, 1.0);
    pm_render_settings settings = gathering();
    settings.view_photons = true;
    pm_render_maps maps = {0};
    pm_photon_map *global = &maps.map[PM_MAP_GLOBAL];
    *global = (pm_photon_map){.kind = PM_MAP_GLOBAL, .unpacked = true, .scale = 1.0};
    put_photon(global, pm_vec(-0.5, 1.0, 0.7), true, false);  // left, high
    put_photon(global, pm_vec(0.5, 1.0, 0.3), false, false);  // right
    put_photon(global, pm_vec(-0.4, 1.0, -0.6), true, false); // behind the mirror ball
    put_photon(global, pm_vec(0.3, 1.0, 0.5), false, true);
    CHECK_OK(pm_store_scale(global, 4));
    CHECK_OK(pm_balance_build(global));
    maps.has[PM_MAP_GLOBAL] = true;
    pm_image image;
    pm_eye_report report;
    CHECK_OK(pm_render_image(&s.world, &settings, &maps, &image, &report));
    int pixels = image.width * image.height;
    CHECK_NEAR(pm_pictures_mean(&image, "R") * pixels, 3.0, 1e-5);
    int x;
    int y;
    CHECK(pm_camera_pixel(&s.scene.camera, pm_vec(-0.5, 1.0, 0.7), &x, &y));
    CHECK(x == 8 && y == 7); // 12 (1 - 0.5 / 1.9), 12 (1 - 0.7 / 1.9)
    CHECK_NEAR(pm_pictures_at(&image, "direct.R", 8, 7), 1.0, 1e-6);
    CHECK_NEAR(pm_pictures_at(&image, "indirect.R", 15, 10), 1.0, 1e-6);
    CHECK_NEAR(pm_pictures_at(&image, "caustic.R", 13, 8), 1.0, 1e-6);
    pm_image_free(&image);
    pm_render_maps_free(&maps);
    pm_scenes_free(&s);
}

// --- leaving out and stopping ----------------------------------------------------------------

// 1e39 W/m^2 is no float; with 0 W nothing is seen.
static void pictures_without_or_beyond_light_say_so(void)
{
    const double power[] = {0.0, 1.0, 1e40};
    for (int i = 0; i < 3; i++) {
        pm_scenes s;
        room_begin(&s, 1.0, power[i]);
        pm_render_settings settings = gathering();
        settings.only = PM_LAYER_DIRECT;
        pm_render_maps maps = {0};
        pm_image image;
        pm_eye_report report;
        CHECK_OK(pm_render_make_maps(&s.world, &settings, &maps));
        CHECK_OK(pm_render_image(&s.world, &settings, &maps, &image, &report));
        CHECK(report.black == (i == 0));
        CHECK((report.too_bright > 0) == (i == 2));
        pm_image_free(&image);
        pm_render_maps_free(&maps);
        pm_scenes_free(&s);
    }
}

static void sigint_stops_and_leaves_nothing(void)
{
    pm_scenes s;
    room_begin(&s, 1.0, 1.0);
    pm_render_settings settings = gathering();
    pm_render_maps maps = {0};
    pm_render_maps none = {0};
    CHECK_OK(pm_render_make_maps(&s.world, &settings, &maps));
    pm_interrupt_catch();
    CHECK(raise(SIGINT) == 0);
    pm_image image = {.width = -1};
    pm_eye_report report;
    CHECK_FAILS(pm_render_image(&s.world, &settings, &maps, &image, &report), PM_ESTOPPED,
                "stopped");
    CHECK(image.width == -1);
    settings.view_photons = true;
    CHECK_FAILS(pm_render_image(&s.world, &settings, &maps, &image, &report), PM_ESTOPPED,
                "stopped");
    CHECK_FAILS(pm_render_make_maps(&s.world, &settings, &none), PM_ESTOPPED, "stopped");
    CHECK(!none.has[PM_MAP_GLOBAL] && none.map[PM_MAP_GLOBAL].photons == NULL);
    pm_render_maps_free(&none);
    pm_render_maps_free(&maps);
    pm_scenes_free(&s);
}

PM_TESTS(
    {"render.1", "the layers add up to R G B, bit for bit", layers_add_up},
    {"render.2", "1, 2 and 7 threads make the same photons and the same picture",
     threads_do_not_matter},
    {"render.3", "one layer alone is that layer of the whole picture, bit for bit",
     one_layer_alone_is_that_of_the_picture},
    {"render.4", "a final gather and the map seen directly agree on indirect light",
     gathering_agrees_with_seeing_the_map},
    {"render.5", "depth, normal, mask and gather channels are right; red stays left",
     channels_say_what_is_seen},
    {"render.6", "where nothing is in sight every channel is 0", nothing_in_sight_is_black},
    {"render.7", "powers of two in lengths and powers change no other bit of a picture",
     scale_does_not_matter},
    {"render.8", "a photon lights the pixel that it is seen in, in the layer of its path",
     a_photon_lights_the_pixel_it_is_seen_in},
    {"render.9", "after SIGINT maps and pictures stop and hand nothing out",
     sigint_stops_and_leaves_nothing},
    {"render.10", "a black picture and one too bright for floats are reported",
     pictures_without_or_beyond_light_say_so},
    {"render.11",
     "nor do threads matter to rough lobes, skies, shadow photons and irradiance at photons",
     threads_do_not_matter_to_any_part})

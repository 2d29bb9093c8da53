// Pictures against a path tracer that knows nothing of maps, layer by layer: every class of
// paths is counted, and once.
#include "pictures.h"
#include "scenes.h"
#include "shapes.h"
#include "test.h"
#include "tiny_path_tracer.h"

/// What maps may be off by: discs that reach over edges, blurred caustics.
static const double map_slack = 0.015;

static pm_render_settings settings_of(uint32_t rays)
{
    pm_render_settings settings = pm_pictures_settings();
    settings.photons[PM_MAP_GLOBAL] = 60000;
    settings.photons[PM_MAP_CAUSTIC] = 30000;
    settings.light.rays = rays;
    settings.light.estimate.k = 20;
    return settings;
}

static void check_layer(pm_layer layer, const pm_pictures_means *got,
                        const pm_pictures_means *want, double slack)
{
    for (int c = 0; c < 3; c++) {
        double variance = got->variance[layer].c[c] + want->variance[layer].c[c];
        CHECK_CLOSE(pm_layer_name(layer), got->mean[layer].c[c], want->mean[layer].c[c],
                    variance, slack);
    }
}

static void check_layers(const pm_pictures_means *got, const pm_pictures_means *want)
{
    check_layer(PM_LAYER_EMISSION, got, want, 0.0);
    check_layer(PM_LAYER_DIRECT, got, want, 0.0);
    check_layer(PM_LAYER_SPECULAR, got, want, map_slack);
    check_layer(PM_LAYER_CAUSTIC, got, want, map_slack);
    check_layer(PM_LAYER_INDIRECT, got, want, map_slack);
    check_layer(PM_LAYER_VOLUME, got, want, 0.0);
}

/// A room with coloured walls, a mirror ball, a glass ball and a lamp that reflects.
static void room_begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    int white = pm_scenes_diffuse(s, pm_gray(0.7));
    int walls = pm_scenes_room(s, 1.0, white);
    s->shapes[walls].material[0] = pm_scenes_diffuse(s, pm_rgb(0.63, 0.06, 0.05));
    s->shapes[walls + 1].material[0] = pm_scenes_diffuse(s, pm_rgb(0.15, 0.48, 0.1));
    int lamp = pm_scenes_wear(s, pm_scenes_square(1.0, 0.95, true), white);
    pm_scenes_lamp(s, lamp, pm_rgb(2.0, 1.5, 1.0));
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(-0.45, 0.35, -0.6), 0.4),
                   pm_scenes_mirror(s, pm_gray(0.9)));
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.45, -0.1, -0.5), 0.4), pm_scenes_glass(s, 1.5));
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, -0.95, 0.1), pm_vec(0.0, 1.0, 0.0), 0.9, 20);
}

static void room_agrees(uint32_t rays)
{
    pm_scenes s;
    room_begin(&s);
    pm_pictures_means want = pm_tiny_trace(&s.world, 1000000);
    pm_pictures_means got = pm_pictures_repeat(&s, settings_of(rays), 6);
    check_layers(&got, &want);
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        CHECK(layer == PM_LAYER_VOLUME || want.mean[layer].c[0] > 0.0);
    }
    pm_scenes_free(&s);
}

static void room_with_the_map_seen_agrees(void)
{
    room_agrees(0);
}

static void room_with_gathering_agrees(void)
{
    room_agrees(8);
}

/// Checks a picture in which `only` is all there is.
static void check_only(const pm_scenes *s, pm_layer only, uint32_t rays)
{
    pm_pictures_means want = pm_tiny_trace(&s->world, 400000);
    pm_pictures_means got = pm_pictures_repeat(s, settings_of(rays), 6);
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        if (layer == (int)only) {
            CHECK(want.mean[layer].c[0] > 0.0);
            check_layer(only, &got, &want, map_slack);
        } else {
            CHECK_NEAR(want.mean[layer].c[0], 0.0, 0.0);
            CHECK_NEAR(got.mean[layer].c[0], 0.0, 0.0);
        }
    }
}

/// A floor, a lamp above it that faces down or up, and a lid above that.
static void stack_begin(pm_scenes *s, bool down, int lid)
{
    int floor = pm_scenes_diffuse(s, pm_gray(0.5));
    pm_scenes_wear(s, pm_scenes_square(2.0, 0.0, false), floor);
    int lamp = pm_scenes_wear(s, pm_scenes_square(1.0, 0.5, down), PM_NONE);
    pm_scenes_lamp(s, lamp, pm_gray(1.0));
    pm_scenes_wear(s, pm_scenes_square(6.0, 1.0, true), lid);
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, -1.2, 0.3), pm_vec(0.0, -0.5, 0.0), 0.3, 12);
}

static void lamps_alone_are_direct_light(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    stack_begin(&s, true, PM_NONE);
    check_only(&s, PM_LAYER_DIRECT, 8);
    pm_scenes_free(&s);
}

static void mirrored_lamps_are_caustics(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    stack_begin(&s, false, pm_scenes_mirror(&s, pm_gray(0.8)));
    pm_pictures_means want = pm_tiny_trace(&s.world, 400000);
    pm_pictures_means got = pm_pictures_repeat(&s, settings_of(8), 6);
    check_layers(&got, &want);
    CHECK(want.mean[PM_LAYER_CAUSTIC].c[0] > want.mean[PM_LAYER_INDIRECT].c[0]);
    CHECK_NEAR(got.mean[PM_LAYER_DIRECT].c[0], 0.0, 0.0);
    pm_scenes_free(&s);
}

static void light_off_the_ceiling_is_indirect(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    stack_begin(&s, false, pm_scenes_diffuse(&s, pm_gray(0.6)));
    check_only(&s, PM_LAYER_INDIRECT, 0);
    check_only(&s, PM_LAYER_INDIRECT, 16);
    pm_scenes_free(&s);
}

static void what_a_mirror_shows_is_specular(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    stack_begin(&s, true, pm_scenes_mirror(&s, pm_gray(0.8)));
    pm_pictures_look(&s, pm_vec(0.0, -0.9, 0.6), pm_vec(0.0, -0.7, 1.0), 0.3, 12);
    check_only(&s, PM_LAYER_SPECULAR, 0);
    check_only(&s, PM_LAYER_SPECULAR, 8);
    pm_scenes_free(&s);
}

/// A room with a plastic floor, a wall of rough metal whose lobe is D, a ball of one whose lobe
/// is S, and a table of rough plastic.
static void rough_room_begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    int white = pm_scenes_diffuse(s, pm_gray(0.5));
    int walls = pm_scenes_room(s, 1.0, white);
    pm_spectrum eta = pm_rgb(0.2, 0.9, 1.4);
    pm_spectrum k = pm_rgb(3.9, 2.5, 1.9);
    s->shapes[walls].material[0] = pm_scenes_rough_metal(s, eta, k, 0.3);
    s->shapes[walls + 4].material[0] = pm_scenes_plastic(s, pm_rgb(0.2, 0.4, 0.6), 1.5);
    int lamp = pm_scenes_wear(s, pm_scenes_square(1.6, 0.95, true), white);
    pm_scenes_lamp(s, lamp, pm_rgb(2.0, 1.5, 1.0));
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.3, 0.3, -0.3), 0.4),
                   pm_scenes_rough_metal(s, eta, k, 0.05));
    pm_scenes_wear(s, pm_scenes_square(0.8, -0.8, false),
                   pm_scenes_rough_plastic(s, pm_gray(0.5), 1.5, PM_MICROFACET_GGX, 0.2));
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.1, -0.95, 0.3), pm_vec(-0.1, 1.0, 0.0), 0.9, 20);
}

static void rough_room_agrees(uint32_t rays, bool caustics_global)
{
    pm_scenes s;
    rough_room_begin(&s);
    pm_pictures_means want = pm_tiny_trace(&s.world, 600000);
    pm_render_settings settings = settings_of(rays);
    settings.light.caustics_global = caustics_global;
    settings.light.spp = caustics_global ? 1 : 4; // marked photons are rare: slow to find
    pm_pictures_means got = pm_pictures_repeat(&s, settings, 6);
    check_layers(&got, &want);
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        CHECK(layer == PM_LAYER_VOLUME || want.mean[layer].c[0] > 0.0);
    }
    pm_scenes_free(&s);
}

static void rough_room_with_the_map_seen_agrees(void)
{
    rough_room_agrees(0, true);
}

static void rough_room_with_gathering_agrees(void)
{
    rough_room_agrees(8, false);
}

// No wall at all: what the floor and the balls do not stop is sky.
static void things_under_a_sky_agree(void)
{
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_sky(&s, pm_rgb(0.5, 0.7, 1.0));
    pm_scenes_wear(&s, pm_scenes_square(3.0, 0.0, false), pm_scenes_diffuse(&s, pm_gray(0.5)));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(-0.6, 0.2, 0.5), 0.4), pm_scenes_glass(&s, 1.5));
    pm_scenes_wear(&s, pm_shapes_sphere(pm_vec(0.6, 0.2, 0.5), 0.4),
                   pm_scenes_rough_mirror(&s, PM_MICROFACET_GGX, 0.08));
    pm_scenes_ready(&s);
    pm_pictures_look(&s, pm_vec(0.0, -1.6, 0.7), pm_vec(0.0, 0.2, 0.4), 0.7, 20);
    pm_pictures_means want = pm_tiny_trace(&s.world, 600000);
    pm_pictures_means got = pm_pictures_repeat(&s, settings_of(8), 6);
    check_layers(&got, &want);
    CHECK(want.mean[PM_LAYER_EMISSION].c[0] > 0.0);
    pm_scenes_free(&s);
}

PM_TESTS({"layers.1", "each layer of a room agrees with path tracing, the map seen directly",
          room_with_the_map_seen_agrees},
         {"layers.2", "each layer of a room agrees with path tracing, with a final gather",
          room_with_gathering_agrees},
         {"layers.3", "a lamp over a floor is direct light and nothing else",
          lamps_alone_are_direct_light},
         {"layers.4",
          "a lamp that only a mirror shows to a floor makes caustics, and no direct light",
          mirrored_lamps_are_caustics},
         {"layers.5", "a lamp that only lights the ceiling is indirect on the floor",
          light_off_the_ceiling_is_indirect},
         {"layers.6", "what a mirror shows is specular and nothing else",
          what_a_mirror_shows_is_specular},
         {"layers.7",
          "a room of rough metals and plastics agrees, its caustics from the global map",
          rough_room_with_the_map_seen_agrees},
         {"layers.8", "a room of rough metals and plastics agrees, with a final gather",
          rough_room_with_gathering_agrees},
         {"layers.9", "glass and a rough mirror under a constant light agree",
          things_under_a_sky_agree})

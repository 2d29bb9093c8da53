// Pictures with glass that disperses, before and behind diffuse walls: `render` against plain
// glass, and against the reference.
#include "prisms.h"

#include "references.h"
#include "shapes.h"
#include "test.h"

/// A room of unlike walls with a lamp and a ball of glass, and a block of it askew; `glass` is
/// NULL for plain glass of index 1.5.
static void glass_room(pm_scenes *s, const pm_glass *glass)
{
    pm_scenes_begin(s);
    int walls = pm_scenes_room(s, 1.0, pm_scenes_diffuse(s, pm_gray(0.6)));
    s->shapes[walls].material[0] = pm_scenes_diffuse(s, pm_rgb(0.63, 0.06, 0.05));
    s->shapes[walls + 1].material[0] = pm_scenes_diffuse(s, pm_rgb(0.15, 0.48, 0.1));
    int lamp = pm_scenes_add(s, pm_scenes_square(1.8, 0.95, true), walls, PM_NONE);
    pm_scenes_lamp(s, lamp, pm_rgb(2.0, 1.5, 1.0));
    int material = pm_scenes_glass(s, 1.5);
    s->materials[material].glass = glass;
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(-0.3, 0.2, -0.5), 0.4), material);
    pm_frame askew = pm_shapes_askew();
    pm_scenes_wear(s, pm_shapes_cube(&askew, pm_vec(0.3, -0.2, -0.1), 0.2), material);
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.1, -0.95, 0.1), pm_vec(0.0, 0.2, -0.2), 0.8, 12);
}

static pm_render_settings settings_of(uint32_t rays)
{
    pm_render_settings settings = pm_pictures_settings();
    settings.photons[PM_MAP_GLOBAL] = 8000;
    settings.photons[PM_MAP_CAUSTIC] = 8000;
    settings.light.rays = rays;
    // One radius for all: estimates by the k nearest see too much light where it is torn.
    settings.light.estimate.k = 2000;
    settings.light.estimate.radius = 0.06;
    return settings;
}

static void check_layers(const pm_pictures_means *got, const pm_pictures_means *want,
                         double slack)
{
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        for (int c = 0; c < 3; c++) {
            double variance = got->variance[layer].c[c] + want->variance[layer].c[c];
            CHECK_CLOSE(pm_layer_name((pm_layer)layer), got->mean[layer].c[c],
                        want->mean[layer].c[c], variance, slack);
        }
    }
}

static void pictures_without_dispersion_are_the_same(void)
{
    pm_scenes s;
    glass_room(&s, NULL);
    pm_pictures_means plain = pm_pictures_repeat(&s, settings_of(1), 6);
    pm_scenes_free(&s);
    glass_room(&s, &pm_prisms_even);
    pm_pictures_means even = pm_pictures_repeat(&s, settings_of(1), 6);
    pm_scenes_free(&s);
    check_layers(&even, &plain, 0.0);
    CHECK(plain.mean[PM_LAYER_SPECULAR].c[1] > 0.05 &&
          plain.mean[PM_LAYER_CAUSTIC].c[1] > 0.005);
}

static void render_is_the_reference(void)
{
    pm_scenes s;
    glass_room(&s, pm_glass_named("sf11"));
    pm_pictures_means want = pm_references_trace(&s, 768);
    pm_pictures_means got = pm_pictures_repeat(&s, settings_of(1), 6);
    check_layers(&got, &want, 0.015);
    pm_scenes_free(&s);
}

PM_TESTS({"dispersion.8", "a picture with glass of one index for all is that of plain glass",
          pictures_without_dispersion_are_the_same},
         {"dispersion.9",
          "with glass that disperses before and behind walls, each layer is "
          "the reference's",
          render_is_the_reference})

// Scenes of one class: what they are made of, and the check.
#include "classes.h"

#include "references.h"
#include "shapes.h"
#include "test.h"

pm_render_settings pm_classes_settings(uint32_t rays)
{
    pm_render_settings settings = pm_pictures_settings();
    settings.photons[PM_MAP_GLOBAL] = 15000;
    settings.photons[PM_MAP_CAUSTIC] = 30000;
    settings.light.rays = rays;
    settings.light.estimate.k = 20;
    return settings;
}

static void check_others(const pm_pictures_means *got, pm_layer only)
{
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        CHECK_THAT(layer == (int)only || pm_spectrum_is_black(got->mean[layer]),
                   "%s should be black, is %g", pm_layer_name((pm_layer)layer),
                   got->mean[layer].c[0]);
    }
}

/// The reference's answer. Sunlight that a mirror turned no eye path finds: it is traced from
/// the sun, by several seeds, whose scatter tells the variance.
static pm_pictures_means reference_of(const pm_scenes *s)
{
    if (s->scene.lights[0].type != PM_LIGHT_DIRECTIONAL) {
        return pm_references_trace(s, 128);
    }
    pm_reference_settings settings = pm_references_settings(16);
    settings.light_paths = 30000;
    return pm_references_repeat(s, settings, 8);
}

/// `got` within 5 sigma and `slack` of the closed form, or of the reference where `want` is
/// NULL.
static void check_lit(const char *what, const pm_pictures_means *got, pm_layer layer,
                      const pm_pictures_means *truth, const double *want, double slack)
{
    for (int c = 0; c < 3; c++) {
        double wanted = want != NULL ? want[c] : truth->mean[layer].c[c];
        double more = want != NULL ? 0.0 : truth->variance[layer].c[c];
        CHECK_THAT(wanted > 0.0, "%s should be lit", pm_layer_name(layer));
        CHECK_CLOSE(what, got->mean[layer].c[c], wanted, got->variance[layer].c[c] + more,
                    slack);
    }
}

void pm_classes_check(pm_scenes *s, pm_layer only, const double *want, double slack)
{
    pm_pictures_means truth = reference_of(s);
    check_others(&truth, only);
    check_lit("reference", &truth, only, &truth, want, PM_CLASSES_FLOAT);
    for (uint32_t rays = 0; rays <= 8; rays += 8) {
        pm_pictures_means got = pm_pictures_repeat(s, pm_classes_settings(rays), 6);
        check_others(&got, only);
        check_lit("render", &got, only, &truth, want, slack);
    }
    pm_scenes_free(s);
}

void pm_classes_lamp(pm_scenes *s, pm_shape shape)
{
    int lamp = pm_scenes_add(s, shape, PM_NONE, PM_NONE);
    pm_scenes_lamp(s, lamp, pm_rgb(2.0, 1.0, 0.5));
}

void pm_classes_floor(pm_scenes *s, double width, double albedo)
{
    pm_scenes_add(s, pm_scenes_square(width, 0.0, false), pm_scenes_diffuse(s, pm_gray(albedo)),
                  PM_NONE);
}

pm_shape pm_classes_lid(double low, double high, double z)
{
    return pm_shapes_rectangle(pm_vec(-0.6, low, z), pm_vec(0.0, high - low, 0.0),
                               pm_vec(1.2, 0.0, 0.0));
}

void pm_classes_look_down(pm_scenes *s, double half)
{
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, 0.0, 0.5), pm_vec(0.0, 0.0, 0.0), half / 0.5, 4);
}

void pm_classes_upright_mirror(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_shape mirror = pm_shapes_rectangle(pm_vec(-2.0, 2.0, 0.0), pm_vec(4.0, 0.0, 0.0),
                                          pm_vec(0.0, 0.0, 3.0));
    pm_scenes_add(s, mirror, pm_scenes_mirror(s, pm_gray(PM_CLASSES_MIRRORED)), PM_NONE);
}

void pm_classes_look_at_the_image(pm_scenes *s)
{
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, 1.0, 1.5), pm_vec(0.0, 4.0, 0.0), 0.05, 4);
}

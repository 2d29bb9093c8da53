// Small pictures of scenes made by hand.
#include "pictures.h"

#include "test.h"

#include <omp.h>
#include <stdio.h>
#include <string.h>

void pm_pictures_look(pm_scenes *s, pm_vec3 from, pm_vec3 to, double tangent, int size)
{
    pm_vec3 forward = pm_vec_normalize(pm_vec_sub(to, from));
    bool upright = fabs(forward.z) < 0.999;
    pm_vec3 above = upright ? pm_vec(0.0, 0.0, 1.0) : pm_vec(0.0, 1.0, 0.0);
    pm_vec3 right = pm_vec_normalize(pm_vec_cross(forward, above));
    s->scene.has_camera = true;
    s->scene.camera = (pm_camera){
        .position = from,
        .right = right,
        .up = pm_vec_cross(right, forward),
        .forward = forward,
        .tan_x = tangent,
        .tan_y = tangent,
        .width = size,
        .height = size,
        .medium = PM_NONE,
    };
}

pm_vertex pm_pictures_meet(const pm_scenes *s, pm_vec3 from, pm_vec3 direction)
{
    pm_ray ray = {from, direction, HUGE_VAL, 0.0, PM_NONE};
    pm_vertex at = {.vertex = 1, .from = from};
    CHECK(pm_closest(&s->world, &ray, &at.hit));
    pm_material_lobes(&s->scene, &at.hit, &ray, &at.lobes);
    return at;
}

pm_render_settings pm_pictures_settings(void)
{
    pm_render_settings settings = pm_render_defaults();
    settings.photons[PM_MAP_GLOBAL] = 20000;
    settings.photons[PM_MAP_CAUSTIC] = 20000;
    settings.light.rays = 0;
    return settings;
}

pm_image pm_pictures_take(const pm_scenes *s, const pm_render_settings *settings)
{
    pm_render_maps maps = {0};
    pm_image image = {0};
    pm_eye_report report;
    CHECK_OK(pm_render_make_maps(&s->world, settings, &maps));
    CHECK_OK(pm_render_image(&s->world, settings, &maps, &image, &report));
    pm_render_maps_free(&maps);
    return image;
}

static const float *plane_of(const pm_image *image, const char *channel)
{
    const float *plane = pm_image_plane(image, channel);
    CHECK_THAT(plane != NULL, "the picture has no channel %s", channel);
    return plane;
}

double pm_pictures_at(const pm_image *image, const char *channel, int x, int y)
{
    return (double)plane_of(image, channel)[y * image->width + x];
}

double pm_pictures_mean(const pm_image *image, const char *channel)
{
    const float *plane = plane_of(image, channel);
    int count = image->width * image->height;
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        sum += (double)plane[i];
    }
    return sum / count;
}

pm_spectrum pm_pictures_layer(const pm_image *image, pm_layer layer)
{
    static const char letters[3] = "RGB";
    pm_spectrum mean;
    for (int c = 0; c < 3; c++) {
        char name[32];
        snprintf(name, sizeof name, "%s.%c", pm_layer_name(layer), letters[c]);
        mean.c[c] = pm_pictures_mean(image, name);
    }
    return mean;
}

void pm_pictures_add(pm_pictures_means *sums, const pm_spectrum layer[PM_LAYER_COUNT])
{
    for (int l = 0; l < PM_LAYER_COUNT; l++) {
        pm_spectrum square = pm_spectrum_mul(layer[l], layer[l]);
        sums->mean[l] = pm_spectrum_add(sums->mean[l], layer[l]);
        sums->variance[l] = pm_spectrum_add(sums->variance[l], square);
    }
}

void pm_pictures_finish(pm_pictures_means *sums, double count)
{
    for (int l = 0; l < PM_LAYER_COUNT; l++) {
        for (int c = 0; c < 3; c++) {
            double mean = sums->mean[l].c[c] / count;
            double spread = fmax(0.0, sums->variance[l].c[c] / count - mean * mean);
            sums->mean[l].c[c] = mean;
            sums->variance[l].c[c] = spread / (count - 1.0);
        }
    }
}

pm_pictures_means pm_pictures_repeat(const pm_scenes *s, pm_render_settings settings,
                                     uint32_t runs)
{
    pm_pictures_means means = {0};
    omp_set_num_threads(1); // the runner keeps the other cores busy
    for (settings.seed = 1; settings.seed <= runs; settings.seed++) {
        pm_image image = pm_pictures_take(s, &settings);
        pm_spectrum layer[PM_LAYER_COUNT];
        for (int l = 0; l < PM_LAYER_COUNT; l++) {
            layer[l] = pm_pictures_layer(&image, (pm_layer)l);
        }
        pm_pictures_add(&means, layer);
        pm_image_free(&image);
    }
    pm_pictures_finish(&means, (double)runs);
    return means;
}

void pm_pictures_close(const char *file, int line, const char *what, double got, double want,
                       double variance, double slack)
{
    double bound = 5.0 * sqrt(variance) + slack * fabs(want);
    if (!(fabs(got - want) <= bound)) {
        pm_test_fail(file, line, "%s: got %.9g, want %.9g, within %.3g (5 sigma = %.3g)", what,
                     got, want, bound, 5.0 * sqrt(variance));
    }
}

static bool is_among(const char *name, const char *const *names)
{
    for (; names != NULL && *names != NULL; names++) {
        if (strcmp(name, *names) == 0) {
            return true;
        }
    }
    return false;
}

void pm_pictures_same(const char *file, int line, const pm_image *got, const pm_image *want,
                      double factor, const char *const *but)
{
    int pixels = want->width * want->height;
    for (int c = 0; c < want->channel_count; c++) {
        const float *other = plane_of(got, want->name[c]);
        for (int i = 0; i < pixels && !is_among(want->name[c], but); i++) {
            float expected = (float)((double)want->plane[c][i] * factor);
            if (memcmp(&other[i], &expected, sizeof expected) != 0) {
                pm_test_fail(file, line, "%s differs at (%d, %d): got %.9g, want %.9g",
                             want->name[c], i % want->width, i / want->width, (double)other[i],
                             (double)expected);
            }
        }
    }
}

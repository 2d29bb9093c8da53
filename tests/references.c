// A variance from halves: with whole = (h1 + h2) / 2, (h1 - h2)^2 / 4 estimates its variance.
#include "references.h"

#include "shapes.h"
#include "test.h"

#include <omp.h>
#include <stdio.h>

pm_reference_settings pm_references_settings(uint32_t spp)
{
    pm_reference_settings settings = pm_reference_defaults();
    settings.spp = spp;
    return settings;
}

pm_image pm_references_take(const pm_scenes *s, const pm_reference_settings *settings,
                            pm_reference_report *report)
{
    pm_image image = {0};
    pm_reference_report unread;
    CHECK_OK(
        pm_reference_image(&s->world, settings, &image, report != NULL ? report : &unread));
    return image;
}

static const float *plane_of(const pm_image *image, const char *prefix, pm_layer layer, int c)
{
    char name[PM_IMAGE_NAME_ROOM];
    snprintf(name, sizeof name, "%s%s.%c", prefix, pm_layer_name(layer), "RGB"[c]);
    const float *plane = pm_image_plane(image, name);
    CHECK_THAT(plane != NULL, "the picture has no channel %s", name);
    return plane;
}

pm_pictures_means pm_references_means(const pm_image *image)
{
    pm_pictures_means means;
    int pixels = image->width * image->height;
    for (int layer = 0; layer < PM_LAYER_COUNT; layer++) {
        for (int c = 0; c < 3; c++) {
            const float *one = plane_of(image, "half1.", (pm_layer)layer, c);
            const float *two = plane_of(image, "half2.", (pm_layer)layer, c);
            double sum = 0.0;
            double squares = 0.0;
            for (int i = 0; i < pixels; i++) {
                double difference = (double)one[i] - (double)two[i];
                sum += 0.5 * ((double)one[i] + (double)two[i]);
                squares += 0.25 * difference * difference;
            }
            means.mean[layer].c[c] = sum / pixels;
            means.variance[layer].c[c] = squares / pixels / pixels;
        }
    }
    return means;
}

pm_pictures_means pm_references_trace(const pm_scenes *s, uint32_t spp)
{
    omp_set_num_threads(1); // the runner keeps the other cores busy
    pm_reference_settings settings = pm_references_settings(spp);
    pm_image image = pm_references_take(s, &settings, NULL);
    pm_pictures_means means = pm_references_means(&image);
    pm_image_free(&image);
    return means;
}

pm_pictures_means pm_references_repeat(const pm_scenes *s, pm_reference_settings settings,
                                       uint32_t runs)
{
    pm_pictures_means means = {0};
    omp_set_num_threads(1); // the runner keeps the other cores busy
    for (settings.seed = 1; settings.seed <= runs; settings.seed++) {
        pm_image image = pm_references_take(s, &settings, NULL);
        pm_pictures_means one = pm_references_means(&image);
        pm_pictures_add(&means, one.mean);
        pm_image_free(&image);
    }
    pm_pictures_finish(&means, (double)runs);
    return means;
}

void pm_references_agree(pm_layer layer, const pm_pictures_means *got,
                         const pm_pictures_means *want)
{
    for (int c = 0; c < 3; c++) {
        double variance = got->variance[layer].c[c] + want->variance[layer].c[c];
        CHECK_CLOSE(pm_layer_name(layer), got->mean[layer].c[c], want->mean[layer].c[c],
                    variance, 0.0);
    }
}

int pm_references_room(pm_scenes *s, bool shines)
{
    pm_scenes_begin(s);
    int white = pm_scenes_diffuse(s, pm_gray(0.6));
    int walls = pm_scenes_room(s, 1.0, white);
    s->shapes[walls].material[0] = pm_scenes_diffuse(s, pm_rgb(0.63, 0.06, 0.05));
    s->shapes[walls + 1].material[0] = pm_scenes_diffuse(s, pm_rgb(0.15, 0.48, 0.1));
    int lamp = pm_scenes_wear(s, pm_scenes_square(1.0, 0.95, true), white);
    if (shines) {
        pm_scenes_lamp(s, lamp, pm_rgb(2.0, 1.5, 1.0));
    }
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(-0.45, 0.35, -0.6), 0.4),
                   pm_scenes_mirror(s, pm_gray(0.9)));
    pm_scenes_wear(s, pm_shapes_sphere(pm_vec(0.45, -0.1, -0.5), 0.4), pm_scenes_glass(s, 1.5));
    return lamp;
}

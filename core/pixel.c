// Layers are rounded to float first and then added, so that the file's layers add up to its R G
// B.
#include "pixel.h"

#include <stdio.h>

static const char *const channel[3] = {"R", "G", "B"};
static const char *const axis[3] = {"normal.X", "normal.Y", "normal.Z"};
static const char *const half_prefix[2] = {"half1.", "half2."};

/// Names of channels, before there is an image.
typedef struct {
    char text[PM_IMAGE_CHANNELS_MAX][PM_IMAGE_NAME_ROOM];
    const char *name[PM_IMAGE_CHANNELS_MAX];
    int count;
} pm_names;

static void add_name(pm_names *names, const char *prefix, const char *layer, const char *name)
{
    char *text = names->text[names->count];
    snprintf(text, PM_IMAGE_NAME_ROOM, "%s%s%s%s", prefix, layer, layer[0] == '\0' ? "" : ".",
             name);
    names->name[names->count++] = text;
}

static void add_light(pm_names *names, const char *prefix)
{
    for (int c = 0; c < 3; c++) {
        add_name(names, prefix, "", channel[c]);
    }
    for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
        for (int c = 0; c < 3; c++) {
            add_name(names, prefix, pm_layer_name(layer), channel[c]);
        }
    }
}

static void add_surface(pm_names *names)
{
    add_name(names, "", "", "depth.Z");
    for (int c = 0; c < 3; c++) {
        add_name(names, "", "", axis[c]);
    }
}

pm_status pm_picture_make(int width, int height, pm_image *image)
{
    pm_names names = {.count = 0};
    add_light(&names, "");
    add_surface(&names);
    add_name(&names, "", "", "gather.radius");
    add_name(&names, "", "", "gather.count");
    add_name(&names, "", "", "mask.emitter");
    return pm_image_make(width, height, names.name, names.count, image);
}

pm_status pm_picture_make_halved(int width, int height, pm_image *image)
{
    pm_names names = {.count = 0};
    add_light(&names, "");
    add_surface(&names);
    add_name(&names, "", "", "mask.emitter");
    for (int half = 0; half < 2; half++) {
        add_light(&names, half_prefix[half]);
    }
    return pm_image_make(width, height, names.name, names.count, image);
}

static void find_light(const pm_image *image, const char *prefix, pm_picture *picture)
{
    for (int c = 0; c < 3; c++) {
        pm_names names = {.count = 0};
        add_name(&names, prefix, "", channel[c]);
        picture->total[c] = pm_image_plane(image, names.name[0]);
        for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
            names.count = 0;
            add_name(&names, prefix, pm_layer_name(layer), channel[c]);
            picture->layer[layer][c] = pm_image_plane(image, names.name[0]);
        }
    }
}

pm_picture pm_picture_planes(const pm_image *image)
{
    pm_picture picture = {0};
    find_light(image, "", &picture);
    for (int c = 0; c < 3; c++) {
        picture.normal[c] = pm_image_plane(image, axis[c]);
    }
    picture.depth = pm_image_plane(image, "depth.Z");
    picture.radius = pm_image_plane(image, "gather.radius");
    picture.count = pm_image_plane(image, "gather.count");
    picture.emitter = pm_image_plane(image, "mask.emitter");
    return picture;
}

pm_picture pm_picture_half(const pm_image *image, int half)
{
    pm_picture picture = {0};
    find_light(image, half_prefix[half], &picture);
    return picture;
}

static void set(float *plane, size_t index, double value)
{
    if (plane != NULL) {
        plane[index] = (float)value;
    }
}

static void set_total(const pm_picture *picture, size_t index)
{
    for (int c = 0; c < 3; c++) {
        double sum = 0.0;
        for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
            sum += (double)picture->layer[layer][c][index];
        }
        picture->total[c][index] = (float)sum;
    }
}

void pm_picture_set(const pm_picture *picture, size_t index, const pm_pixel *pixel)
{
    const double normal[3] = {pixel->normal.x, pixel->normal.y, pixel->normal.z};
    for (int c = 0; c < 3; c++) {
        for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
            set(picture->layer[layer][c], index, pixel->layer[layer].c[c]);
        }
        set(picture->normal[c], index, normal[c]);
    }
    set_total(picture, index);
    set(picture->depth, index, pixel->depth);
    set(picture->radius, index, pixel->radius);
    set(picture->count, index, pixel->count);
    set(picture->emitter, index, pixel->emitter ? 1.0 : 0.0);
}

void pm_picture_join(const pm_picture *whole, const pm_picture half[2], size_t pixels)
{
    for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
        for (int c = 0; c < 3; c++) {
            const float *one = half[0].layer[layer][c];
            const float *two = half[1].layer[layer][c];
            for (size_t i = 0; i < pixels; i++) {
                set(whole->layer[layer][c], i, 0.5 * ((double)one[i] + (double)two[i]));
            }
        }
    }
    for (size_t i = 0; i < pixels; i++) {
        set_total(whole, i);
        set_total(&half[0], i);
        set_total(&half[1], i);
    }
}

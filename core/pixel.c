// Layers are rounded to float first and then added, so that the file's layers add up to its R G
// B.
#include "pixel.h"

#include <stdio.h>

static const char *const channel[3] = {"R", "G", "B"};
static const char *const axis[3] = {"normal.X", "normal.Y", "normal.Z"};

enum { NAME_ROOM = 32, LAYER_CHANNELS = 3 * PM_LAYER_COUNT };

static void layer_channel(pm_layer layer, int c, char name[NAME_ROOM])
{
    snprintf(name, NAME_ROOM, "%s.%s", pm_layer_name(layer), channel[c]);
}

pm_status pm_picture_make(int width, int height, pm_image *image)
{
    char layers[LAYER_CHANNELS][NAME_ROOM];
    const char *names[3 + LAYER_CHANNELS + 7];
    int count = 0;
    for (int c = 0; c < 3; c++) {
        names[count++] = channel[c];
    }
    for (int i = 0; i < LAYER_CHANNELS; i++) {
        layer_channel((pm_layer)(i / 3), i % 3, layers[i]);
        names[count++] = layers[i];
    }
    names[count++] = "depth.Z";
    for (int c = 0; c < 3; c++) {
        names[count++] = axis[c];
    }
    names[count++] = "gather.radius";
    names[count++] = "gather.count";
    names[count++] = "mask.emitter";
    return pm_image_make(width, height, names, count, image);
}

pm_picture pm_picture_planes(const pm_image *image)
{
    pm_picture picture;
    for (int c = 0; c < 3; c++) {
        picture.total[c] = pm_image_plane(image, channel[c]);
        picture.normal[c] = pm_image_plane(image, axis[c]);
        for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
            char name[NAME_ROOM];
            layer_channel(layer, c, name);
            picture.layer[layer][c] = pm_image_plane(image, name);
        }
    }
    picture.depth = pm_image_plane(image, "depth.Z");
    picture.radius = pm_image_plane(image, "gather.radius");
    picture.count = pm_image_plane(image, "gather.count");
    picture.emitter = pm_image_plane(image, "mask.emitter");
    return picture;
}

void pm_picture_set(const pm_picture *picture, size_t index, const pm_pixel *pixel)
{
    for (int c = 0; c < 3; c++) {
        double sum = 0.0;
        for (pm_layer layer = 0; layer < PM_LAYER_COUNT; layer++) {
            float value = (float)pixel->layer[layer].c[c];
            picture->layer[layer][c][index] = value;
            sum += (double)value;
        }
        picture->total[c][index] = (float)sum;
    }
    picture->depth[index] = (float)pixel->depth;
    picture->normal[0][index] = (float)pixel->normal.x;
    picture->normal[1][index] = (float)pixel->normal.y;
    picture->normal[2][index] = (float)pixel->normal.z;
    picture->radius[index] = (float)pixel->radius;
    picture->count[index] = (float)pixel->count;
    picture->emitter[index] = pixel->emitter ? 1.0f : 0.0f;
}

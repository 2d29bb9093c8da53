// Planes are allocated one by one, so that a channel is a plain pointer.
#include "image.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define SIDE_MAX 65536

static pm_status check_names(const char *const *names, int count)
{
    if (count < 0 || count > PM_IMAGE_CHANNELS_MAX) {
        return PM_FAIL(PM_EINPUT, "an image has 0 to %d channels, got %d",
                       PM_IMAGE_CHANNELS_MAX, count);
    }
    for (int i = 0; i < count; i++) {
        size_t length = strlen(names[i]);
        if (length == 0 || length >= PM_IMAGE_NAME_ROOM) {
            return PM_FAIL(PM_EINPUT, "a channel name has 1 to 31 letters, got \"%s\"",
                           names[i]);
        }
        for (int j = 0; j < i; j++) {
            if (strcmp(names[i], names[j]) == 0) {
                return PM_FAIL(PM_EINPUT, "channel \"%s\" is there twice", names[i]);
            }
        }
    }
    return PM_OK;
}

static bool add_plane(pm_image *image, const char *name)
{
    size_t pixels = (size_t)image->width * (size_t)image->height;
    int channel = image->channel_count++;
    strcpy(image->name[channel], name);
    // pm_image_free() gives it back, which the analyzer loses sight of.
    image->plane[channel] = calloc(pixels, sizeof(float)); // NOLINT(clang-analyzer-unix.Malloc)
    return image->plane[channel] != NULL;
}

pm_status pm_image_make(int width, int height, const char *const *names, int count,
                        pm_image *out)
{
    if (width < 1 || height < 1 || width > SIDE_MAX || height > SIDE_MAX) {
        return PM_FAIL(PM_EINPUT, "an image is 1 to %d pixels wide and high, got %dx%d",
                       SIDE_MAX, width, height);
    }
    PM_TRY(check_names(names, count));
    pm_image image = {.width = width, .height = height};
    bool made = true;
    for (int i = 0; i < count && made; i++) {
        made = add_plane(&image, names[i]);
    }
    if (!made) {
        pm_image_free(&image);
        return PM_FAIL(PM_ENOMEM, "no memory for an image of %dx%d with %d channels", width,
                       height, count);
    }
    *out = image;
    return PM_OK;
}

void pm_image_free(pm_image *image)
{
    for (int i = 0; i < image->channel_count; i++) {
        free(image->plane[i]);
    }
    *image = (pm_image){0};
}

float *pm_image_plane(const pm_image *image, const char *name)
{
    for (int i = 0; i < image->channel_count; i++) {
        if (strcmp(image->name[i], name) == 0) {
            return image->plane[i];
        }
    }
    return NULL;
}

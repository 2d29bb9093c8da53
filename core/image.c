// Planes are allocated one by one, so that a channel is a plain pointer.
#include "image.h"

#include <stdlib.h>
#include <string.h>

#define SIDE_MAX 65536

static pm_status check_names(const char *const *names, int count)
{
    if (count < 0 || count > PM_IMAGE_CHANNELS_MAX) {
        return PM_FAIL(PM_EINPUT, "an image has 0 to %d channels, got %d",
                       PM_IMAGE_CHANNELS_MAX, count);
    }
    pm_image known = {0};
    for (int i = 0; i < count; i++) {
        size_t length = strlen(names[i]);
        if (length == 0 || length >= sizeof known.name[0]) {
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

pm_status pm_image_make(int width, int height, const char *const *names, int count,
                        pm_image *out)
{
    if (width < 1 || height < 1 || width > SIDE_MAX || height > SIDE_MAX) {
        return PM_FAIL(PM_EINPUT, "an image is 1 to %d pixels wide and high, got %dx%d",
                       SIDE_MAX, width, height);
    }
    PM_TRY(check_names(names, count));
    pm_image image = {.width = width, .height = height};
    for (int i = 0; i < count; i++) {
        strcpy(image.name[i], names[i]);
        image.plane[i] = calloc((size_t)width * (size_t)height, sizeof(float));
        if (image.plane[i] == NULL) {
            pm_image_free(&image);
            return PM_FAIL(PM_ENOMEM, "no memory for an image of %dx%d with %d channels", width,
                           height, count);
        }
        image.channel_count++;
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

// A picture as named planes of float, before it becomes a file.
#ifndef PM_IMAGE_H
#define PM_IMAGE_H

#include "spectrum.h"
#include "status.h"

#include <stdint.h>

#define PM_IMAGE_CHANNELS_MAX 96
#define PM_IMAGE_NAME_ROOM 32 // bytes, with the final zero

/// Channels are named as in the EXR file ("R", "caustic.R", "depth.Z"). Each is width * height
/// floats, rows from the top.
typedef struct {
    int width, height;
    int channel_count;
    char name[PM_IMAGE_CHANNELS_MAX][PM_IMAGE_NAME_ROOM];
    float *plane[PM_IMAGE_CHANNELS_MAX];
} pm_image;

/// An image of black planes. Free with pm_image_free().
/// @param names  `count` channel names
/// @return PM_EINPUT for a size below 1 or above 65536, PM_ENOMEM
pm_status pm_image_make(int width, int height, const char *const *names, int count,
                        pm_image *out);
void pm_image_free(pm_image *image);

/// The plane of a channel, or NULL when the image has none of that name.
float *pm_image_plane(const pm_image *image, const char *name);

#endif

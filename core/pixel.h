// The channels of a rendered picture, and putting one pixel into them.
#ifndef PM_PIXEL_H
#define PM_PIXEL_H

#include "image.h"
#include "layer.h"
#include "vec.h"

#include <stddef.h>

/// Planes of a rendered picture by meaning; they point into the image.
typedef struct {
    float *total[3];
    float *layer[PM_LAYER_COUNT][3];
    float *depth;
    float *normal[3];
    float *radius, *count;
    float *emitter;
} pm_picture;

/// What one pixel shows.
typedef struct {
    pm_spectrum layer[PM_LAYER_COUNT];
    double depth;
    pm_vec3 normal;
    double radius, count;
    bool emitter;
} pm_pixel;

/// A black picture with every channel of pm_render_image().
pm_status pm_picture_make(int width, int height, pm_image *image);

/// The planes of an image that pm_picture_make() made.
pm_picture pm_picture_planes(const pm_image *image);

/// Writes a pixel; R G B becomes the sum of the layers as they are stored.
void pm_picture_set(const pm_picture *picture, size_t index, const pm_pixel *pixel);

#endif

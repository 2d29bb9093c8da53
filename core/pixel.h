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

/// A black picture with every channel of pm_reference_image().
pm_status pm_picture_make_halved(int width, int height, pm_image *image);

/// The planes of an image that one of these made; those that it lacks are NULL.
pm_picture pm_picture_planes(const pm_image *image);

/// R G B and the layers of the first (0) or second (1) half; the rest is NULL.
pm_picture pm_picture_half(const pm_image *image, int half);

/// Writes a pixel into the planes that there are; R G B becomes the sum of the layers as they
/// are stored.
void pm_picture_set(const pm_picture *picture, size_t index, const pm_pixel *pixel);

/// Sets the layers of the whole to the mean of its halves, and R G B of all three to the sums
/// of their layers.
void pm_picture_join(const pm_picture *whole, const pm_picture half[2], size_t pixels);

#endif

// Pictures ready to be laid on a page, pixel for pixel or by whole factors: every pixel of a
// render stays a square, and no filter makes noise look smoother than it is.
#ifndef PM_PLATE_H
#define PM_PLATE_H

#include "image.h"
#include "status.h"

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// 8-bit sRGB, rows from the top. Free with pm_plate_free().
typedef struct {
    int width, height;
    uint8_t *pixels;
} pm_plate;

/// The largest zoom at which a picture fits its room. A zoom n >= 1 makes n x n squares of
/// pixels; -n, n >= 2, makes a pixel of n x n (fewer at the right and at the bottom).
int pm_plate_fit(int width, int height, int room_width, int room_height);

/// How long a side of `length` pixels is at a zoom.
int pm_plate_length(int length, int zoom);

/// A zoom in words: "3x", "1/2".
/// @param text  [out] room for `room` bytes; also returned
const char *pm_plate_zoom_text(int zoom, char *text, size_t room);

/// A black one.
/// @param plate  [out] untouched unless PM_OK
pm_status pm_plate_make(int width, int height, pm_plate *plate);

/// R G B of an image as pm_png_pixels() shows them.
/// @param name   of the image, for messages
/// @param plate  [out] untouched unless PM_OK
pm_status pm_plate_of(const char *name, const pm_image *image, double exposure,
                      pm_plate *plate);

/// Makes it larger or smaller. Pixels that become one are meant in linear light.
/// @param plate  [in, out] as it was unless PM_OK
pm_status pm_plate_zoom(pm_plate *plate, int zoom);

void pm_plate_free(pm_plate *plate);

#ifdef __cplusplus
}
#endif
#endif

// Pictures for looking at: 8-bit sRGB PNG.
#ifndef PM_PNG_H
#define PM_PNG_H

#include "image.h"

/// Writes R G B of `image` times 2^exposure, clipped to [0, 1], with the sRGB curve.
/// Writes beside `path` and renames.
pm_status pm_png_write(const char *path, const pm_image *image, double exposure);

/// The same pixels without a file.
/// @param name    of the picture, for messages
/// @param pixels  [out] width * height * 3 bytes, rows from the top
/// @return PM_EINPUT when a channel is missing or a value is NaN
pm_status pm_png_pixels(const char *name, const pm_image *image, double exposure,
                        uint8_t *pixels);

/// Writes 8-bit pixels as they are: width * height * 3 bytes, rows from the top.
pm_status pm_png_write_bytes(const char *path, const uint8_t *pixels, int width, int height);

#endif

// Pictures and films as WebP: a tenth of a PNG's bytes, not exact.
#ifndef PM_WEBP_H
#define PM_WEBP_H

#include "status.h"

#include <stddef.h>
#include <stdint.h>

/// Writes 8-bit sRGB pixels (width * height * 3 bytes, rows from the top), lossy. Writes beside
/// `path` and renames.
/// @return PM_EINPUT beyond 16383 pixels a side; PM_EIO; PM_ENOMEM
pm_status pm_webp_write_bytes(const char *path, const uint8_t *pixels, int width, int height);

/// A film that is being put together, in memory.
typedef struct pm_webp_film pm_webp_film;

/// @param film  [out] free with pm_webp_film_close()
pm_status pm_webp_film_open(int width, int height, pm_webp_film **film);

/// Adds a frame of the film's size that is seen for `milliseconds`.
pm_status pm_webp_film_add(pm_webp_film *film, const uint8_t *pixels, int milliseconds);

/// Ends the film, which then plays again and again.
/// @param bytes  [out] the file's content; free()
pm_status pm_webp_film_bytes(pm_webp_film *film, uint8_t **bytes, size_t *size);

/// Frees; NULL is fine.
void pm_webp_film_close(pm_webp_film *film);

#endif

// A film and its frames as files: one animated WebP, and a numbered PNG for each frame beside
// it.
#ifndef PM_FILM_H
#define PM_FILM_H

#include "status.h"

#include <stdint.h>

typedef struct pm_film pm_film;

/// Begins a film of `frames` frames. Nothing is written before pm_film_write().
/// @param path  must end in .webp; "a/film.webp" has the frames "a/film.001.png" and so on
/// @param film  [out] free with pm_film_close()
/// @return PM_EINPUT for another ending; PM_EIO where one of the files could not be written
pm_status pm_film_open(const char *path, int width, int height, uint32_t frames,
                       pm_film **film);

/// Adds the next frame: width * height * 3 bytes, rows from the top. Every frame is seen for a
/// tenth of a second, the last for three seconds.
pm_status pm_film_add(pm_film *film, const uint8_t *pixels);

/// Writes all files; when one of them fails, those written before it are removed.
pm_status pm_film_write(pm_film *film);

/// Frees; NULL is fine.
void pm_film_close(pm_film *film);

#endif

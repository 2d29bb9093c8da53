// Films that light paths make, and what they show on average. Calls that fail end the running
// test.
#ifndef PM_FILMS_H
#define PM_FILMS_H

#include "light_tracer.h"
#include "pictures.h"

/// Films of two independent passes; free with pm_films_free().
typedef struct {
    pm_spectrum *half[2];
    int pixels;
} pm_film_pair;

/// `count` paths of seed 1, pass 0.
pm_light_tracing pm_films_tracing(const pm_scenes *s, uint64_t count, bool everything);

/// Traces `count` paths in each pass.
pm_film_pair pm_films_of(const pm_scenes *s, uint64_t count, bool everything);

void pm_films_free(pm_film_pair *films);

/// Means over the pixels with marks[i] == mark (all where `marks` is NULL). The variance comes
/// from the scatter of the halves over pixels, which light paths hit independently but for the
/// few that hit several.
pm_pictures_means pm_films_means(const pm_film_pair *films, const int *marks, int mark);

/// Means over the whole film of `runs` passes, whose scatter tells the variance: in fog one
/// path is seen by many pixels.
pm_pictures_means pm_films_repeat(const pm_scenes *s, uint64_t count, uint32_t runs);

#endif

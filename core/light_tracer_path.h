// One path from a light, and what it adds to the film along the way.
#ifndef PM_LIGHT_TRACER_PATH_H
#define PM_LIGHT_TRACER_PATH_H

#include "light_tracer.h"

#include <stddef.h>

/// What one connection to the camera adds.
typedef struct {
    size_t place; // in the film
    pm_spectrum radiance;
} pm_splat;

/// Connections of several paths, in their order. Zero-initialised: none; free `splat`.
typedef struct {
    pm_splat *splat;
    size_t count, room;
    uint64_t cut; // paths ended by a cap
} pm_splats;

/// Follows one path.
///
/// @param per_film  1 over all paths times the area of a pixel at distance 1
/// @param splats    [in, out] the path's connections are added
/// @return PM_ENOMEM
pm_status pm_light_tracer_path(const pm_light_tracing *tracing, double per_film,
                               const pm_start *start, pm_splats *splats);

#endif

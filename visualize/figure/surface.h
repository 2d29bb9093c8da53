// The scene's surface behind a pixel.
#ifndef PM_SURFACE_H
#define PM_SURFACE_H

#ifdef __cplusplus
#include "core.hh" // before any header of core
#endif

#include "scene.h"
#include "status.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    bool found;
    pm_vec3 at;     // [m] centred
    pm_vec3 normal; // unit, towards who looks
    const char *id; // of the shape
} pm_surface;

/// The nearest surface along a ray that has something on the side it shows: backs of one-sided
/// walls, which only absorb, are looked through.
/// @param from     [m] centred
/// @param forward  unit
/// @param surface  [out] untouched unless PM_OK; nothing met is PM_OK, too
pm_status pm_surface_find(const pm_scene *scene, pm_vec3 from, pm_vec3 forward,
                          pm_surface *surface);

#ifdef __cplusplus
}
#endif
#endif

// Reading rays that leave the lights, as emission --dump writes them.
#ifndef PM_RAY_FILE_H
#define PM_RAY_FILE_H

#include "scene.h"
#include "status.h"

#include <stdint.h>

/// A photon as it starts, in centred world space.
typedef struct {
    pm_vec3 origin;
    pm_vec3 direction; // unit
    pm_spectrum power; // [W]
    uint32_t light;    // index into scene->lights
} pm_ray_start;

/// Freed by pm_ray_file_free().
typedef struct {
    pm_ray_start *rays;
    uint64_t count; // at least 1
} pm_ray_set;

/// Reads all rays of a file.
/// @param scene  that they were emitted in
/// @param rays   [out] untouched unless PM_OK
/// @return PM_EINPUT with file:line: powers below 0, directions that are no unit vectors,
/// starts
///         far outside or lights that the scene does not have, no ray at all; PM_EIO, PM_ENOMEM
pm_status pm_ray_file_read(const char *path, const pm_scene *scene, pm_ray_set *rays);
void pm_ray_file_free(pm_ray_set *rays);

#endif

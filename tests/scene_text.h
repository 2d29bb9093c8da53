// Scenes written in a test: what stands between <scene> and </scene>, read by the real reader.
#ifndef PM_SCENE_TEXT_H
#define PM_SCENE_TEXT_H

#include "intersect.h"
#include "scene_read.h"

/// Writes `text` to the file `name` in the test's folder. The path is valid until the next
/// call.
const char *pm_scene_text_write(const char *name, const char *text);

/// Reads a scene with this body (printf) and a point light.
#if defined(__GNUC__)
__attribute__((format(printf, 2, 3)))
#endif
pm_status
pm_scene_text_read(pm_scene *scene, const char *format, ...);

/// The shape that a ray meets first; fails the test when it meets none.
int pm_scene_text_first(const pm_scene *scene, const pm_ray *ray);

/// The normal of what a ray from `origin` along `direction` meets, in the file's coordinates;
/// fails the test when it meets nothing.
pm_vec3 pm_scene_text_normal(const pm_scene *scene, pm_vec3 origin, pm_vec3 direction);

#endif

// Lights in pictures: which one --light names, and the colour that each has in every picture.
#ifndef PM_LIGHT_PICK_H
#define PM_LIGHT_PICK_H

#include "colours.h"
#include "scene.h"
#include "status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Lights beyond so many share one grey.
enum { PM_LIGHT_COLOURS = 7 };

/// The index of the light that `id` names; PM_NONE for a NULL id: all.
/// @param light  [out]
/// @return PM_EINPUT when there is none of that name, naming those there are
pm_status pm_light_pick(const pm_scene *scene, const char *id, int *light);

pm_colour pm_light_colour(int light);

#ifdef __cplusplus
}
#endif
#endif

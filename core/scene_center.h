// From the file's coordinates to centred ones.
#ifndef PM_SCENE_CENTER_H
#define PM_SCENE_CENTER_H

#include "scene_file.h"

/// Moves shapes, lights and camera so that the centre of the bounds of all shapes (without
/// any: of the point lights) comes to lie in the origin, all in double. Fills in center, low,
/// high, radius, every shape's reach and every light's flux. A scene that is a single point
/// gets the radius 1 m.
///
/// Reports lengths and powers that overflow as faults.
void pm_scene_center(pm_scene_file *source);

#endif

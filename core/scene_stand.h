// Which medium the camera and every light stand in: found from the shapes, held against what
// the file says.
#ifndef PM_SCENE_STAND_H
#define PM_SCENE_STAND_H

#include "scene_file.h"

/// Of the centred scene: the medium of the camera and of every light, which hold what the file
/// names for them so far; then drops media that nothing is in.
///
/// Where no shape parts media, all stand in the one medium that sensor and emitters name.
///
/// A fault: shapes that do not close, a light in two media, another medium named than found,
/// light from outside the scene through a medium without end.
void pm_scene_stand(pm_scene_file *source);

#endif

// Which medium the camera and the lights stand in, found from the shapes that part media.
#ifndef PM_SCENE_INSIDE_H
#define PM_SCENE_INSIDE_H

#include "scene_file.h"

/// Of the centred scene: the medium of the camera and of every light, which hold what the file
/// names for them so far; then drops media that nothing is in.
///
/// A fault: shapes that do not close, an area light in two media, another medium named than
/// found, light from outside the scene through a medium without end.
void pm_scene_inside(pm_scene_file *source);

#endif

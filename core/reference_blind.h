// What a reference cannot show. A light without extent is found by paths from the eye only
// where its light meets something that spreads it, a surface or a medium; where it meets smooth
// glass or a smooth mirror first, no path from the eye ever hits it. Paths from the light then
// do, unless smooth glass or a mirror stands before the eye, too.
#ifndef PM_REFERENCE_BLIND_H
#define PM_REFERENCE_BLIND_H

#include "scene.h"

/// Enough for every sentence.
#define PM_REFERENCE_BLIND_ROOM 256

/// What a picture of the scene lacks, in one sentence; "" when it lacks nothing.
///
/// @param light_paths  paths from lights to the camera are traced, too
/// @param sentence     [out]
void pm_reference_blind(const pm_scene *scene, bool light_paths,
                        char sentence[PM_REFERENCE_BLIND_ROOM]);

#endif

// A number that stands for what light depends on in a scene.
#ifndef PM_SCENE_HASH_H
#define PM_SCENE_HASH_H

#include "scene.h"

/// 64-bit FNV-1a over shapes, their materials, lights and the centre, in the order of the file.
/// The camera, ids, line numbers and materials that no shape uses leave it unchanged.
uint64_t pm_scene_hash(const pm_scene *scene);

#endif

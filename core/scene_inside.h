// Which medium a point of the centred scene is in. Only shapes that part media decide.
#ifndef PM_SCENE_INSIDE_H
#define PM_SCENE_INSIDE_H

#include "intersect.h"
#include "scene_file.h"

typedef struct {
    pm_scene bounds;      // the scene with nothing but the shapes that part media
    pm_intersector world; // of bounds
} pm_scene_inside;

/// What the shapes tell of one place.
typedef struct {
    int medium;              // or PM_NONE
    const pm_shape *by;      // that tells of it; NULL when none was met
    int other;               // another medium
    const pm_shape *against; // that tells of that one; NULL when they all agree
} pm_scene_place;

/// Makes ready for questions, which share the memory of `source`. Release with
/// pm_intersector_free() of its `world`. False without memory.
bool pm_scene_inside_begin(pm_scene_file *source, pm_scene_inside *inside);

/// Along 8 lines from `from` to points on the shapes, always the same ones.
pm_scene_place pm_scene_inside_at(const pm_scene_inside *inside, pm_vec3 from);

/// Around the whole scene, along 32 lines right through it. Where two shapes that follow each
/// other on a line contradict each other, these are told instead: they do not close, cut or
/// touch each other.
pm_scene_place pm_scene_inside_around(const pm_scene_inside *inside);

#endif

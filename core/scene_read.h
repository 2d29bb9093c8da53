// Reads a scene file: the subset of Mitsuba 3's XML that photonlab models. Everything else is
// refused with file:line and the nearest known word; nothing is skipped in silence.
#ifndef PM_SCENE_READ_H
#define PM_SCENE_READ_H

#include "scene.h"
#include "status.h"

/// One `-D name=value`: replaces the value of the file's <default name="...">.
typedef struct {
    const char *name;
    const char *value;
} pm_define;

/// Reads `path` with all it includes.
///
/// @param defines      `define_count` of them; one whose name no <default> has is an error
/// @param needs_camera refuse a scene without a sensor
/// @param scene        [out] untouched unless PM_OK; free with pm_scene_free()
/// @return PM_EINPUT with one line per fault, at most 20, each `file:line: what, what to do`;
///         PM_EIO when a file cannot be read; PM_ENOMEM
pm_status pm_scene_read(const char *path, const pm_define *defines, int define_count,
                        bool needs_camera, pm_scene *scene);

/// Frees what pm_scene_read() made; a zeroed scene is fine.
void pm_scene_free(pm_scene *scene);

#endif

// Photon paths as `tracing --dump` writes them: one row per vertex, the vertices of a photon
// together and in order, each path from its light to where it ended.
#ifndef PM_PATH_FILE_H
#define PM_PATH_FILE_H

#include "figure_data.h"
#include "scene.h"
#include "status.h"

#define PM_PATH_HEADER "photon,step,event,x,y,z,r,g,b"

/// Reads a dump. Refuses, with file:line, a path that does not begin with L at step 0, a step
/// left out, an unknown event, rows after a path's end, and numbers that are not finite.
/// @param scene  that the data came from
/// @param paths   [out] untouched unless PM_OK; free with pm_path_file_free()
pm_status pm_path_file_read(const char *path, const pm_scene *scene, pm_path_set *paths);

void pm_path_file_free(pm_path_set *paths);

#endif

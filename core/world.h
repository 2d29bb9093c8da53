// A scene file opened for a program: read, checked, ready for ray queries.
#ifndef PM_WORLD_H
#define PM_WORLD_H

#include "intersect.h"
#include "options.h"

/// Fixed in memory while it is open: `rays` points at `scene`.
typedef struct {
    pm_scene scene;
    pm_intersector rays;
} pm_world;

/// Reads the scene that is `options`' first positional, with its -D and --size, and builds
/// Embree over it.
///
/// @param world  [out] close with pm_world_close() whatever is returned
pm_status pm_world_open(const pm_options *options, bool needs_camera, pm_world *world);
void pm_world_close(pm_world *world);

#endif

// An oracle for pictures: paths from the eye that find lamps by chance. No maps, no shadow
// rays, no shared roulette, no shared ways through media; each path is spelled out and sorted
// into its layer by the rule.
#ifndef PM_TINY_PATH_TRACER_H
#define PM_TINY_PATH_TRACER_H

#include "intersect.h"
#include "pictures.h"

/// Radiance by layer, meant over the whole film of the scene's camera.
///
/// @param paths  rounded up to whole thousands; every light must be an area or a constant one
pm_pictures_means pm_tiny_trace(const pm_intersector *world, uint32_t paths);

#endif

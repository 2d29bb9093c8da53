// In which medium a point lies, for programs that are given points.
#ifndef PM_INSIDE_H
#define PM_INSIDE_H

#include "intersect.h"

/// The medium at `at`, as the first shape that parts media says on a straight line to one of
/// them. The scene reader has seen to it that these shapes close.
///
/// @return its index, or PM_NONE; where no shape parts media, what the first light stands in
int pm_inside_medium(const pm_intersector *world, pm_vec3 at);

#endif

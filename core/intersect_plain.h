// Ray queries without Embree: every primitive is asked, in order. The oracle of the tests, and
// what a program links that must not load Embree.
#ifndef PM_INTERSECT_PLAIN_H
#define PM_INTERSECT_PLAIN_H

#include "intersect.h"

/// Makes `scene` ready for ray queries by a plain loop, whose time grows with the number of
/// primitives. The scene must outlive the intersector.
/// @param out  [out] untouched unless PM_OK; release with pm_intersector_free()
/// @return PM_ENOMEM
pm_status pm_intersect_plain(const pm_scene *scene, pm_intersector *out);

#endif

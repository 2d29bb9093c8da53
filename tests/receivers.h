// A surface under lights, for tests of direct light: shape 0 of a scene, which lies across z at
// the origin. Calls that fail end the running test.
#ifndef PM_RECEIVERS_H
#define PM_RECEIVERS_H

#include "direct.h"
#include "scenes.h"

/// Random numbers of these tests.
extern const pm_rng_source pm_receivers_source;

/// What a ray from `wi` meets at the origin.
void pm_receivers_meet(const pm_scenes *s, pm_vec3 wi, pm_hit *hit, pm_lobes *lobes);

/// First channel of pm_direct() with `samples` points on lamps; runs differ by their number.
double pm_receivers_direct(const pm_scenes *s, const pm_hit *hit, const pm_lobes *lobes,
                           uint32_t samples, uint64_t run);

#endif

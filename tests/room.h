// A small room to look into, and photons put into it by hand: for tests of pictures.
#ifndef PM_ROOM_H
#define PM_ROOM_H

#include "spectrum.h"
#include "vec.h"

#include <stdbool.h>

/// Writes the room's scene into the test's folder and returns the path. It has two walls, a
/// back one at z = 4.5 and a floor at y = 4.5, both from 4.5 to 5.5, and a point light; the
/// middle is (5, 5, 5), so that nothing is centred by itself. The camera looks along -z.
const char *pm_room_scene(void);

/// Writes a global map of photons at these places (the scene file's coordinates), all of the
/// same power [W], of 1,234 emitted, travelling along -z, and returns its path.
const char *pm_room_map(const char *name, const pm_vec3 *places, int count, pm_spectrum power,
                        bool balanced);

#endif

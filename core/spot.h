// The law of a spot light: how its power is spread over the angle to its axis. Emission draws
// angles by it and projection maps cut it into rows of equal power.
#ifndef PM_SPOT_H
#define PM_SPOT_H

#include "scene.h"

/// The angle [rad] to the spot's axis within which the share `u` of its power leaves: 0 at 0,
/// the cutoff at 1, rising with `u`.
double pm_spot_angle(const pm_light *light, double u);

#endif

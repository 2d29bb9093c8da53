// How bright pictures are shown when nobody says it: as bright as most of their pixels allow.
#ifndef PM_EXPOSURE_H
#define PM_EXPOSURE_H

#include "image.h"
#include "status.h"

#include <stddef.h>

/// Stops, in halves, at which 95 % of the values stay below 0.9 of what can be shown; 0 when
/// all are black, or not finite.
/// @param values  the brightest channel of each pixel; `count` >= 1 of them, sorted afterwards
double pm_exposure_choose(float *values, size_t count);

/// The same of the channels R G B of one image, which must be there.
/// @param stops  [out]
/// @return PM_ENOMEM
pm_status pm_exposure_of(const pm_image *image, double *stops);

#endif

// The photons themselves as a picture: a dot for each one that the camera sees.
#ifndef PM_PHOTON_DOTS_H
#define PM_PHOTON_DOTS_H

#include "pixel.h"
#include "render.h"

/// Draws the photons of all surface maps. Each adds its power over the mean power of its map to
/// the pixel it is seen in: first hits to the direct layer, caustic ones to caustic, others to
/// indirect. Where there is a caustic map, the global map's caustic photons are left out.
pm_status pm_photon_dots(const pm_intersector *world, const pm_render_maps *maps,
                         const pm_picture *picture);

#endif

// The photons behind a picture of a tree: dim dots, thinned to as many as the eye can part.
#ifndef PM_VIEW_BACKDROP_H
#define PM_VIEW_BACKDROP_H

#include "figure_data.h"
#include "photon.h"
#include "view.h"

/// Photons as dots, kept by the view for as long as the figure needs them.
/// @param cloud  [out] the view's
pm_status pm_view_backdrop_make(pm_view *view, const pm_photon_map *map,
                                const pm_photon_cloud **cloud);

/// The same of the photon file at `path`, which must hold as many photons as `other`.
/// @param map  [out] the photons themselves; pm_photon_map_free()
/// @return PM_EINPUT for photons of another scene, or of another number
pm_status pm_view_backdrop_read(pm_view *view, const char *path, const char *other,
                                uint64_t photons, pm_photon_map *map,
                                const pm_photon_cloud **cloud);

#endif

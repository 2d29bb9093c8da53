// A photon map as plain arrays for drawing.
#ifndef PM_PHOTON_CLOUD_H
#define PM_PHOTON_CLOUD_H

#include "figure_data.h"
#include "photon.h"
#include "status.h"

/// Unpacks every photon of `map`.
/// @param cloud  [out] untouched unless PM_OK; free with pm_photon_cloud_free()
pm_status pm_photon_cloud_make(const pm_photon_map *map, pm_photon_cloud *cloud);

void pm_photon_cloud_free(pm_photon_cloud *cloud);

#endif

// A photon map as plain arrays for drawing.
#ifndef PM_PHOTON_CLOUD_H
#define PM_PHOTON_CLOUD_H

#include "figure_data.h"
#include "photon.h"
#include "status.h"

/// Unpacks photons of `map`, at even steps when there are more than `most`.
/// @param cloud  [out] untouched unless PM_OK; free with pm_photon_cloud_free()
pm_status pm_photon_cloud_make(const pm_photon_map *map, uint32_t most, pm_photon_cloud *cloud);

void pm_photon_cloud_free(pm_photon_cloud *cloud);

#endif

// A photon map as plain arrays for drawing.
#ifndef PM_PHOTON_CLOUD_H
#define PM_PHOTON_CLOUD_H

#include "figure_data.h"
#include "photon.h"
#include "photon_file.h"
#include "status.h"

#include <stdbool.h>

/// Unpacks photons of `map`, at even steps when there are more than `most`.
/// @param cloud  [out] untouched unless PM_OK; free with pm_photon_cloud_free()
pm_status pm_photon_cloud_make(const pm_photon_map *map, uint32_t most, pm_photon_cloud *cloud);

/// Adds bounce and light of the same map's photons, where the columns have them.
pm_status pm_photon_cloud_mark(pm_photon_cloud *cloud, const pm_photon_columns *columns);

/// An empty cloud of one map, to be filled by hand.
pm_photon_cloud pm_photon_cloud_of(pm_map_kind map);

/// Room for `room` photons in every array, bounce and light as well when `marked`. Photons
/// that are there stay. On PM_ENOMEM the cloud is as it was, or larger.
pm_status pm_photon_cloud_reserve(pm_photon_cloud *cloud, uint32_t room, bool marked);

/// Finds `full_power` of a cloud filled by hand.
void pm_photon_cloud_measure(pm_photon_cloud *cloud);

void pm_photon_cloud_free(pm_photon_cloud *cloud);

#endif

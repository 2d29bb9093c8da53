// Photons as `storage --dump` writes them: a row a photon, with what the 20 bytes of a photon
// file have no room for: its path, its bounces, its light.
#ifndef PM_PHOTON_TABLE_H
#define PM_PHOTON_TABLE_H

#include "figure_data.h"
#include "photon.h"
#include "scene.h"
#include "status.h"

#define PM_PHOTON_TABLE_HEADER "x,y,z,dx,dy,dz,r,g,b,map,path,bounce,light"

/// Reads a dump. Refuses, with file:line, an unknown map, a path that does not go from L to a
/// D or V with `bounce` events S, D or V between, a light that the scene has not, a power below
/// 0, and numbers that are not finite.
///
/// @param scene   that the data came from
/// @param clouds  [out] PM_MAP_COUNT of them, by map; one without photons is empty. Untouched
///                unless PM_OK; free each with pm_photon_cloud_free()
pm_status pm_photon_table_read(const char *path, const pm_scene *scene,
                               pm_photon_cloud *clouds);

#endif

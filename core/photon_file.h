// A photon map as a file: binary little-endian PLY, so that ParaView, MeshLab and CloudCompare
// open it. Comment lines carry what PLY has no place for; a CRC-32 covers header and photons.
#ifndef PM_PHOTON_FILE_H
#define PM_PHOTON_FILE_H

#include "photon.h"
#include "status.h"

#define PM_PHOTON_FILE_VERSION 1

/// What a file says besides its photons.
typedef struct {
    uint32_t seed;
    uint64_t scene_hash;
    pm_vec3 center; // of the scene: positions in the file are the file's coordinates minus this
} pm_photon_file_info;

/// Optional columns, one entry a photon in map order; NULL for none.
typedef struct {
    uint32_t *bounce;
    uint32_t *light;
    uint64_t *path; // events from the light: 2 bits each, lowest first (1 S, 2 D, 3 V), the
                    // first 32 of them
    float (*normal)[3];
} pm_photon_columns;

/// Writes beside `path` and renames. The map may be balanced or not; the file says which.
pm_status pm_photon_file_write(const char *path, const pm_photon_map *map,
                               const pm_photon_file_info *info,
                               const pm_photon_columns *columns);

/// Reads a file back. A file that is cut, altered by a bit, of another version, a mesh, or no
/// PLY is refused with a line that says which.
/// @param map      [out] untouched unless PM_OK; free with pm_photon_map_free()
/// @param columns  [out] may be NULL; NULL where the file has none. Free with
///                 pm_photon_columns_free()
/// @return PM_EIO, PM_EINPUT, PM_ENOMEM
pm_status pm_photon_file_read(const char *path, pm_photon_map *map, pm_photon_file_info *info,
                              pm_photon_columns *columns);

void pm_photon_columns_free(pm_photon_columns *columns);

/// Whether `path` can be read and begins like a photon file: for refusing one as a mesh.
bool pm_photon_file_is(const char *path);

#endif

// Reading the cells of projection maps, as emission --cells writes them.
#ifndef PM_CELL_FILE_H
#define PM_CELL_FILE_H

#include "status.h"

#include <stdbool.h>
#include <stdint.h>

/// What emit_dump.h says of a row.
typedef struct {
    double near, far;            // [rad] from the axis; [m] on a disc
    double azimuth, azimuth_end; // [rad]
    bool lit;
} pm_cell;

/// The cells of one light for one photon map.
typedef struct {
    char map[16]; // "caustic"
    uint32_t light;
    bool flat; // a disc, not a sphere
    uint32_t rows, columns;
    uint64_t lit;
    pm_cell *cells; // row by row
} pm_cell_map;

/// Freed by pm_cell_file_free().
typedef struct {
    pm_cell_map *maps;
    int count; // at least 1
} pm_cell_set;

/// @param cells  [out] untouched unless PM_OK
/// @return PM_EINPUT with file:line for rows out of order, cells left out, bounds out of order
/// or
///         range, no cell at all; PM_EIO, PM_ENOMEM
pm_status pm_cell_file_read(const char *path, pm_cell_set *cells);
void pm_cell_file_free(pm_cell_set *cells);

#endif

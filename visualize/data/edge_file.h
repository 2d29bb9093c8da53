// Irradiance on a grid under every kernel, as `filtering --on --grid --dump` writes it: row by
// row, every row equally long.
#ifndef PM_EDGE_FILE_H
#define PM_EDGE_FILE_H

#include "kernel_data.h"
#include "scene.h"
#include "status.h"

#define PM_EDGE_HEADER                                                                         \
    "i,j,x,y,z,none,cone,gaussian,epanechnikov,none-lecture,cone-lecture,gaussian-lecture,"    \
    "epanechnikov-lecture,differential"

/// Name of a column of irradiance: "cone", "differential".
const char *pm_edge_file_kernel(int kernel);

/// Reads a dump. Refuses, with file:line, points out of order, an incomplete last row, a grid
/// below 2 x 2, an irradiance below 0, and numbers that are not finite.
/// @param scene  that the data came from
/// @param grid   [out] untouched unless PM_OK; free with pm_edge_file_free()
pm_status pm_edge_file_read(const char *path, const pm_scene *scene, pm_edge_grid *grid);

/// The same for a second file, which must have its points where `first` has them.
pm_status pm_edge_file_read_same(const char *path, const pm_scene *scene,
                                 const pm_edge_grid *first, pm_edge_grid *grid);

void pm_edge_file_free(pm_edge_grid *grid);

#endif

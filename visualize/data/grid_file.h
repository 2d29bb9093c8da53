// Irradiance on a rectangle as `radiance --grid --dump` writes it: one row per grid point, row
// by row (i the column, j the row), every row of the grid equally long.
#ifndef PM_GRID_FILE_H
#define PM_GRID_FILE_H

#include "figure_data.h"
#include "scene.h"
#include "status.h"

#define PM_GRID_HEADER "i,j,x,y,z,nx,ny,nz,r,g,b,radius,found"

/// Reads a dump. Refuses, with file:line, points out of order, an incomplete last row, a grid
/// below 2 x 2, an irradiance or a radius below 0, a normal that is not a unit vector, and
/// numbers that are not finite.
/// @param scene  that the data came from
/// @param grid    [out] untouched unless PM_OK; free with pm_grid_file_free()
pm_status pm_grid_file_read(const char *path, const pm_scene *scene, pm_grid *grid);

void pm_grid_file_free(pm_grid *grid);

#endif

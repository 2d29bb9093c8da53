// A grid's numbers for VTK: its points, and their triangles or none.
#ifndef PM_GRID_DATA_HH
#define PM_GRID_DATA_HH

#include "figure.hh"
#include "figure_data.h"

/// Points with the arrays "irradiance [W/m^2]" (red, green, blue), "radius [m]", "found" and
/// "normal", and between them the grid's cells as quads.
vtkSmartPointer<vtkPolyData> pm_grid_data(const pm_grid *grid);

#endif

// How far the estimates on a rectangle are from what they should be, and where: by how many
// radii a point is from the rectangle's edge.
#ifndef PM_GRID_BIAS_H
#define PM_GRID_BIAS_H

#include "figure_data.h"
#include "status.h"

/// Means of estimate / truth, by luminance.
typedef struct {
    double middle; // over the middle third both ways
    double edge;   // over the points at the two ends of the middle rows
    double corner; // over the four corners
    double radius; // [m] mean of all points that found a photon
    double found;  // mean of all points
    /// Along the middle third of the rows, taken together: a value a column, from both ends.
    double *distance; // from the nearer end, in mean radii of its points
    double *ratio;
    int count;       // of these
    int unreachable; // columns whose points found nothing: they have a ratio, but no radius
} pm_grid_bias;

/// Median luminance of the middle third both ways of all these grids together [W/m^2].
/// @return PM_ENOMEM
pm_status pm_grid_bias_truth(const pm_grid *const *grids, int count, double *truth);

/// @param truth  luminance of the irradiance there should be [W/m^2], > 0
/// @param bias   [out] untouched unless PM_OK; free with pm_grid_bias_free()
/// @return PM_ENOMEM
pm_status pm_grid_bias_make(const pm_grid *grid, double truth, pm_grid_bias *bias);
void pm_grid_bias_free(pm_grid_bias *bias);

/// The share of a thin disc's area on a surface that ends in a straight edge.
/// @param distance  of the disc's middle from the edge, in radii, >= 0
double pm_grid_bias_disc(double distance);

/// The same and the wall's photons that a sphere takes beyond the edge, where a wall at a right
/// angle gets as much light: half a disc of what remains of its radius there.
double pm_grid_bias_sphere(double distance);

#endif

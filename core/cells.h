// The cells of a light's projection map: the unit square that its photons' directions (or, for
// a directional light, starts) are made from, cut into PM_CELLS_ROWS x PM_CELLS_COLUMNS. Here
// they are lit, ball by ball.
//
// Invariant: a photon that can meet anything inside a ball leaves through a cell that the ball
// has lit.
#ifndef PM_CELLS_H
#define PM_CELLS_H

#include "pieces.h"

/// On a sphere of directions a cell is some 3 degrees wide: it is the border cells of a target
/// that are wasted, and at half the width there would be half as many of them, for four times
/// the work.
enum { PM_CELLS_ROWS = 64, PM_CELLS_COLUMNS = 128 };
enum { PM_CELLS = PM_CELLS_ROWS * PM_CELLS_COLUMNS };

typedef struct {
    bool flat;     // rows end at distances from the axis; else at angles to it
    pm_frame axis; // azimuths count from s to t
    pm_vec3 apex;  // where directions start; flat: where the axis stands
    double spread; // [m] distance of starts from the apex; flat: 0
    double border[PM_CELLS_ROWS + 1]; // [rad] or [m], ascending
    bool lit[PM_CELLS];               // row * PM_CELLS_COLUMNS + column
    uint32_t lit_count;
} pm_cells;

/// The cells of `light`, all dark.
///
/// @param cells  [out]
/// @return false when photons of different starts have the same cell, but no spread to speak
/// of: spheres, cylinders and meshes that shine, and the constant light
bool pm_cells_begin(const pm_scene *scene, const pm_light *light, pm_cells *cells);

/// Lights the cells that reach into `ball`.
void pm_cells_light(pm_cells *cells, const pm_ball *ball);

#endif

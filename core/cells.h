// The cells of a light's projection map: the unit square that its photons' directions (or, for
// a directional light, starts) are made from, cut into PM_CELLS_ROWS x PM_CELLS_COLUMNS. Here
// they are lit, ball by ball.
//
// Invariant: a photon that can meet anything inside a ball leaves through a cell that the ball
// has lit.
#ifndef PM_CELLS_H
#define PM_CELLS_H

#include "pieces.h"

/// Measured by the share of power that the caustic map's lights still send: with 128 x 128
/// cells 0.8 % in scenes/sparse.xml and 28.6 % in scenes/cornell-spheres.xml; with 64 x 128
/// 1.6 % and 29.1 %, with 512 x 512 0.8 % and 27.8 %.
enum { PM_CELLS_ROWS = 128, PM_CELLS_COLUMNS = 128 };
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
/// @return false when a direction says nothing about where photons go: spheres, cylinders and
/// meshes that shine, and the constant light
bool pm_cells_begin(const pm_scene *scene, const pm_light *light, pm_cells *cells);

/// Lights the cells that reach into `ball`.
void pm_cells_light(pm_cells *cells, const pm_ball *ball);

#endif

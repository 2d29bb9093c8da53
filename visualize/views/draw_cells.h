// The cells of a projection map about their light: on a sphere of directions, or on the disc
// that parallel light starts from.
#ifndef PM_DRAW_CELLS_H
#define PM_DRAW_CELLS_H

#include "figure.h" // before any header of core

#include "cell_file.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    pm_vec3 middle; // [m, centred] of the sphere or the disc
    pm_frame axis;  // that distances and azimuths are counted from
    double radius;  // [m] of the sphere; a disc has its own size
    double reach;   // [m] that rays through lit cells are drawn; 0: none
} pm_cell_place;

pm_colour pm_cell_lit(void);
pm_colour pm_cell_dark(void);

/// Draws all cells in the current panel, lit ones bright, and some rays through them. Keeps the
/// cells.
pm_status pm_draw_cells(pm_figure *figure, const pm_cell_map *map, const pm_cell_place *place);

#ifdef __cplusplus
}
#endif
#endif

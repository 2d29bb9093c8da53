// A grid of irradiance as a heat map that is looked at face on.
#ifndef PM_DRAW_EDGE_H
#define PM_DRAW_EDGE_H

#include "figure.h"
#include "kernel_data.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Ends of a scale that several maps share, and what lies outside of it.
typedef struct {
    double low, high;            // [W/m^2], 0 < low < high
    bool has_zero, below, above; // values of 0, above 0 but below `low`, above `high`
} pm_edge_range;

/// Heat map of one kernel in the current panel, with a line along the grid's row `row`.
pm_status pm_draw_edge(pm_figure *figure, const pm_edge_grid *grid, int kernel,
                       const pm_edge_range *range, uint64_t row);

/// The scale in the right column.
pm_status pm_draw_edge_scale(pm_figure *figure, const pm_edge_range *range);

/// The grid's outline in the current panel's scene.
pm_status pm_draw_edge_place(pm_figure *figure, const pm_edge_grid *grid);

/// Keeps the grid's numbers for .vtp files and picks in the current panel.
pm_status pm_draw_edge_keep(pm_figure *figure, const pm_edge_grid *grid);

#ifdef __cplusplus
}
#endif
#endif

// One search in a kd-tree: cells and photons in the order it looked at them, and its ball.
#ifndef PM_DRAW_SEARCH_H
#define PM_DRAW_SEARCH_H

#include "figure.h"
#include "visit_table.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Draws a search in the current panel: the cells it entered as boxes and the photons it looked
/// at as dots, both in the colour of their order, rings around the photons of the answer, the
/// ball after some of the visits as circles, the last one bold, and a cross at the point asked
/// about.
/// @param cut_across  cells are shown where the plane through the point across this axis cuts
///                    them; -1: whole
/// @param cross       length of the cross's arms [m]
pm_status pm_draw_search(pm_figure *figure, const pm_visit_set *search, int cut_across,
                         double cross);

/// The scale of the order and what the signs mean, in the right column.
/// @param others  whether photons that were not looked at are shown, too
pm_status pm_draw_search_legend(pm_figure *figure, const pm_visit_set *search, bool others);

/// Keeps the photons that were looked at with order, depth, distance and what became of them.
pm_status pm_draw_search_keep(pm_figure *figure, const pm_visit_set *search);

#ifdef __cplusplus
}
#endif
#endif

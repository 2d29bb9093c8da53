// The split planes of a kd-tree.
#ifndef PM_DRAW_TREE_H
#define PM_DRAW_TREE_H

#include "figure.h"
#include "figure_data.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The planes of the first `depths` depths, translucent, coloured by axis. The first splits
/// have bold outlines and their depth's number on them; deeper ones are thinner and fainter.
/// @param name    of what is kept for .vtp and picks: "split plane"
/// @param center  that scene coordinates are counted from
/// @param drawn   [out] planes drawn
pm_status pm_draw_tree(pm_figure *figure, const pm_tree_split_set *tree, int depths,
                       const char *name, pm_vec3 center, uint64_t *drawn);

/// What the planes' colours and numbers mean, in the right column.
pm_status pm_draw_tree_legend(pm_figure *figure, int depths);

#ifdef __cplusplus
}
#endif
#endif

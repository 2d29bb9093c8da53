// The split planes of a kd-tree.
#ifndef PM_DRAW_TREE_H
#define PM_DRAW_TREE_H

#include "figure.h"
#include "figure_data.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Split planes, translucent, coloured by axis, fainter with depth.
pm_status pm_draw_tree(pm_figure *figure, const pm_tree_split_set *tree);

#ifdef __cplusplus
}
#endif
#endif

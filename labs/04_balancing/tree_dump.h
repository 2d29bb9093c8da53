// The table of --dump: two trees of the same photons, as numbers for pictures.
//
// Rows of three kinds (`row`); columns that a kind does not have are empty:
//     tree   the whole tree: `depth` is its height, `photons` how many it has, `visited_mean`
//     level  `photons` of one `depth`, from the root down
//     split  one plane, to PM_TREE_DUMP_DEPTHS depths: `axis` and `position` of the plane, and
//            the cell x0..z1 that it halves
#ifndef PM_TREE_DUMP_H
#define PM_TREE_DUMP_H

#include "scene.h"
#include "status.h"
#include "tree.h"

#include <stdio.h>

#define PM_TREE_DUMP_HEADER                                                                    \
    "tree,row,depth,photons,visited_mean,axis,position,x0,y0,z0,x1,y1,z1\n"
#define PM_TREE_DUMP_DEPTHS 8

/// Writes all rows of one tree.
/// @param visited_mean  photons looked at in a search
/// @param center        of the scene: places are written in the scene file's coordinates
pm_status pm_tree_dump(FILE *out, const pm_tree *tree, double visited_mean, pm_vec3 center);

#endif

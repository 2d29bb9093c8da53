// A kd-tree that nobody balances: photons are inserted one by one, in the order they were
// stored, with axes taking turns by depth. What balancing is compared with.
#ifndef PM_GROWN_TREE_H
#define PM_GROWN_TREE_H

#include "balance.h"
#include "tree.h"

typedef struct pm_grown_tree pm_grown_tree;

/// Grows a tree of the map's photons, at least one. It points to them where they lie, so the
/// map must not be balanced while it is used.
/// @param tree  [out] free with pm_grown_tree_free()
pm_status pm_grown_tree_make(const pm_photon_map *map, pm_grown_tree **tree);

/// Its links.
const pm_tree *pm_grown_tree_links(const pm_grown_tree *tree);

/// Links from the root to the deepest photon.
uint32_t pm_grown_tree_height(const pm_grown_tree *tree);

/// The same search as pm_balance_nearest() in this tree; `accept` and `widen` must be unset.
/// One at a time: the tree holds its scratch.
void pm_grown_tree_nearest(pm_grown_tree *tree, const pm_search *search, pm_neighbour *nearest,
                           uint32_t *found, uint64_t *visited);

void pm_grown_tree_free(pm_grown_tree *tree);

#endif

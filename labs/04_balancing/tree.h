// A kd-tree of photons, whichever way its links are kept: the balanced one in heap order, or
// one that was grown. For comparing the two.
//
// Invariant: a node is the index of its photon in photons[], and the root is photon 0.
#ifndef PM_TREE_H
#define PM_TREE_H

#include "photon.h"

#define PM_TREE_NONE UINT32_MAX // no such node

typedef struct {
    const char *name; // "balanced" or "unbalanced"
    const pm_photon *photons;
    uint32_t count;
    const uint32_t (*child)[2]; // of a grown tree; NULL: heap order
    const uint32_t *parent;     // of a grown tree
    float low[3], high[3];      // the root's cell: the box of all photons [m, centred]
} pm_tree;

/// A node's place in the tree: its cell is what the planes above it leave of the root's.
typedef struct {
    uint32_t depth; // 0 the root
    int axis;       // that its plane is across: 0 x, 1 y, 2 z
    float low[3], high[3];
} pm_tree_cell;

/// A balanced map as a tree; it points into the map.
pm_tree pm_tree_of_map(const pm_photon_map *map);

/// The child before (0) or beyond (1) the node's plane, or PM_TREE_NONE.
uint32_t pm_tree_child(const pm_tree *tree, uint32_t node, int side);

/// Takes time in proportion to the depth.
pm_tree_cell pm_tree_cell_of(const pm_tree *tree, uint32_t node);

#endif

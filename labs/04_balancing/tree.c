// A cell is the root's box less what each plane above cuts off: the order does not matter, so
// it is found on the way up.
#include "tree.h"

#include <math.h>
#include <stddef.h>

static void bound(pm_tree *tree)
{
    for (int axis = 0; axis < 3; axis++) {
        tree->low[axis] = INFINITY;
        tree->high[axis] = -INFINITY;
        for (uint32_t i = 0; i < tree->count; i++) {
            float at = tree->photons[i].position[axis];
            tree->low[axis] = fminf(tree->low[axis], at);
            tree->high[axis] = fmaxf(tree->high[axis], at);
        }
    }
}

pm_tree pm_tree_of_map(const pm_photon_map *map)
{
    pm_tree tree = {.name = "balanced", .photons = map->photons, .count = map->count};
    bound(&tree);
    return tree;
}

uint32_t pm_tree_child(const pm_tree *tree, uint32_t node, int side)
{
    if (tree->child != NULL) {
        return tree->child[node][side];
    }
    uint64_t child = 2 * (uint64_t)node + 1 + (uint64_t)side;
    return child < tree->count ? (uint32_t)child : PM_TREE_NONE;
}

static uint32_t parent_of(const pm_tree *tree, uint32_t node)
{
    return tree->parent != NULL ? tree->parent[node] : (node - 1) / 2;
}

static uint32_t depth_of(const pm_tree *tree, uint32_t node)
{
    uint32_t depth = 0;
    for (; node != 0; node = parent_of(tree, node)) {
        depth++;
    }
    return depth;
}

static int axis_of(const pm_tree *tree, uint32_t node, uint32_t depth)
{
    if (tree->child != NULL) {
        return (int)(depth % 3);
    }
    return tree->photons[node].flags & PM_PHOTON_AXIS;
}

pm_tree_cell pm_tree_cell_of(const pm_tree *tree, uint32_t node)
{
    pm_tree_cell cell = {.depth = depth_of(tree, node)};
    cell.axis = axis_of(tree, node, cell.depth);
    for (int axis = 0; axis < 3; axis++) {
        cell.low[axis] = tree->low[axis];
        cell.high[axis] = tree->high[axis];
    }
    uint32_t depth = cell.depth;
    for (uint32_t at = node; at != 0; at = parent_of(tree, at)) {
        uint32_t above = parent_of(tree, at);
        int axis = axis_of(tree, above, --depth);
        float plane = tree->photons[above].position[axis];
        if (pm_tree_child(tree, above, 1) == at) {
            cell.low[axis] = fmaxf(cell.low[axis], plane);
        } else {
            cell.high[axis] = fminf(cell.high[axis], plane);
        }
    }
    return cell;
}

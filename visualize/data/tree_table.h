// What `balancing --dump` writes: two trees of the same photons, balanced and not.
#ifndef PM_TREE_TABLE_H
#define PM_TREE_TABLE_H

#include "figure_data.h"
#include "scene.h"
#include "status.h"

typedef enum { PM_TREE_BALANCED, PM_TREE_UNBALANCED, PM_TREE_KINDS } pm_tree_kind;

typedef struct {
    uint64_t photons;
    uint64_t height;          // links from the root to the deepest photon
    double visited_mean;      // photons looked at in a search
    uint64_t *level;          // photons of each depth, `height` + 1 of them
    pm_tree_split_set splits; // of the first depths; its height counts depths, the root's too
} pm_tree_table;

/// Reads both trees.
///
/// @param scene   that the photons are of: points are made centred
/// @param trees   [out] by pm_tree_kind; untouched unless PM_OK; pm_tree_table_free() each
/// @return PM_EINPUT with file:line for rows out of order, levels that do not add up to the
///         photons, a plane outside of its cell, a tree that is missing; PM_EIO; PM_ENOMEM
pm_status pm_tree_table_read(const char *path, const pm_scene *scene,
                             pm_tree_table trees[PM_TREE_KINDS]);

void pm_tree_table_free(pm_tree_table *tree);

#endif

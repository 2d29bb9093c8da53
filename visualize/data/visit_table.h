// What `balancing --visits` writes: the photons that one search looked at, in its order, in the
// balanced tree and in the other one.
#ifndef PM_VISIT_TABLE_H
#define PM_VISIT_TABLE_H

#include "scene.h"
#include "status.h"
#include "tree_table.h"

#include <stdbool.h>

typedef struct {
    pm_vec3 position;
    pm_vec3 low, high; // its cell
    double distance;   // from the point asked about [m]
    double radius;     // of the search after it [m]; HUGE_VAL while that is unlimited
    uint64_t photon;   // its place in the tree
    uint64_t depth;
    int axis;
    bool kept;  // among the nearest so far
    bool found; // among the nearest in the end
} pm_visited;

/// One search. Visit i was the (i + 1)-th.
typedef struct {
    pm_visited *visits;
    uint64_t count;
    uint64_t photons; // in the tree
    uint64_t k;       // wanted
    uint64_t found;   // visits that are in the answer
    pm_vec3 at;       // the point asked about
} pm_visit_set;

/// Reads the search in both trees; points are made centred.
///
/// @param searches  [out] by pm_tree_kind; untouched unless PM_OK; pm_visit_table_free() each
/// @return PM_EINPUT with file:line for visits out of order, a photon outside of its cell, a
///         distance that is not the positions', a growing radius, a search that is missing;
///         PM_EIO; PM_ENOMEM
pm_status pm_visit_table_read(const char *path, const pm_scene *scene,
                              pm_visit_set searches[PM_TREE_KINDS]);

void pm_visit_table_free(pm_visit_set *search);

#endif

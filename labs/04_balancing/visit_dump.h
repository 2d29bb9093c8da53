// The table of --visits: what one search looked at, photon by photon, in its own order.
//
// A row is a visit. `photon` is the photon's place in its tree (of the balanced one: in the
// file of -o), `depth` and `axis` are its node's, x0..z1 its cell. `distance` is from the
// centre, at_x..at_z; `kept` says whether it was then among the nearest so far, `found` whether
// it is among them in the end; `radius` is what the search reaches for after it, "none" while
// that is unlimited. `photons` are all in the tree, `k` are wanted.
#ifndef PM_VISIT_DUMP_H
#define PM_VISIT_DUMP_H

#include "balance.h"
#include "tree.h"

#include <stdio.h>

#define PM_VISIT_DUMP_HEADER                                                                   \
    "tree,photons,k,at_x,at_y,at_z,order,photon,depth,axis,x,y,z,distance,kept,found,radius,"  \
    "x0,y0,z0,x1,y1,z1\n"

typedef struct {
    uint32_t photon;
    double limit2; // see pm_visit_fn
} pm_visit;

/// The visits of one search. Zero-initialised it is empty; free with pm_visit_list_free().
typedef struct {
    pm_visit *visits;
    uint64_t count, room;
    bool full; // no memory for more
} pm_visit_list;

/// A pm_visit_fn whose witness is a pm_visit_list.
void pm_visit_list_add(void *witness, uint32_t index, double limit2);

/// One search that was watched, and what came of it.
typedef struct {
    const pm_tree *tree;
    const pm_search *search;
    const pm_visit_list *seen;
    const pm_neighbour *nearest; // the answer
    uint32_t found;
    uint64_t visited; // photons that the search says it looked at
} pm_watched;

/// Writes all rows of one search.
/// @param center  of the scene: places are written in the scene file's coordinates
/// @return PM_EINPUT when it did not tell of each photon that it looked at; PM_ENOMEM
pm_status pm_visit_dump(FILE *out, const pm_watched *watched, pm_vec3 center);

void pm_visit_list_free(pm_visit_list *list);

#endif

// Lab 4. The map becomes a left-balanced kd-tree in place, and the k nearest photons are found.
//
// Invariant: node i (root 1) has children 2i and 2i + 1; its axis is in the photon's flags; no
// photon of the left subtree lies beyond it on that axis, none of the right one before it.
// @source Jensen, "Realistic Image Synthesis Using Photon Mapping", 2001, ch. 6
#ifndef PM_BALANCE_H
#define PM_BALANCE_H

#include "photon.h"
#include "status.h"

/// Judges a photon for a search: false leaves it out, true gives its squared distance, which
/// must be at least its squared Euclidean distance from the search's centre. Asked only about
/// photons whose Euclidean distance is still of interest.
typedef bool (*pm_accept_fn)(const void *context, const pm_photon *photon, double *distance2);

/// Told of every photon that a search looks at, in that order, wanted or not: its index in
/// photons[], and the squared distance below which photons are wanted from here on.
typedef void (*pm_visit_fn)(void *witness, uint32_t index, double limit2);

typedef struct {
    pm_vec3 at;
    uint32_t k;          // photons wanted, >= 1
    double radius2;      // squared reach [m^2], > 0; INFINITY for none
    pm_accept_fn accept; // NULL: every photon, Euclidean distance
    const void *context;
    pm_visit_fn visit; // NULL: nobody watches
    void *witness;     // handed to `visit`
    double widen[3]; // a plane at distance d across axis a is at least d^2 widen[a] away in the
                     // measure of `accept`; 0 stands for 1, which is always right
} pm_search;

/// How many of `count` >= 1 photons go to the left subtree of a left-balanced tree.
uint32_t pm_balance_left(uint32_t count);

/// Balances `map` in place: median split on the longest side of each node's tight box, x before
/// y before z where sides are equal. Takes O(n log n) for any input, sorted, equal or coplanar,
/// and O(log n) extra memory. The same map gives the same bytes; a balanced one is left as it
/// is.
///
/// @return PM_EINPUT when a position is not finite
pm_status pm_balance_build(pm_photon_map *map);

/// The `search->k` nearest accepted photons whose distance is at most the reach, or all there
/// are. Exact for any k and any map; which of several at the k-th distance is free, but the
/// same on every run.
///
/// @param nearest  [out] room for k; a max-heap by distance when `found` is k: nearest[0] is
///                 the farthest
/// @param found    [out]
/// @param visited  [in, out] incremented by the tree nodes looked at; may be NULL
/// @return PM_EINPUT when the map is not balanced (an empty one need not be), k is 0, `at` is
///         not finite or radius2 not positive
pm_status pm_balance_nearest(const pm_photon_map *map, const pm_search *search,
                             pm_neighbour *nearest, uint32_t *found, uint64_t *visited);

#endif

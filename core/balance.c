// The kd-tree in two steps, both in place. First the photons are put in the tree's in-order
// (left subtree, node, right subtree, and so on inside), by selecting each node's median. Then
// one permutation takes the in-order to the heap order, whose links are arithmetic.
//
// Invariant while partitioning: photons before a node's place are not beyond it on its axis,
// those after it not before it. Equal coordinates may lie on both sides.
// @source Jensen 2001, ch. 6; Bentley, "Multidimensional binary search trees", CACM 18(9), 1975
#include "balance.h"

#include "select.h"

#include <stddef.h>

#define UNPLACED PM_PHOTON_AXIS // in the axis bits: not yet in heap order
#define TREE_HEIGHT 31          // levels of a tree of PM_MAP_MAX photons

typedef struct {
    float low[3], high[3];
} box;

// --- building -------------------------------------------------------------------------------

uint32_t pm_balance_left(uint32_t count)
{
    uint32_t row = 1; // photons in the last row, were it full
    while (row <= count / 2) {
        row *= 2;
    }
    if (row == 1) {
        return 0;
    }
    uint32_t last = count - (row - 1);
    uint32_t half = row / 2;
    return half - 1 + (last < half ? last : half);
}

static int longest_side(const box *around)
{
    double side[3];
    for (int axis = 0; axis < 3; axis++) {
        side[axis] = (double)around->high[axis] - (double)around->low[axis];
    }
    int yz = side[1] >= side[2] ? 1 : 2;
    return side[0] >= side[yz] ? 0 : yz;
}

static void stretch(float x, float *low, float *high)
{
    *low = x < *low ? x : *low;
    *high = x > *high ? x : *high;
}

/// The tight box of `count` >= 1 photons. Tight, because one cut out of the parent's makes
/// searches look at 40 % more photons where they lie on surfaces.
static box box_around(const pm_photon *photons, uint32_t count)
{
    float low_x = photons->position[0], high_x = low_x;
    float low_y = photons->position[1], high_y = low_y;
    float low_z = photons->position[2], high_z = low_z;
    for (const pm_photon *photon = photons + 1; photon < photons + count; photon++) {
        stretch(photon->position[0], &low_x, &high_x);
        stretch(photon->position[1], &low_y, &high_y);
        stretch(photon->position[2], &low_z, &high_z);
    }
    return (box){{low_x, low_y, low_z}, {high_x, high_y, high_z}};
}

/// Puts photons first .. first + count - 1 in in-order.
static void arrange(const pm_photon_run *r, uint32_t first, uint32_t count)
{
    while (count > 1) {
        box around = box_around(r->photons + first, count);
        uint32_t left = pm_balance_left(count);
        uint32_t median = first + left;
        pm_select_place(r, first, first + count - 1, median, longest_side(&around));
        arrange(r, first, left);
        first = median + 1;
        count -= left + 1;
    }
}

/// Which in-order place, from 0, the photon of heap node `node` (from 1) has in a tree of
/// `count`. Were the last row full, its photons would have the even places.
static uint32_t in_order_place(uint32_t node, uint32_t count, int last_depth)
{
    int depth = 31 - __builtin_clz(node);
    uint64_t offset = node - (UINT64_C(1) << depth);
    uint64_t place = ((2 * offset + 1) << (last_depth - depth)) - 1;
    uint64_t last = count - ((UINT64_C(1) << last_depth) - 1);
    uint64_t before = (place + 1) / 2; // places of the last row before this one
    return (uint32_t)(place - (before > last ? before - last : 0));
}

/// Moves one cycle of the permutation, starting at `start`: each place gets the photon that
/// belongs there.
static void place_cycle(const pm_photon_run *r, uint32_t start, uint32_t count, int last_depth)
{
    pm_photon photon = r->photons[start];
    pm_photon_exact exact = {0};
    if (r->exact != NULL) {
        exact = r->exact[start];
    }
    uint32_t to = start;
    for (;;) {
        uint32_t from = in_order_place(to + 1, count, last_depth);
        bool closes = from == start;
        r->photons[to] = closes ? photon : r->photons[from];
        r->photons[to].flags &= (uint16_t)~UNPLACED;
        if (r->exact != NULL) {
            r->exact[to] = closes ? exact : r->exact[from];
        }
        if (closes) {
            return;
        }
        to = from;
    }
}

static void to_heap_order(const pm_photon_run *r, uint32_t count)
{
    int last_depth = 31 - __builtin_clz(count);
    for (uint32_t i = 0; i < count; i++) {
        r->photons[i].flags |= UNPLACED;
    }
    for (uint32_t i = 0; i < count; i++) {
        if ((r->photons[i].flags & UNPLACED) == UNPLACED) {
            place_cycle(r, i, count, last_depth);
        }
    }
}

/// Writes down the axes that arrange() took, bottom up, from the same boxes. Returns the box of
/// the subtree.
static box set_axes(const pm_photon_run *r, uint64_t node, uint32_t count)
{
    pm_photon *photon = &r->photons[node - 1];
    box around = box_around(photon, 1);
    for (uint64_t child = 2 * node; child <= 2 * node + 1 && child <= count; child++) {
        box part = set_axes(r, child, count);
        for (int axis = 0; axis < 3; axis++) {
            stretch(part.low[axis], &around.low[axis], &around.high[axis]);
            stretch(part.high[axis], &around.low[axis], &around.high[axis]);
        }
    }
    photon->flags |= (uint16_t)longest_side(&around);
    return around;
}

static pm_status check_photons(const pm_photon_map *map)
{
    if (map->count > PM_MAP_MAX) {
        return PM_FAIL(PM_ELIMIT, "a tree holds at most %u photons, got %u", PM_MAP_MAX,
                       map->count);
    }
    for (uint32_t i = 0; i < map->count; i++) {
        const float *at = map->photons[i].position;
        if (!isfinite(at[0]) || !isfinite(at[1]) || !isfinite(at[2])) {
            return PM_FAIL(PM_EINPUT, "photon %u lies at %g %g %g, which is not finite", i,
                           (double)at[0], (double)at[1], (double)at[2]);
        }
    }
    return PM_OK;
}

pm_status pm_balance_build(pm_photon_map *map)
{
    PM_TRY(check_photons(map));
    if (map->count > 0 && !map->balanced) {
        pm_photon_run all = {map->photons, map->exact};
        arrange(&all, 0, map->count);
        to_heap_order(&all, map->count);
        (void)set_axes(&all, 1, map->count);
    }
    map->balanced = true;
    return PM_OK;
}

// --- searching ------------------------------------------------------------------------------

/// The candidates of one search: a plain list until k are held, then a max-heap.
typedef struct {
    pm_neighbour *nearest;
    uint32_t k, found;
    double limit; // squared distances below it are wanted
} candidates;

/// Restores the heap from `hole` down, where `item` is to go.
static void sift_down(pm_neighbour *heap, uint32_t count, uint64_t hole, pm_neighbour item)
{
    uint64_t child = 2 * hole + 1;
    while (child < count) {
        uint64_t other = child + 1 < count ? child + 1 : child;
        child += heap[other].distance2 > heap[child].distance2 ? 1 : 0;
        if (heap[child].distance2 <= item.distance2) {
            break;
        }
        heap[hole] = heap[child];
        hole = child;
        child = 2 * hole + 1;
    }
    heap[hole] = item;
}

static void take(candidates *held, pm_neighbour item)
{
    if (held->found == held->k) {
        sift_down(held->nearest, held->k, 0, item);
        held->limit = held->nearest[0].distance2;
        return;
    }
    held->nearest[held->found++] = item;
    if (held->found < held->k) {
        return;
    }
    for (uint32_t i = held->k / 2; i > 0; i--) {
        sift_down(held->nearest, held->k, i - 1, held->nearest[i - 1]);
    }
    held->limit = held->nearest[0].distance2;
}

static void consider(const pm_search *search, const pm_photon *photon, uint32_t index,
                     candidates *held)
{
    double dx = (double)photon->position[0] - search->at.x;
    double dy = (double)photon->position[1] - search->at.y;
    double dz = (double)photon->position[2] - search->at.z;
    double distance2 = dx * dx + dy * dy + dz * dz;
    if (!(distance2 < held->limit)) {
        return;
    }
    if (search->accept != NULL && !search->accept(search->context, photon, &distance2)) {
        return;
    }
    if (distance2 < held->limit) {
        take(held, (pm_neighbour){distance2, index});
    }
}

static pm_status check_search(const pm_photon_map *map, const pm_search *search)
{
    if (!map->balanced && map->count > 0) {
        return PM_FAIL(PM_EINPUT, "%s", "the map must be balanced before it is searched");
    }
    if (search->k == 0) {
        return PM_FAIL(PM_EINPUT, "%s", "k must be at least 1, got 0");
    }
    if (!(search->radius2 > 0.0)) {
        return PM_FAIL(PM_EINPUT, "the squared reach must be > 0, got %g", search->radius2);
    }
    if (!isfinite(search->at.x) || !isfinite(search->at.y) || !isfinite(search->at.z)) {
        return PM_FAIL(PM_EINPUT, "a search needs a finite position, got %g %g %g",
                       search->at.x, search->at.y, search->at.z);
    }
    return PM_OK;
}

/// A subtree put off, and the squared distance to the plane it lies beyond.
typedef struct {
    uint64_t node;
    double plane2;
} pending;

typedef struct {
    const pm_photon_map *map;
    const pm_search *search;
    double widen[3];
    candidates held;
    pending later[TREE_HEIGHT + 1]; // the root, then one a level at most
    int waiting;
    uint64_t looked_at;
} walk;

/// Goes down from `node` to the nearest leaf, putting off the far sides.
static void descend(walk *w, uint64_t node)
{
    const pm_search *search = w->search;
    uint64_t count = w->map->count;
    while (node <= count) {
        const pm_photon *photon = &w->map->photons[node - 1];
        if (2 * node <= count) {
            __builtin_prefetch(photon + node); // its children, two in a row
        }
        w->looked_at++;
        consider(search, photon, (uint32_t)(node - 1), &w->held);
        if (__builtin_expect(search->visit != NULL, 0)) { // else searches cost 6 % more
            search->visit(search->witness, (uint32_t)(node - 1), w->held.limit);
        }
        int axis = photon->flags & PM_PHOTON_AXIS;
        double beyond = pm_vec_axis(search->at, axis) - (double)photon->position[axis];
        uint64_t near = 2 * node + (beyond > 0.0 ? 1 : 0);
        uint64_t far = near ^ 1;
        w->later[w->waiting] = (pending){far, beyond * beyond * w->widen[axis]};
        w->waiting += far <= count ? 1 : 0;
        node = near;
    }
}

pm_status pm_balance_nearest(const pm_photon_map *map, const pm_search *search,
                             pm_neighbour *nearest, uint32_t *found, uint64_t *visited)
{
    PM_TRY(check_search(map, search));
    walk w;
    w.map = map;
    w.search = search;
    for (int axis = 0; axis < 3; axis++) {
        w.widen[axis] = fmax(search->widen[axis], 1.0);
    }
    // Not below the reach but at most at it: one step further, for a strict comparison.
    w.held = (candidates){nearest, search->k, 0, nextafter(search->radius2, HUGE_VAL)};
    w.later[0] = (pending){1, 0.0};
    w.waiting = 1;
    w.looked_at = 0;
    while (w.waiting > 0) {
        pending next = w.later[--w.waiting];
        if (next.plane2 < w.held.limit) {
            descend(&w, next.node);
        }
    }
    *found = w.held.found;
    if (visited != NULL) {
        *visited += w.looked_at;
    }
    return PM_OK;
}

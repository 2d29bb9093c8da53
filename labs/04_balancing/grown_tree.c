// Loops, no recursion: photons that came in order grow into a tree as high as they are many.
#include "grown_tree.h"

#include <math.h>
#include <stdlib.h>

/// A subtree put off, and the squared distance to the plane it lies beyond.
typedef struct {
    uint32_t node, depth;
    double plane2;
} pending;

struct pm_grown_tree {
    pm_tree links; // points to what follows
    uint32_t (*child)[2];
    uint32_t *parent;
    uint32_t height;
    pending *later; // scratch of a search
};

// --- growing --------------------------------------------------------------------------------

static pm_vec3 position_of(const pm_photon *photon)
{
    return pm_vec((double)photon->position[0], (double)photon->position[1],
                  (double)photon->position[2]);
}

/// True when `at` lies beyond the photon on the axis of its depth.
static bool side_of(const pm_photon *photon, pm_vec3 at, uint32_t depth)
{
    int axis = (int)(depth % 3);
    return pm_vec_axis(at, axis) > (double)photon->position[axis];
}

static void insert(pm_grown_tree *tree, uint32_t photon)
{
    pm_vec3 at = position_of(&tree->links.photons[photon]);
    uint32_t node = 0;
    uint32_t depth = 0;
    for (;;) {
        bool side = side_of(&tree->links.photons[node], at, depth);
        depth++;
        if (tree->child[node][side] == PM_TREE_NONE) {
            tree->child[node][side] = photon;
            tree->parent[photon] = node;
            break;
        }
        node = tree->child[node][side];
    }
    tree->height = depth > tree->height ? depth : tree->height;
}

static void insert_all(pm_grown_tree *tree)
{
    uint32_t count = tree->links.count;
    for (uint32_t i = 0; i < count; i++) {
        tree->child[i][0] = tree->child[i][1] = tree->parent[i] = PM_TREE_NONE;
    }
    for (uint32_t i = 1; i < count; i++) {
        insert(tree, i);
    }
}

static pm_status make_links(const pm_photon_map *map, pm_grown_tree *tree)
{
    tree->links = pm_tree_of_map(map);
    tree->links.name = "unbalanced";
    tree->child = malloc((size_t)map->count * sizeof *tree->child);
    tree->parent = malloc((size_t)map->count * sizeof *tree->parent);
    if (tree->child == NULL || tree->parent == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for a tree of %u photons", map->count);
    }
    tree->links.child = (const uint32_t(*)[2])tree->child;
    tree->links.parent = tree->parent;
    insert_all(tree);
    tree->later = malloc(((size_t)tree->height + 2) * sizeof *tree->later);
    return tree->later != NULL
               ? PM_OK
               : PM_FAIL(PM_ENOMEM, "no memory to search %u deep", tree->height);
}

pm_status pm_grown_tree_make(const pm_photon_map *map, pm_grown_tree **tree)
{
    pm_grown_tree *made = calloc(1, sizeof *made);
    if (made == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for a tree");
    }
    pm_status status = make_links(map, made);
    if (status != PM_OK) {
        pm_grown_tree_free(made);
        return status;
    }
    *tree = made;
    return PM_OK;
}

const pm_tree *pm_grown_tree_links(const pm_grown_tree *tree)
{
    return &tree->links;
}

uint32_t pm_grown_tree_height(const pm_grown_tree *tree)
{
    return tree->height;
}

void pm_grown_tree_free(pm_grown_tree *tree)
{
    if (tree != NULL) {
        free(tree->child);
        free(tree->parent);
        free(tree->later);
        free(tree);
    }
}

// --- searching ------------------------------------------------------------------------------

/// What is held: always a max-heap by distance.
typedef struct {
    pm_neighbour *heap;
    uint32_t k, found;
    double limit2; // squared distances below it are wanted
} candidates;

static void replace_farthest(candidates *held, pm_neighbour item)
{
    pm_neighbour *heap = held->heap;
    uint64_t hole = 0;
    for (;;) {
        uint64_t child = 2 * hole + 1;
        if (child + 1 < held->k && heap[child + 1].distance2 > heap[child].distance2) {
            child++;
        }
        if (child >= held->k || heap[child].distance2 <= item.distance2) {
            break;
        }
        heap[hole] = heap[child];
        hole = child;
    }
    heap[hole] = item;
}

static void append(candidates *held, pm_neighbour item)
{
    uint32_t at = held->found++;
    while (at > 0 && held->heap[(at - 1) / 2].distance2 < item.distance2) {
        held->heap[at] = held->heap[(at - 1) / 2];
        at = (at - 1) / 2;
    }
    held->heap[at] = item;
}

static void consider(candidates *held, pm_neighbour item)
{
    if (!(item.distance2 < held->limit2)) {
        return;
    }
    if (held->found == held->k) {
        replace_farthest(held, item);
    } else {
        append(held, item);
    }
    if (held->found == held->k) {
        held->limit2 = held->heap[0].distance2;
    }
}

/// Looks at one node and puts off both children, the nearer one last, so that it comes first.
static uint32_t look_at(pm_grown_tree *tree, const pm_search *search, pending now,
                        candidates *held, uint32_t waiting)
{
    const pm_photon *photon = &tree->links.photons[now.node];
    pm_vec3 away = pm_vec_sub(position_of(photon), search->at);
    consider(held, (pm_neighbour){pm_vec_dot(away, away), now.node});
    if (search->visit != NULL) {
        search->visit(search->witness, now.node, held->limit2);
    }
    double plane = pm_vec_axis(away, (int)(now.depth % 3));
    bool side = side_of(photon, search->at, now.depth);
    const uint32_t *child = tree->child[now.node];
    const pending next[2] = {{child[!side], now.depth + 1, plane * plane},
                             {child[side], now.depth + 1, 0.0}};
    for (int i = 0; i < 2; i++) {
        if (next[i].node != PM_TREE_NONE) {
            tree->later[waiting++] = next[i];
        }
    }
    return waiting;
}

void pm_grown_tree_nearest(pm_grown_tree *tree, const pm_search *search, pm_neighbour *nearest,
                           uint32_t *found, uint64_t *visited)
{
    candidates held = {nearest, search->k, 0, nextafter(search->radius2, HUGE_VAL)};
    uint32_t waiting = 0;
    tree->later[waiting++] = (pending){0, 0, 0.0};
    while (waiting > 0) {
        pending next = tree->later[--waiting];
        if (next.plane2 < held.limit2) {
            (*visited)++;
            waiting = look_at(tree, search, next, &held, waiting);
        }
    }
    *found = held.found;
}

// Node i (root 1) has children 2i and 2i + 1, so the levels of the tree follow each other in
// photons[] and a cell is found from its parent's: everything is one pass over an array of
// cells.
#include "tree_split.h"

#include <stdlib.h>

typedef struct {
    float low[3], high[3];
} cell;

static cell bounds(const pm_photon_map *map)
{
    cell all = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t i = 0; i < map->count; i++) {
        for (int axis = 0; axis < 3; axis++) {
            all.low[axis] = fminf(all.low[axis], map->photons[i].position[axis]);
            all.high[axis] = fmaxf(all.high[axis], map->photons[i].position[axis]);
        }
    }
    return all;
}

void pm_tree_split_cut(const float low[3], const float high[3], int axis, float at,
                       pm_vec3 corner[4])
{
    int s = (axis + 1) % 3;
    int t = (axis + 2) % 3;
    for (int i = 0; i < 4; i++) {
        float p[3];
        p[axis] = at;
        p[s] = i == 1 || i == 2 ? high[s] : low[s];
        p[t] = i >= 2 ? high[t] : low[t];
        corner[i] = pm_vec((double)p[0], (double)p[1], (double)p[2]);
    }
}

/// Fills split `node` and the cells of its children.
static pm_status split_cell(const pm_photon_map *map, const char *where, uint32_t node,
                            cell *cells, pm_tree_split *split)
{
    const pm_photon *photon = &map->photons[node - 1];
    const cell *c = &cells[node];
    int axis = photon->flags & PM_PHOTON_AXIS;
    bool inside = axis < 3;
    for (int a = 0; a < 3; a++) {
        inside =
            inside && photon->position[a] >= c->low[a] && photon->position[a] <= c->high[a];
    }
    if (!inside) {
        return pm_status_fail(PM_EINPUT,
                              "%s: photon %u lies outside of its tree cell: the file says "
                              "balanced, but it is no kd-tree",
                              where, node - 1);
    }
    split->axis = axis;
    pm_tree_split_cut(c->low, c->high, axis, photon->position[axis], split->corner);
    cell *left = &cells[(size_t)node * 2];
    left[0] = *c;
    left[1] = *c;
    left[0].high[axis] = photon->position[axis];
    left[1].low[axis] = photon->position[axis];
    return PM_OK;
}

static pm_status walk(const pm_photon_map *map, const char *where, cell *cells,
                      pm_tree_split_set *set)
{
    cells[1] = bounds(map);
    int depth = 0;
    for (uint32_t node = 1; node <= set->count; node++) {
        if (node >> (depth + 1) != 0) {
            depth++;
        }
        set->splits[node - 1].depth = depth;
        PM_TRY(split_cell(map, where, node, cells, &set->splits[node - 1]));
    }
    return PM_OK;
}

pm_status pm_tree_split_make(const pm_photon_map *map, const char *where, int depths,
                             pm_tree_split_set *splits)
{
    if (!map->balanced) {
        return pm_status_fail(
            PM_EINPUT,
            "%s: this map is not balanced, so it holds no tree to draw; write "
            "it with balancing -o",
            where);
    }
    uint32_t most = (1u << depths) - 1;
    pm_tree_split_set made = {.count = map->count < most ? map->count : most};
    while (map->count >> made.height != 0) {
        made.height++;
    }
    made.depths = depths < made.height ? depths : made.height;
    made.splits = calloc((size_t)made.count + 1, sizeof *made.splits);
    cell *cells = calloc(2 * ((size_t)made.count + 1), sizeof *cells);
    pm_status status = made.splits == NULL || cells == NULL
                           ? PM_FAIL(PM_ENOMEM, "no memory for %u split planes", made.count)
                           : walk(map, where, cells, &made);
    free(cells);
    if (status != PM_OK) {
        pm_tree_split_free(&made);
        return status;
    }
    *splits = made;
    return PM_OK;
}

void pm_tree_split_free(pm_tree_split_set *splits)
{
    free(splits->splits);
    *splits = (pm_tree_split_set){0};
}

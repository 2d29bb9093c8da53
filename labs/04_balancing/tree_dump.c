// Level by level, in one queue of all nodes: a tree may be as high as it has photons.
#include "tree_dump.h"

#include <stdlib.h>

typedef struct {
    FILE *out;
    const pm_tree *tree;
    pm_vec3 center;
    uint32_t *queue;        // nodes from the root down
    uint32_t *level;        // where each depth starts in it; the last entry is its end
    uint32_t levels, split; // depths there are; nodes whose planes are written
} dump;

/// Puts the children of the level `first` to `last` - 1 behind it; returns the new end.
static uint32_t add_level(const dump *d, uint32_t first, uint32_t last)
{
    uint32_t end = last;
    for (uint32_t i = first; i < last; i++) {
        for (int side = 0; side < 2; side++) {
            uint32_t child = pm_tree_child(d->tree, d->queue[i], side);
            if (child != PM_TREE_NONE) {
                d->queue[end++] = child;
            }
        }
    }
    return end;
}

static void find_levels(dump *d)
{
    uint32_t first = 0;
    uint32_t last = 1;
    d->queue[0] = 0;
    while (first < last) {
        d->level[d->levels++] = first;
        uint32_t end = add_level(d, first, last);
        first = last;
        last = end;
    }
    d->level[d->levels] = d->tree->count;
    d->split = d->level[d->levels < PM_TREE_DUMP_DEPTHS ? d->levels : PM_TREE_DUMP_DEPTHS];
}

static void write_levels(const dump *d, double visited_mean)
{
    fprintf(d->out, "%s,tree,%u,%u,%.9g,,,,,,,,\n", d->tree->name, d->levels - 1,
            d->tree->count, visited_mean);
    for (uint32_t i = 0; i < d->levels; i++) {
        fprintf(d->out, "%s,level,%u,%u,,,,,,,,,\n", d->tree->name, i,
                d->level[i + 1] - d->level[i]);
    }
}

static pm_vec3 place(const dump *d, const float at[3])
{
    return pm_vec_add(pm_vec((double)at[0], (double)at[1], (double)at[2]), d->center);
}

static void write_split(const dump *d, uint32_t node)
{
    pm_tree_cell cell = pm_tree_cell_of(d->tree, node);
    pm_vec3 at = place(d, d->tree->photons[node].position);
    pm_vec3 low = place(d, cell.low);
    pm_vec3 high = place(d, cell.high);
    fprintf(d->out, "%s,split,%u,,,%c,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g\n", d->tree->name,
            cell.depth, "xyz"[cell.axis], pm_vec_axis(at, cell.axis), low.x, low.y, low.z,
            high.x, high.y, high.z);
}

pm_status pm_tree_dump(FILE *out, const pm_tree *tree, double visited_mean, pm_vec3 center)
{
    dump d = {.out = out, .tree = tree, .center = center};
    d.queue = malloc((size_t)tree->count * sizeof *d.queue);
    d.level = malloc(((size_t)tree->count + 1) * sizeof *d.level);
    bool made = d.queue != NULL && d.level != NULL;
    if (made) {
        find_levels(&d);
        write_levels(&d, visited_mean);
        for (uint32_t i = 0; i < d.split; i++) {
            write_split(&d, d.queue[i]);
        }
    }
    free(d.queue);
    free(d.level);
    return made ? PM_OK
                : PM_FAIL(PM_ENOMEM, "no memory to write a tree of %u photons", tree->count);
}

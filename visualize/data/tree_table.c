// A tree is one row that says how large it is, then its levels from the root down, then its
// planes, ordered by depth. Every row is checked against those before it, so that what gets
// through is a tree as far as a table can tell.
#include "tree_table.h"

#include "csv.h"
#include "tree_split.h"

#include <stdlib.h>
#include <string.h>

#define HEADER "tree,row,depth,photons,visited_mean,axis,position,x0,y0,z0,x1,y1,z1"
#define WRITTEN_BY "balancing --dump"
#define PHOTONS_MOST 2147483647u

enum {
    TREE,
    ROW,
    DEPTH,
    PHOTONS,
    VISITED,
    AXIS,
    POSITION,
    LOW,
    HIGH = LOW + 3,
    END = HIGH + 3
};

static const char *const names[PM_TREE_KINDS] = {"balanced", "unbalanced"};

typedef struct {
    pm_tree_table *tree; // current one; NULL before the first
    uint64_t levels;     // rows of it so far
    uint64_t counted;    // photons in these
    uint32_t room;       // for splits
    bool there[PM_TREE_KINDS];
} reader;

static pm_status refuse(const pm_csv *csv, const char *why)
{
    return pm_status_fail(PM_EINPUT, "%s:%ld: %s", csv->path, csv->line, why);
}

/// Fields `first` to `last` - 1 do not belong to this kind of row.
static pm_status check_empty(const pm_csv *csv, int first, int last)
{
    for (int i = first; i < last; i++) {
        if (csv->field[i][0] != '\0') {
            return pm_status_fail(PM_EINPUT, "%s:%ld: a row \"%.10s\" has no %s, got \"%.40s\"",
                                  csv->path, csv->line, csv->field[ROW], csv->name[i],
                                  csv->field[i]);
        }
    }
    return PM_OK;
}

/// The levels of the tree before the current row must hold all its photons.
static pm_status check_complete(const pm_csv *csv, const reader *to)
{
    if (to->tree == NULL) {
        return PM_OK;
    }
    if (to->levels != to->tree->height + 1 || to->counted != to->tree->photons) {
        return pm_status_fail(
            PM_EINPUT,
            "%s:%ld: the tree before this has %llu photons on %llu levels, and its levels "
            "hold %llu on %llu",
            csv->path, csv->line, (unsigned long long)to->tree->photons,
            (unsigned long long)to->tree->height + 1, (unsigned long long)to->counted,
            (unsigned long long)to->levels);
    }
    return PM_OK;
}

static pm_status read_tree(const pm_csv *csv, pm_tree_kind kind, pm_tree_table *trees,
                           reader *to)
{
    pm_tree_table *tree = &trees[kind];
    PM_TRY(check_complete(csv, to));
    PM_TRY(check_empty(csv, AXIS, END));
    PM_TRY(pm_csv_count(csv, PHOTONS, PHOTONS_MOST, &tree->photons));
    PM_TRY(pm_csv_count(csv, DEPTH, PHOTONS_MOST, &tree->height));
    PM_TRY(pm_csv_positive(csv, VISITED, &tree->visited_mean));
    if (to->there[kind] || tree->height >= tree->photons) {
        return refuse(csv, to->there[kind] ? "this tree was there before"
                                           : "a tree has at least one photon on each level");
    }
    tree->level = calloc(tree->height + 1, sizeof *tree->level);
    if (tree->level == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %llu levels",
                       (unsigned long long)tree->height + 1);
    }
    tree->splits.height = (int)tree->height + 1;
    to->there[kind] = true;
    *to = (reader){.tree = tree, .there = {to->there[0], to->there[1]}};
    return PM_OK;
}

static pm_status read_level(const pm_csv *csv, reader *to)
{
    uint64_t depth = 0;
    uint64_t photons = 0;
    PM_TRY(pm_csv_count(csv, DEPTH, to->tree->height, &depth));
    PM_TRY(pm_csv_count(csv, PHOTONS, to->tree->photons, &photons));
    PM_TRY(check_empty(csv, VISITED, END));
    if (depth != to->levels) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: the next level is %llu, got %llu", csv->path,
                              csv->line, (unsigned long long)to->levels,
                              (unsigned long long)depth);
    }
    uint64_t most = depth == 0 ? 1 : 2 * to->tree->level[depth - 1];
    if (photons == 0 || photons > most) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: level %llu holds 1 to %llu photons, got %llu",
                              csv->path, csv->line, (unsigned long long)depth,
                              (unsigned long long)most, (unsigned long long)photons);
    }
    to->tree->level[depth] = photons;
    to->levels++;
    to->counted += photons;
    return PM_OK;
}

static pm_status read_axis(const pm_csv *csv, int *axis)
{
    const char *text = csv->field[AXIS];
    if (strlen(text) != 1 || text[0] < 'x' || text[0] > 'z') {
        return pm_status_fail(PM_EINPUT, "%s:%ld: axis must be one of x y z, got \"%.20s\"",
                              csv->path, csv->line, text);
    }
    *axis = text[0] - 'x';
    return PM_OK;
}

/// Where the plane stands, and the rectangle that it cuts out of its cell.
static pm_status read_plane(const pm_csv *csv, const pm_scene *scene, pm_tree_split *split)
{
    pm_vec3 ends[2];
    double at = 0.0;
    PM_TRY(pm_csv_point(csv, LOW, scene, &ends[0]));
    PM_TRY(pm_csv_point(csv, HIGH, scene, &ends[1]));
    PM_TRY(pm_csv_number(csv, POSITION, &at));
    at -= pm_vec_axis(scene->center, split->axis);
    float low[3];
    float high[3];
    for (int axis = 0; axis < 3; axis++) {
        low[axis] = (float)pm_vec_axis(ends[0], axis);
        high[axis] = (float)pm_vec_axis(ends[1], axis);
        if (low[axis] > high[axis]) {
            return refuse(csv, "a cell goes from x0,y0,z0 up to x1,y1,z1");
        }
    }
    if ((float)at < low[split->axis] || (float)at > high[split->axis]) {
        return refuse(csv, "the plane lies outside of its cell");
    }
    pm_tree_split_cut(low, high, split->axis, (float)at, split->corner);
    return PM_OK;
}

static pm_status add_split(reader *to, const pm_tree_split *split)
{
    pm_tree_split_set *set = &to->tree->splits;
    if (set->count == to->room) {
        uint32_t room = to->room == 0 ? 256 : 2 * to->room;
        pm_tree_split *bigger = realloc(set->splits, room * sizeof *bigger);
        if (bigger == NULL) {
            return PM_FAIL(PM_ENOMEM, "no memory for %u split planes", room);
        }
        set->splits = bigger;
        to->room = room;
    }
    set->splits[set->count++] = *split;
    set->depths = split->depth + 1;
    return PM_OK;
}

static pm_status read_split(const pm_csv *csv, const pm_scene *scene, reader *to)
{
    uint64_t depth = 0;
    pm_tree_split split = {0};
    const pm_tree_split_set *set = &to->tree->splits;
    PM_TRY(pm_csv_count(csv, DEPTH, to->tree->height, &depth));
    PM_TRY(check_empty(csv, PHOTONS, AXIS));
    PM_TRY(read_axis(csv, &split.axis));
    PM_TRY(read_plane(csv, scene, &split));
    split.depth = (int)depth;
    if (split.depth != set->depths && split.depth != set->depths - 1) {
        return refuse(csv, "planes must be ordered by depth, from the root's down");
    }
    return add_split(to, &split);
}

static pm_status read_row(const pm_csv *csv, const pm_scene *scene, pm_tree_table *trees,
                          reader *to)
{
    const char *row = csv->field[ROW];
    pm_tree_kind kind =
        strcmp(csv->field[TREE], names[0]) == 0 ? PM_TREE_BALANCED : PM_TREE_UNBALANCED;
    if (strcmp(csv->field[TREE], names[kind]) != 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: tree must be balanced or unbalanced, got \"%.20s\"",
                              csv->path, csv->line, csv->field[TREE]);
    }
    if (strcmp(row, "tree") == 0) {
        return read_tree(csv, kind, trees, to);
    }
    if (to->tree != &trees[kind]) {
        return refuse(csv, "a tree begins with its row \"tree\"");
    }
    if (strcmp(row, "level") == 0) {
        return read_level(csv, to);
    }
    if (strcmp(row, "split") == 0) {
        return read_split(csv, scene, to);
    }
    return pm_status_fail(PM_EINPUT, "%s:%ld: row must be tree, level or split, got \"%.20s\"",
                          csv->path, csv->line, row);
}

static pm_status read_rows(pm_csv *csv, const pm_scene *scene, pm_tree_table *trees)
{
    reader to = {0};
    bool more = true;
    while (more) {
        PM_TRY(pm_csv_next(csv, &more));
        if (more) {
            PM_TRY(read_row(csv, scene, trees, &to));
        }
    }
    PM_TRY(check_complete(csv, &to));
    for (int kind = 0; kind < PM_TREE_KINDS; kind++) {
        if (!to.there[kind]) {
            return pm_status_fail(PM_EINPUT, "%s:%ld: the file ends without the %s tree",
                                  csv->path, csv->line, names[kind]);
        }
    }
    if (trees[0].photons != trees[1].photons) {
        return refuse(csv, "the two trees hold different numbers of photons");
    }
    return PM_OK;
}

pm_status pm_tree_table_read(const char *path, const pm_scene *scene,
                             pm_tree_table trees[PM_TREE_KINDS])
{
    pm_csv csv;
    pm_tree_table made[PM_TREE_KINDS] = {0};
    pm_status status = pm_csv_open(path, HEADER, WRITTEN_BY, &csv);
    if (status == PM_OK) {
        status = read_rows(&csv, scene, made);
    }
    pm_csv_close(&csv);
    for (int kind = 0; kind < PM_TREE_KINDS; kind++) {
        if (status == PM_OK) {
            trees[kind] = made[kind];
        } else {
            pm_tree_table_free(&made[kind]);
        }
    }
    return status;
}

void pm_tree_table_free(pm_tree_table *tree)
{
    free(tree->level);
    pm_tree_split_free(&tree->splits);
    *tree = (pm_tree_table){0};
}

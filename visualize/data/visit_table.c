// Every row repeats what holds for its whole search; rows of one search follow each other. What
// can be known from other rows and columns is checked.
#include "visit_table.h"

#include "csv.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define HEADER                                                                                 \
    "tree,photons,k,at_x,at_y,at_z,order,photon,depth,axis,x,y,z,distance,kept,found,radius,"  \
    "x0,y0,z0,x1,y1,z1"
#define WRITTEN_BY "balancing --visits"
#define PHOTONS_MOST 2147483647u

// Numbers are written with 9 digits.
#define ROUNDING 1e-6

enum { TREE, PHOTONS, K, AT, ORDER = AT + 3, PHOTON, DEPTH, AXIS, PLACE, DISTANCE = PLACE + 3 };
enum { KEPT = DISTANCE + 1, FOUND, RADIUS, LOW, HIGH = LOW + 3 };

static const char *const names[PM_TREE_KINDS] = {"balanced", "unbalanced"};

typedef struct {
    pm_visit_set searches[PM_TREE_KINDS];
    uint64_t room;
    int last; // search of the row before; -1 before the first
} reader;

static pm_status refuse(const pm_csv *csv, const char *why)
{
    return pm_status_fail(PM_EINPUT, "%s:%ld: %s", csv->path, csv->line, why);
}

static pm_status read_bool(const pm_csv *csv, int column, bool *value)
{
    uint64_t number = 0;
    PM_TRY(pm_csv_count(csv, column, 1, &number));
    *value = number == 1;
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

static pm_status read_radius(const pm_csv *csv, double *radius)
{
    if (strcmp(csv->field[RADIUS], "none") == 0) {
        *radius = HUGE_VAL;
        return PM_OK;
    }
    return pm_csv_positive(csv, RADIUS, radius);
}

/// Does the photon lie in its cell, and as far from `at` as the row says?
static pm_status check_place(const pm_csv *csv, const pm_scene *scene, const pm_visited *visit,
                             pm_vec3 at)
{
    double slack = ROUNDING * (scene->radius + pm_vec_reach(scene->center));
    for (int axis = 0; axis < 3; axis++) {
        double x = pm_vec_axis(visit->position, axis);
        if (x < pm_vec_axis(visit->low, axis) - slack ||
            x > pm_vec_axis(visit->high, axis) + slack) {
            return refuse(csv, "the photon lies outside of its cell x0,y0,z0 to x1,y1,z1");
        }
    }
    double distance = pm_vec_length(pm_vec_sub(visit->position, at));
    if (fabs(distance - visit->distance) > slack) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: distance must be that of x,y,z from at_x,at_y,at_z, %g, "
                              "got %s",
                              csv->path, csv->line, distance, csv->field[DISTANCE]);
    }
    return PM_OK;
}

/// What holds for the whole search.
static pm_status read_search(const pm_csv *csv, const pm_scene *scene, pm_visit_set *search)
{
    pm_visit_set row = *search;
    PM_TRY(pm_csv_count(csv, PHOTONS, PHOTONS_MOST, &row.photons));
    PM_TRY(pm_csv_count(csv, K, UINT32_MAX, &row.k));
    PM_TRY(pm_csv_point(csv, AT, scene, &row.at));
    bool same = row.photons == search->photons && row.k == search->k &&
                row.at.x == search->at.x && row.at.y == search->at.y &&
                row.at.z == search->at.z;
    if (search->count > 0 && !same) {
        return refuse(csv, "photons, k and at must be the same in all rows of a search");
    }
    *search = row;
    return PM_OK;
}

static pm_status read_visit(const pm_csv *csv, const pm_scene *scene,
                            const pm_visit_set *search, pm_visited *visit)
{
    uint64_t order = 0;
    PM_TRY(pm_csv_count(csv, ORDER, PHOTONS_MOST, &order));
    if (order != search->count + 1) {
        return pm_status_fail(PM_EINPUT, "%s:%ld: the next visit is number %llu, got %llu",
                              csv->path, csv->line, (unsigned long long)search->count + 1,
                              (unsigned long long)order);
    }
    PM_TRY(pm_csv_count(csv, PHOTON, search->photons - (search->photons > 0 ? 1 : 0),
                        &visit->photon));
    PM_TRY(pm_csv_count(csv, DEPTH, order - 1, &visit->depth));
    PM_TRY(read_axis(csv, &visit->axis));
    PM_TRY(pm_csv_point(csv, PLACE, scene, &visit->position));
    PM_TRY(pm_csv_positive(csv, DISTANCE, &visit->distance));
    PM_TRY(read_bool(csv, KEPT, &visit->kept));
    PM_TRY(read_bool(csv, FOUND, &visit->found));
    PM_TRY(read_radius(csv, &visit->radius));
    PM_TRY(pm_csv_point(csv, LOW, scene, &visit->low));
    PM_TRY(pm_csv_point(csv, HIGH, scene, &visit->high));
    if (order > 1 && visit->radius > search->visits[order - 2].radius) {
        return refuse(csv, "the radius of a search never grows");
    }
    return check_place(csv, scene, visit, search->at);
}

static pm_status add_visit(reader *to, pm_visit_set *search, const pm_visited *visit)
{
    if (search->count == to->room) {
        uint64_t room = to->room == 0 ? 256 : 2 * to->room;
        pm_visited *bigger = realloc(search->visits, (size_t)room * sizeof *bigger);
        if (bigger == NULL) {
            return PM_FAIL(PM_ENOMEM, "no memory for %llu visits", (unsigned long long)room);
        }
        search->visits = bigger;
        to->room = room;
    }
    search->visits[search->count++] = *visit;
    search->found += visit->found ? 1 : 0;
    return PM_OK;
}

static pm_status read_row(const pm_csv *csv, const pm_scene *scene, reader *to)
{
    int kind = strcmp(csv->field[TREE], names[0]) == 0 ? 0 : 1;
    if (strcmp(csv->field[TREE], names[kind]) != 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: tree must be balanced or unbalanced, got \"%.20s\"",
                              csv->path, csv->line, csv->field[TREE]);
    }
    pm_visit_set *search = &to->searches[kind];
    if (kind != to->last) {
        if (search->count > 0) {
            return refuse(csv, "the visits of a search must follow each other");
        }
        to->room = 0;
        to->last = kind;
    }
    pm_visited visit = {0};
    PM_TRY(read_search(csv, scene, search));
    PM_TRY(read_visit(csv, scene, search, &visit));
    PM_TRY(add_visit(to, search, &visit));
    return search->found <= search->k ? PM_OK
                                      : refuse(csv, "more photons are found than k asks for");
}

static pm_status read_rows(pm_csv *csv, const pm_scene *scene, reader *to)
{
    bool more = true;
    while (more) {
        PM_TRY(pm_csv_next(csv, &more));
        if (more) {
            PM_TRY(read_row(csv, scene, to));
        }
    }
    for (int kind = 0; kind < PM_TREE_KINDS; kind++) {
        if (to->searches[kind].count == 0) {
            return pm_status_fail(PM_EINPUT,
                                  "%s:%ld: the file ends without a search in the %s tree",
                                  csv->path, csv->line, names[kind]);
        }
    }
    const pm_visit_set *s = to->searches;
    bool same = s[0].photons == s[1].photons && s[0].k == s[1].k && s[0].at.x == s[1].at.x &&
                s[0].at.y == s[1].at.y && s[0].at.z == s[1].at.z;
    return same ? PM_OK : refuse(csv, "photons, k and at must be the same in both trees");
}

pm_status pm_visit_table_read(const char *path, const pm_scene *scene,
                              pm_visit_set searches[PM_TREE_KINDS])
{
    pm_csv csv;
    reader to = {.last = -1};
    pm_status status = pm_csv_open(path, HEADER, WRITTEN_BY, &csv);
    if (status == PM_OK) {
        status = read_rows(&csv, scene, &to);
    }
    pm_csv_close(&csv);
    for (int kind = 0; kind < PM_TREE_KINDS; kind++) {
        if (status == PM_OK) {
            searches[kind] = to.searches[kind];
        } else {
            pm_visit_table_free(&to.searches[kind]);
        }
    }
    return status;
}

void pm_visit_table_free(pm_visit_set *search)
{
    free(search->visits);
    *search = (pm_visit_set){0};
}

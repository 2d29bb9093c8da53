// A photon was kept when it was nearer than what the search wanted just before it: so what the
// table says of a search is the search's own doing.
#include "visit_dump.h"

#include <math.h>
#include <stdlib.h>

void pm_visit_list_add(void *witness, uint32_t index, double limit2)
{
    pm_visit_list *list = witness;
    if (list->count == list->room) {
        uint64_t room = list->room == 0 ? 256 : 2 * list->room;
        pm_visit *bigger = realloc(list->visits, (size_t)room * sizeof *bigger);
        if (bigger == NULL) {
            list->full = true;
            return;
        }
        list->visits = bigger;
        list->room = room;
    }
    list->visits[list->count++] = (pm_visit){index, limit2};
}

void pm_visit_list_free(pm_visit_list *list)
{
    free(list->visits);
    *list = (pm_visit_list){0};
}

static int compare(const void *a, const void *b)
{
    uint32_t x = *(const uint32_t *)a;
    uint32_t y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/// The answer's photons in ascending order; NULL without memory.
static uint32_t *sort_answer(const pm_watched *w)
{
    uint32_t *answer = malloc(((size_t)w->found + 1) * sizeof *answer);
    if (answer != NULL) {
        for (uint32_t i = 0; i < w->found; i++) {
            answer[i] = w->nearest[i].index;
        }
        qsort(answer, w->found, sizeof *answer, compare);
    }
    return answer;
}

static void write_radius(FILE *out, double limit2)
{
    if (isfinite(limit2)) {
        fprintf(out, "%.9g,", sqrt(limit2));
    } else {
        fputs("none,", out);
    }
}

static void write_point(FILE *out, pm_vec3 at, const char *end)
{
    fprintf(out, "%.9g,%.9g,%.9g%s", at.x, at.y, at.z, end);
}

static pm_vec3 place(const float at[3])
{
    return pm_vec((double)at[0], (double)at[1], (double)at[2]);
}

static void write_visit(FILE *out, const pm_watched *w, uint64_t order, bool found,
                        pm_vec3 center)
{
    const pm_visit *visit = &w->seen->visits[order];
    pm_tree_cell cell = pm_tree_cell_of(w->tree, visit->photon);
    pm_vec3 at = place(w->tree->photons[visit->photon].position);
    pm_vec3 away = pm_vec_sub(at, w->search->at);
    double distance2 = pm_vec_dot(away, away);
    double before = order > 0 ? visit[-1].limit2 : nextafter(w->search->radius2, HUGE_VAL);
    fprintf(out, "%s,%u,%u,", w->tree->name, w->tree->count, w->search->k);
    write_point(out, pm_vec_add(w->search->at, center), ",");
    fprintf(out, "%llu,%u,%u,%c,", (unsigned long long)order + 1, visit->photon, cell.depth,
            "xyz"[cell.axis]);
    write_point(out, pm_vec_add(at, center), ",");
    fprintf(out, "%.9g,%d,%d,", sqrt(distance2), distance2 < before, found);
    write_radius(out, visit->limit2);
    write_point(out, pm_vec_add(place(cell.low), center), ",");
    write_point(out, pm_vec_add(place(cell.high), center), "\n");
}

/// The picture of a search is of no use when the search kept something to itself.
static pm_status check_watched(const pm_watched *w)
{
    const pm_visit_list *seen = w->seen;
    if (seen->full) {
        return PM_FAIL(PM_ENOMEM, "no memory for more than %llu visits",
                       (unsigned long long)seen->count);
    }
    if (seen->count != w->visited) {
        return PM_FAIL(PM_EINPUT,
                       "the search looked at %llu photons, but told of %llu; it must call "
                       "search->visit for each of them",
                       (unsigned long long)w->visited, (unsigned long long)seen->count);
    }
    for (uint64_t i = 0; i < seen->count; i++) {
        if (seen->visits[i].photon >= w->tree->count) {
            return PM_FAIL(PM_EINPUT, "the search told of photon %u of %u",
                           seen->visits[i].photon, w->tree->count);
        }
    }
    return PM_OK;
}

pm_status pm_visit_dump(FILE *out, const pm_watched *watched, pm_vec3 center)
{
    PM_TRY(check_watched(watched));
    uint32_t *answer = sort_answer(watched);
    if (answer == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %u photons found", watched->found);
    }
    for (uint64_t i = 0; i < watched->seen->count; i++) {
        const uint32_t *photon = &watched->seen->visits[i].photon;
        bool found = bsearch(photon, answer, watched->found, sizeof *answer, compare) != NULL;
        write_visit(out, watched, i, found, center);
    }
    free(answer);
    return PM_OK;
}

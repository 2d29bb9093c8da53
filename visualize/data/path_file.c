// The rows are checked against each other as they come: a path is L, then events in step, then
// at most one of A, E, C. What gets through can be drawn without looking at it again.
#include "path_file.h"

#include "csv.h"

#include <stdlib.h>
#include <string.h>

#define EVENTS "LDSTVAEC"

enum { PHOTON, STEP, EVENT, X, Y, Z, RED, GREEN, BLUE };

typedef struct {
    pm_path_set set;
    uint64_t vertex_count, vertex_room, first_room, photon_room;
    uint64_t photon, step; // of the row before
    bool ended;
} reader;

/// The array with room for one element more, doubled when it is full; NULL without memory.
static void *grow(void *array, uint64_t count, uint64_t *room, size_t size)
{
    if (count < *room) {
        return array;
    }
    uint64_t wanted = *room == 0 ? 1024 : *room * 2;
    void *bigger = wanted <= SIZE_MAX / size ? realloc(array, (size_t)wanted * size) : NULL;
    *room = bigger != NULL ? wanted : *room;
    return bigger;
}

static pm_status no_room(const reader *to)
{
    return PM_FAIL(PM_ENOMEM, "no memory for %llu path vertices",
                   (unsigned long long)to->vertex_count + 1);
}

/// Begins a path; room for the entry behind the last is kept, too.
static pm_status add_path(reader *to, uint64_t photon)
{
    pm_path_set *set = &to->set;
    uint64_t *first = grow(set->first, set->path_count + 1, &to->first_room, sizeof *first);
    if (first == NULL) {
        return no_room(to);
    }
    set->first = first;
    uint64_t *photons = grow(set->photon, set->path_count, &to->photon_room, sizeof *photons);
    if (photons == NULL) {
        return no_room(to);
    }
    set->photon = photons;
    photons[set->path_count] = photon;
    first[set->path_count++] = to->vertex_count;
    return PM_OK;
}

static pm_status add_vertex(reader *to, pm_path_vertex vertex)
{
    pm_path_vertex *vertices =
        grow(to->set.vertices, to->vertex_count, &to->vertex_room, sizeof *vertices);
    if (vertices == NULL) {
        return no_room(to);
    }
    to->set.vertices = vertices;
    vertices[to->vertex_count++] = vertex;
    return PM_OK;
}

static pm_status read_event(const pm_csv *csv, char *event)
{
    const char *text = csv->field[EVENT];
    if (strlen(text) != 1 || strchr(EVENTS, text[0]) == NULL) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: event must be one of L D S T V A E C, got \"%.20s\"",
                              csv->path, csv->line, text);
    }
    *event = text[0];
    return PM_OK;
}

/// Is this row the next one of its path, or the first of a new one?
static pm_status check_order(const pm_csv *csv, const reader *to, uint64_t photon,
                             uint64_t step, char event)
{
    if ((event == 'L') != (step == 0)) {
        return pm_status_fail(
            PM_EINPUT,
            "%s:%ld: a path begins with event L at step 0 and has no other L, "
            "got %c at step %llu",
            csv->path, csv->line, event, (unsigned long long)step);
    }
    if (step == 0) {
        return PM_OK;
    }
    if (to->set.path_count == 0 || photon != to->photon || step != to->step + 1 || to->ended) {
        return pm_status_fail(
            PM_EINPUT, "%s:%ld: photon %llu step %llu does not follow the row before it",
            csv->path, csv->line, (unsigned long long)photon, (unsigned long long)step);
    }
    return PM_OK;
}

static pm_status read_row(const pm_csv *csv, const pm_scene *scene, reader *to)
{
    uint64_t photon = 0;
    uint64_t step = 0;
    pm_path_vertex vertex = {0};
    PM_TRY(pm_csv_count(csv, PHOTON, UINT64_MAX, &photon));
    PM_TRY(pm_csv_count(csv, STEP, UINT32_MAX, &step));
    PM_TRY(read_event(csv, &vertex.event));
    PM_TRY(pm_csv_point(csv, X, scene, &vertex.position));
    for (int c = 0; c < 3; c++) {
        PM_TRY(pm_csv_positive(csv, RED + c, &vertex.power.c[c]));
    }
    PM_TRY(check_order(csv, to, photon, step, vertex.event));
    if (step == 0) {
        PM_TRY(add_path(to, photon));
    }
    to->photon = photon;
    to->step = step;
    to->ended = strchr("AEC", vertex.event) != NULL;
    return add_vertex(to, vertex);
}

static pm_status read_rows(pm_csv *csv, const pm_scene *scene, reader *to)
{
    for (;;) {
        bool more = false;
        PM_TRY(pm_csv_next(csv, &more));
        if (!more) {
            break;
        }
        PM_TRY(read_row(csv, scene, to));
    }
    if (to->set.path_count == 0) {
        return pm_status_fail(PM_EINPUT, "%s:2: the file holds no path", csv->path);
    }
    to->set.first[to->set.path_count] = to->vertex_count;
    return PM_OK;
}

pm_status pm_path_file_read(const char *path, const pm_scene *scene, pm_path_set *paths)
{
    pm_csv csv;
    reader to = {0};
    pm_status status = pm_csv_open(path, PM_PATH_HEADER, "tracing --dump", &csv);
    if (status == PM_OK) {
        status = read_rows(&csv, scene, &to);
    }
    pm_csv_close(&csv);
    if (status != PM_OK) {
        pm_path_file_free(&to.set);
        return status;
    }
    *paths = to.set;
    return PM_OK;
}

void pm_path_file_free(pm_path_set *paths)
{
    free(paths->vertices);
    free(paths->first);
    free(paths->photon);
    *paths = (pm_path_set){0};
}

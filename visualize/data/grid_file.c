// Rows arrive as j, i = (0, 0), (0, 1) ... ; the first return to i = 0 fixes the grid's width.
#include "grid_file.h"

#include "csv.h"

#include <stdlib.h>

enum { I, J, X, Y, Z, NX, NY, NZ, RED, GREEN, BLUE, RADIUS, FOUND };

static pm_status grow(pm_grid_point **points, uint64_t count, uint64_t *room)
{
    if (count < *room) {
        return PM_OK;
    }
    uint64_t wanted = *room == 0 ? 4096 : *room * 2;
    pm_grid_point *bigger = wanted <= SIZE_MAX / sizeof *bigger
                                ? realloc(*points, (size_t)wanted * sizeof *bigger)
                                : NULL;
    if (bigger == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %llu grid points", (unsigned long long)wanted);
    }
    *points = bigger;
    *room = wanted;
    return PM_OK;
}

/// Refuses a point that is not number `count` of a grid with `columns` (0: still in its first
/// row).
static pm_status check_order(const pm_csv *csv, uint64_t count, uint64_t *columns)
{
    uint64_t i = 0;
    uint64_t j = 0;
    PM_TRY(pm_csv_count(csv, I, UINT32_MAX, &i));
    PM_TRY(pm_csv_count(csv, J, UINT32_MAX, &j));
    if (*columns == 0 && i == 0 && j == 1) {
        *columns = count;
    }
    uint64_t want_i = *columns == 0 ? count : count % *columns;
    uint64_t want_j = *columns == 0 ? 0 : count / *columns;
    if (i != want_i || j != want_j) {
        return pm_status_fail(
            PM_EINPUT, "%s:%ld: the next grid point is i,j = %llu,%llu, got %llu,%llu",
            csv->path, csv->line, (unsigned long long)want_i, (unsigned long long)want_j,
            (unsigned long long)i, (unsigned long long)j);
    }
    return PM_OK;
}

static pm_status read_point(const pm_csv *csv, const pm_scene *scene, pm_grid_point *point)
{
    PM_TRY(pm_csv_point(csv, X, scene, &point->position));
    PM_TRY(pm_csv_unit(csv, NX, &point->normal));
    for (int c = 0; c < 3; c++) {
        PM_TRY(pm_csv_positive(csv, RED + c, &point->irradiance.c[c]));
    }
    PM_TRY(pm_csv_positive(csv, RADIUS, &point->radius));
    return pm_csv_count(csv, FOUND, UINT64_MAX, &point->found);
}

static pm_status read_points(pm_csv *csv, const pm_scene *scene, pm_grid *grid)
{
    uint64_t room = 0;
    uint64_t count = 0;
    for (;; count++) {
        bool more = false;
        PM_TRY(pm_csv_next(csv, &more));
        if (!more) {
            break;
        }
        PM_TRY(check_order(csv, count, &grid->columns));
        PM_TRY(grow(&grid->points, count, &room));
        PM_TRY(read_point(csv, scene, &grid->points[count]));
    }
    if (grid->columns < 2 || count % grid->columns != 0) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: a grid has at least 2 x 2 points and its last row "
                              "complete; the file ends after point %llu",
                              csv->path, csv->line, (unsigned long long)count);
    }
    grid->rows = count / grid->columns;
    return PM_OK;
}

pm_status pm_grid_file_read(const char *path, const pm_scene *scene, pm_grid *grid)
{
    pm_csv csv;
    pm_grid got = {0};
    pm_status status = pm_csv_open(path, PM_GRID_HEADER, "radiance --grid --dump", &csv);
    if (status == PM_OK) {
        status = read_points(&csv, scene, &got);
    }
    pm_csv_close(&csv);
    if (status != PM_OK) {
        pm_grid_file_free(&got);
        return status;
    }
    *grid = got;
    return PM_OK;
}

void pm_grid_file_free(pm_grid *grid)
{
    free(grid->points);
    *grid = (pm_grid){0};
}

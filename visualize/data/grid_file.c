// Contracts are in the header.
#include "grid_file.h"

#include "grid_order.h"

#include <stdlib.h>

enum { X = 2, Y, Z, NX, NY, NZ, RED, GREEN, BLUE, RADIUS, FOUND };

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
        PM_TRY(pm_grid_order_check(csv, count, &grid->columns));
        PM_TRY(grow(&grid->points, count, &room));
        PM_TRY(read_point(csv, scene, &grid->points[count]));
    }
    return pm_grid_order_end(csv, count, grid->columns, &grid->rows);
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

// Contracts are in the header.
#include "edge_file.h"

#include "grid_order.h"

#include <stdlib.h>

#define SAME 1e-5 // of the grid's diagonal: numbers in the files have nine digits

enum { X = 2, FIRST_KERNEL = 5 };

const char *pm_edge_file_kernel(int kernel)
{
    static const char *const names[PM_EDGE_KERNELS] = {
        "none",         "cone",         "gaussian",         "epanechnikov",
        "none-lecture", "cone-lecture", "gaussian-lecture", "epanechnikov-lecture",
        "differential"};
    return names[kernel];
}

static pm_status grow(pm_edge_point **points, uint64_t count, uint64_t *room)
{
    if (count < *room) {
        return PM_OK;
    }
    uint64_t wanted = *room == 0 ? 4096 : *room * 2;
    pm_edge_point *bigger = wanted <= SIZE_MAX / sizeof *bigger
                                ? realloc(*points, (size_t)wanted * sizeof *bigger)
                                : NULL;
    if (bigger == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %llu grid points", (unsigned long long)wanted);
    }
    *points = bigger;
    *room = wanted;
    return PM_OK;
}

static pm_status read_point(const pm_csv *csv, const pm_scene *scene, pm_edge_point *point)
{
    PM_TRY(pm_csv_point(csv, X, scene, &point->position));
    for (int kernel = 0; kernel < PM_EDGE_KERNELS; kernel++) {
        PM_TRY(pm_csv_positive(csv, FIRST_KERNEL + kernel, &point->irradiance[kernel]));
    }
    return PM_OK;
}

static pm_status read_points(pm_csv *csv, const pm_scene *scene, pm_edge_grid *grid)
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

pm_status pm_edge_file_read(const char *path, const pm_scene *scene, pm_edge_grid *grid)
{
    pm_csv csv;
    pm_edge_grid got = {0};
    pm_status status = pm_csv_open(path, PM_EDGE_HEADER, "filtering --grid --dump", &csv);
    if (status == PM_OK) {
        status = read_points(&csv, scene, &got);
    }
    pm_csv_close(&csv);
    if (status != PM_OK) {
        pm_edge_file_free(&got);
        return status;
    }
    *grid = got;
    return PM_OK;
}

static pm_status check_same(const char *path, const pm_edge_grid *first,
                            const pm_edge_grid *second)
{
    if (first->columns != second->columns || first->rows != second->rows) {
        return pm_status_fail(
            PM_EINPUT,
            "%s:2: this grid has %llu x %llu points, the first file's has "
            "%llu x %llu",
            path, (unsigned long long)second->columns, (unsigned long long)second->rows,
            (unsigned long long)first->columns, (unsigned long long)first->rows);
    }
    uint64_t count = first->columns * first->rows;
    pm_vec3 across = pm_vec_sub(first->points[count - 1].position, first->points[0].position);
    for (uint64_t n = 0; n < count; n++) {
        pm_vec3 off = pm_vec_sub(first->points[n].position, second->points[n].position);
        if (pm_vec_length(off) > SAME * pm_vec_length(across)) {
            return pm_status_fail(PM_EINPUT,
                                  "%s:%llu: this point is %g m from that of the first file: "
                                  "both must have the same --on, --grid and --part",
                                  path, (unsigned long long)n + 2, pm_vec_length(off));
        }
    }
    return PM_OK;
}

pm_status pm_edge_file_read_same(const char *path, const pm_scene *scene,
                                 const pm_edge_grid *first, pm_edge_grid *grid)
{
    pm_edge_grid got;
    PM_TRY(pm_edge_file_read(path, scene, &got));
    pm_status status = check_same(path, first, &got);
    if (status != PM_OK) {
        pm_edge_file_free(&got);
        return status;
    }
    *grid = got;
    return PM_OK;
}

void pm_edge_file_free(pm_edge_grid *grid)
{
    free(grid->points);
    *grid = (pm_edge_grid){0};
}

// What gets through is a unit vector to the digits that the file has: directions are drawn on a
// unit sphere, and one that a student forgot to normalise must not be taken for a good one.
#include "ray_file.h"

#include "csv.h"
#include "emit_dump.h"

#include <stdlib.h>

#define UNIT_WITHIN 1e-6

enum { ORIGIN = 0, DIRECTION = 3, POWER = 6, LIGHT = 9 };

static pm_status read_direction(const pm_csv *csv, pm_vec3 *direction)
{
    pm_vec3 way;
    PM_TRY(pm_csv_number(csv, DIRECTION, &way.x));
    PM_TRY(pm_csv_number(csv, DIRECTION + 1, &way.y));
    PM_TRY(pm_csv_number(csv, DIRECTION + 2, &way.z));
    double length = pm_vec_length(way);
    if (!(fabs(length - 1.0) <= UNIT_WITHIN)) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: a direction must have the length 1, got %.7g; normalise "
                              "it",
                              csv->path, csv->line, length);
    }
    *direction = way;
    return PM_OK;
}

static pm_status read_light(const pm_csv *csv, const pm_scene *scene, uint32_t *light)
{
    uint64_t index = 0;
    PM_TRY(pm_csv_count(csv, LIGHT, UINT32_MAX, &index));
    if (index >= (uint64_t)scene->light_count) {
        return pm_status_fail(PM_EINPUT,
                              "%s:%ld: light %llu is not in %s, which has %d (counted from 0): "
                              "the file comes from another scene",
                              csv->path, csv->line, (unsigned long long)index, scene->path,
                              scene->light_count);
    }
    *light = (uint32_t)index;
    return PM_OK;
}

static pm_status read_row(const pm_csv *csv, const pm_scene *scene, pm_ray_start *ray)
{
    PM_TRY(pm_csv_point(csv, ORIGIN, scene, &ray->origin));
    PM_TRY(read_direction(csv, &ray->direction));
    for (int c = 0; c < 3; c++) {
        PM_TRY(pm_csv_positive(csv, POWER + c, &ray->power.c[c]));
    }
    return read_light(csv, scene, &ray->light);
}

/// Room for one ray more.
static pm_status grow(pm_ray_set *set, uint64_t *room)
{
    if (set->count < *room) {
        return PM_OK;
    }
    uint64_t wanted = *room == 0 ? 1024 : *room * 2;
    pm_ray_start *moved = wanted <= SIZE_MAX / sizeof *moved
                              ? realloc(set->rays, (size_t)wanted * sizeof *moved)
                              : NULL;
    if (moved == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for %llu rays", (unsigned long long)wanted);
    }
    set->rays = moved;
    *room = wanted;
    return PM_OK;
}

static pm_status read_rows(pm_csv *csv, const pm_scene *scene, pm_ray_set *set)
{
    uint64_t room = 0;
    for (;;) {
        bool more = false;
        PM_TRY(pm_csv_next(csv, &more));
        if (!more) {
            break;
        }
        PM_TRY(grow(set, &room));
        PM_TRY(read_row(csv, scene, &set->rays[set->count]));
        set->count++;
    }
    return set->count > 0
               ? PM_OK
               : pm_status_fail(PM_EINPUT, "%s:2: the file holds no ray: no light sends any",
                                csv->path);
}

pm_status pm_ray_file_read(const char *path, const pm_scene *scene, pm_ray_set *rays)
{
    pm_csv csv;
    pm_ray_set set = {0};
    pm_status status = pm_csv_open(path, PM_RAY_HEADER, "emission --dump", &csv);
    if (status == PM_OK) {
        status = read_rows(&csv, scene, &set);
    }
    pm_csv_close(&csv);
    if (status != PM_OK) {
        pm_ray_file_free(&set);
        return status;
    }
    *rays = set;
    return PM_OK;
}

void pm_ray_file_free(pm_ray_set *rays)
{
    free(rays->rays);
    *rays = (pm_ray_set){0};
}

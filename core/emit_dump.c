// A light that has nothing to reach has one dark cell, whatever its kind; every other
// projection is cut as cells.h cuts it.
#include "emit_dump.h"

#include "cells.h"

void pm_emit_dump_ray(FILE *to, const pm_scene *scene, const pm_start *start, uint64_t emitted)
{
    pm_vec3 from = pm_vec_add(start->ray.origin, scene->center);
    pm_vec3 way = start->ray.direction;
    pm_spectrum watts = pm_spectrum_scale(start->power, 1.0 / (double)emitted);
    fprintf(to, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%u\n", from.x, from.y, from.z,
            way.x, way.y, way.z, watts.c[0], watts.c[1], watts.c[2], start->light);
}

/// Where row `row` of `rows` begins, as far from the axis as the light's square says.
static double border_of(const pm_cells *cells, bool cut, uint32_t row, uint32_t rows)
{
    if (!cut) {
        return PM_PI * row / rows;
    }
    return cells->border[(size_t)row * PM_CELLS_ROWS / rows];
}

static void dump_light(FILE *to, const pm_scene *scene, const char *map, int light,
                       const pm_projection *projection)
{
    pm_cells cells;
    bool cut = pm_cells_begin(scene, &scene->lights[light], &cells);
    const double turn = 2.0 * PM_PI / projection->columns;
    uint32_t next = 0; // of the lit ones
    for (uint32_t i = 0; i < projection->rows * projection->columns; i++) {
        uint32_t row = i / projection->columns;
        uint32_t column = i % projection->columns;
        bool lit = next < projection->lit_count && projection->lit[next] == i;
        next += lit;
        fprintf(to, "%s,%d,%d,%u,%u,%.9g,%.9g,%.9g,%.9g,%d\n", map, light, cut && cells.flat,
                row, column, border_of(&cells, cut, row, projection->rows),
                border_of(&cells, cut, row + 1, projection->rows), turn * column,
                turn * (column + 1), lit);
    }
}

void pm_emit_dump_cells(FILE *to, const pm_scene *scene, const char *map,
                        const pm_projections *projections)
{
    for (int i = 0; i < projections->light_count && projections->light != NULL; i++) {
        if (projections->light[i].rows > 0) {
            dump_light(to, scene, map, i, &projections->light[i]);
        }
    }
}

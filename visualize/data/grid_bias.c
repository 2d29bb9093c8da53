// A grid's points stand in the middles of equal cells, so the edge is half a cell beyond the
// outermost ones.
#include "grid_bias.h"

#include <math.h>
#include <stdlib.h>

/// The middle third of `count` places, at least one.
typedef struct {
    uint64_t first, end;
} span;

static span third_of(uint64_t count)
{
    return (span){count / 3, count - count / 3};
}

static double luminance_at(const pm_grid *grid, uint64_t i, uint64_t j)
{
    return pm_spectrum_luminance(grid->points[j * grid->columns + i].irradiance);
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

pm_status pm_grid_bias_truth(const pm_grid *const *grids, int count, double *truth)
{
    uint64_t room = 0;
    for (int g = 0; g < count; g++) {
        room += grids[g]->columns * grids[g]->rows;
    }
    double *values = malloc((size_t)(room > 0 ? room : 1) * sizeof *values);
    if (values == NULL) {
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for a median");
    }
    size_t used = 0;
    for (int g = 0; g < count; g++) {
        span across = third_of(grids[g]->columns);
        span down = third_of(grids[g]->rows);
        for (uint64_t j = down.first; j < down.end; j++) {
            for (uint64_t i = across.first; i < across.end; i++) {
                values[used++] = luminance_at(grids[g], i, j);
            }
        }
    }
    qsort(values, used, sizeof *values, compare);
    *truth = 0.5 * (values[used / 2] + values[(used - 1) / 2]);
    free(values);
    return PM_OK;
}

/// Mean luminance over columns and rows.
static double mean_over(const pm_grid *grid, span across, span down)
{
    double sum = 0.0;
    for (uint64_t j = down.first; j < down.end; j++) {
        for (uint64_t i = across.first; i < across.end; i++) {
            sum += luminance_at(grid, i, j);
        }
    }
    return sum / (double)((across.end - across.first) * (down.end - down.first));
}

static void sum_up(const pm_grid *grid, double truth, pm_grid_bias *bias)
{
    uint64_t last_i = grid->columns - 1;
    uint64_t last_j = grid->rows - 1;
    span middle = third_of(grid->rows);
    double ends = mean_over(grid, (span){0, 1}, middle) +
                  mean_over(grid, (span){last_i, last_i + 1}, middle);
    bias->middle = mean_over(grid, third_of(grid->columns), middle) / truth;
    bias->edge = 0.5 * ends / truth;
    bias->corner = 0.25 *
                   (luminance_at(grid, 0, 0) + luminance_at(grid, last_i, 0) +
                    luminance_at(grid, 0, last_j) + luminance_at(grid, last_i, last_j)) /
                   truth;
    uint64_t count = grid->columns * grid->rows;
    uint64_t reached = 0;
    for (uint64_t n = 0; n < count; n++) {
        reached += grid->points[n].found > 0;
        bias->radius += grid->points[n].radius;
        bias->found += (double)grid->points[n].found / (double)count;
    }
    bias->radius /= reached > 0 ? (double)reached : 1.0;
}

static double mean_radius(const pm_grid *grid, uint64_t i, span down)
{
    double sum = 0.0;
    for (uint64_t j = down.first; j < down.end; j++) {
        sum += grid->points[j * grid->columns + i].radius;
    }
    return sum / (double)(down.end - down.first);
}

static void follow_rows(const pm_grid *grid, double truth, pm_grid_bias *bias)
{
    span middle = third_of(grid->rows);
    double cell = pm_vec_length(pm_vec_sub(grid->points[1].position, grid->points[0].position));
    for (uint64_t i = 0; i < grid->columns; i++) {
        uint64_t from_end = i < grid->columns - 1 - i ? i : grid->columns - 1 - i;
        double radius = mean_radius(grid, i, middle);
        if (!(radius > 0.0)) {
            bias->unreachable++;
            continue;
        }
        bias->distance[bias->count] = ((double)from_end + 0.5) * cell / radius;
        bias->ratio[bias->count++] = mean_over(grid, (span){i, i + 1}, middle) / truth;
    }
}

pm_status pm_grid_bias_make(const pm_grid *grid, double truth, pm_grid_bias *bias)
{
    pm_grid_bias made = {0};
    made.distance = malloc((size_t)grid->columns * sizeof *made.distance);
    made.ratio = malloc((size_t)grid->columns * sizeof *made.ratio);
    if (made.distance == NULL || made.ratio == NULL) {
        pm_grid_bias_free(&made);
        return PM_FAIL(PM_ENOMEM, "%s", "no memory for a profile");
    }
    sum_up(grid, truth, &made);
    follow_rows(grid, truth, &made);
    *bias = made;
    return PM_OK;
}

void pm_grid_bias_free(pm_grid_bias *bias)
{
    free(bias->distance);
    free(bias->ratio);
    *bias = (pm_grid_bias){0};
}

double pm_grid_bias_disc(double distance)
{
    if (distance >= 1.0) {
        return 1.0;
    }
    return 1.0 - (acos(distance) - distance * sqrt(1.0 - distance * distance)) / PM_PI;
}

double pm_grid_bias_sphere(double distance)
{
    double across2 = fmax(1.0 - distance * distance, 0.0);
    return pm_grid_bias_disc(distance) + 0.5 * across2;
}

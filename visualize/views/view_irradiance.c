// view irradiance: light arriving on a surface, as a heat map.
#include "draw_irradiance.h"
#include "grid_file.h"
#include "view.h"
#include "view_kinds.h"

#include <math.h>

/// Least and most of what the points tell.
typedef struct {
    uint64_t fewest, most; // photons
    double narrow, wide;   // radius [m]
} extremes;

static extremes measure(const pm_grid *grid)
{
    extremes e = {UINT64_MAX, 0, HUGE_VAL, 0.0};
    for (uint64_t i = 0; i < grid->columns * grid->rows; i++) {
        const pm_grid_point *point = &grid->points[i];
        e.fewest = point->found < e.fewest ? point->found : e.fewest;
        e.most = point->found > e.most ? point->found : e.most;
        e.narrow = fmin(e.narrow, point->radius);
        e.wide = fmax(e.wide, point->radius);
    }
    return e;
}

static void write_note(pm_view *view, const pm_grid *grid)
{
    extremes e = measure(grid);
    pm_view_note(view,
                 "light arriving on a square metre, estimated from the photons nearest to each "
                 "point\n%llu x %llu points, ",
                 (unsigned long long)grid->columns, (unsigned long long)grid->rows);
    if (e.fewest < e.most) {
        pm_view_note(view, "%llu to ", (unsigned long long)e.fewest);
    }
    pm_view_note(view, "%llu photons each, within ", (unsigned long long)e.most);
    if (e.narrow < e.wide) {
        pm_view_note(view, "%.3g to ", e.narrow);
    }
    pm_view_note(view, "%.3g m", e.wide);
}

static pm_status draw(pm_view *view)
{
    pm_grid grid;
    PM_TRY(pm_grid_file_read(view->files[0], &view->scene, &grid));
    view->drawn = grid.columns * grid.rows;
    write_note(view, &grid);
    pm_status status = pm_draw_irradiance(view->figure, &grid);
    pm_grid_file_free(&grid);
    return status;
}

const pm_view_kind pm_view_irradiance = {
    .name = "irradiance",
    .files = "GRID.csv (radiance --grid --dump)",
    .shows = "light on a surface, with a scale",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_IN_SCENE,
    .options = "",
    .title = "Irradiance: how much light arrives",
    .draw = draw,
};

// view irradiance: light arriving on a surface, as a heat map.
#include "draw_irradiance.h"
#include "grid_file.h"
#include "view.h"
#include "view_kinds.h"

static pm_status draw(pm_view *view)
{
    pm_grid grid;
    PM_TRY(pm_grid_file_read(view->files[0], &view->scene, &grid));
    view->drawn = grid.columns * grid.rows;
    uint64_t fewest = UINT64_MAX;
    uint64_t most = 0;
    for (uint64_t i = 0; i < view->drawn; i++) {
        fewest = grid.points[i].found < fewest ? grid.points[i].found : fewest;
        most = grid.points[i].found > most ? grid.points[i].found : most;
    }
    pm_view_note(view,
                 "light arriving on a square metre, estimated from the photons nearest to each "
                 "point\n%llu x %llu points, ",
                 (unsigned long long)grid.columns, (unsigned long long)grid.rows);
    if (fewest < most) {
        pm_view_note(view, "%llu to ", (unsigned long long)fewest);
    }
    pm_view_note(view, "%llu photons each", (unsigned long long)most);
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
    .title = "Irradiance",
    .draw = draw,
};

// view paths: the ways that photons took.
#include "draw_paths.h"
#include "path_file.h"
#include "view.h"
#include "view_kinds.h"

static pm_status draw(pm_view *view)
{
    pm_path_set paths;
    char drawn[PM_VIEW_GROUPED_MAX];
    char all[PM_VIEW_GROUPED_MAX];
    PM_TRY(pm_path_file_read(view->files[0], &view->scene, &paths));
    pm_status status = pm_draw_paths(view->figure, &paths, view->options->paths, &view->drawn);
    pm_view_note(view,
                 "from the light until a surface absorbs them or they leave the scene\n"
                 "%s of %s paths drawn",
                 pm_view_grouped(view->drawn, drawn), pm_view_grouped(paths.path_count, all));
    pm_path_file_free(&paths);
    return status;
}

const pm_view_kind pm_view_paths = {
    .name = "paths",
    .files = "PATHS.csv (tracing --dump)",
    .shows = "the ways that photons took",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_IN_SCENE,
    .options = "paths",
    .title = "Photon paths",
    .draw = draw,
};

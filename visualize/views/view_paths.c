// view paths: the ways that photons took.
#include "draw_paths.h"
#include "path_by.h"
#include "path_file.h"
#include "view.h"
#include "view_kinds.h"

static void write_note(pm_view *view, uint64_t all, bool by_bounce)
{
    char drawn[PM_VIEW_GROUPED_MAX];
    char of[PM_VIEW_GROUPED_MAX];
    pm_view_note(view, "%s\n%s of %s paths drawn, picked evenly from the file",
                 by_bounce
                     ? "from yellow to purple, bounce by bounce; going into glass or out of "
                       "it is a bounce, too"
                     : "every photon leaves the light and flies until a surface absorbs "
                       "it or it leaves the scene",
                 pm_view_grouped(view->drawn, drawn), pm_view_grouped(all, of));
}

static pm_status draw(pm_view *view)
{
    pm_path_set paths;
    bool by_bounce = false;
    PM_TRY(pm_path_by(view, &by_bounce));
    PM_TRY(pm_path_file_read(view->files[0], &view->scene, &paths));
    pm_status status =
        pm_draw_paths(view->figure, &paths, view->options->paths, by_bounce, &view->drawn);
    write_note(view, paths.path_count, by_bounce);
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
    .options = "by paths",
    .title = "Photon paths",
    .draw = draw,
};

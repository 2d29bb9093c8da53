// view layers.
#include "view.h"
#include "view_kinds.h"

static pm_status draw(pm_view *view)
{
    return PM_FAIL(PM_ETODO, "view %s is not written yet", view->kind->name);
}

const pm_view_kind pm_view_layers = {
    .name = "layers",
    .files = "PICTURE.exr (render -o)",
    .shows = "not written yet",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_FOR_SCENE,
    .options = "",
    .title = "Layers",
    .draw = draw,
};

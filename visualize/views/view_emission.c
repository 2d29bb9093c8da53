// view emission.
#include "view.h"
#include "view_kinds.h"

static pm_status draw(pm_view *view)
{
    return PM_FAIL(PM_ETODO, "view %s is not written yet", view->kind->name);
}

const pm_view_kind pm_view_emission = {
    .name = "emission",
    .files = "RAYS.csv (emission --dump)",
    .shows = "not written yet",
    .files_least = 1,
    .files_most = 1,
    .scene = PM_VIEW_FOR_SCENE,
    .options = "",
    .title = "Emission",
    .draw = draw,
};

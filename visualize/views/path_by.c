// Paths have events and bounces; --by knows more words, for other kinds.
#include "path_by.h"

pm_status pm_path_by(const pm_view *view, bool *by_bounce)
{
    int by = view->options->by;
    if (by >= 0 && by != PM_BY_EVENT && by != PM_BY_BOUNCE) {
        return pm_status_fail(PM_EINPUT, "view: --by of %s must be event or bounce",
                              view->kind->name);
    }
    *by_bounce = by == PM_BY_BOUNCE;
    return PM_OK;
}

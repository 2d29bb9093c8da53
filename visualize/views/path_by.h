// What the colours of paths stand for, by --by.
#ifndef PM_PATH_BY_H
#define PM_PATH_BY_H

#include "view.h"

/// @param by_bounce  [out] by the bounces so far; else by event, as without --by
/// @return PM_EINPUT with a line for what paths do not have
pm_status pm_path_by(const pm_view *view, bool *by_bounce);

#endif

// How figures get their windows.
#ifndef PM_WINDOW_H
#define PM_WINDOW_H

#include "status.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Before the first figure is opened: draw on the X display, or (neither, the default) without
/// one where the system can.
/// @param interactive  a window is wanted, not only pictures
/// @return PM_EINPUT with a line when a display is wanted and none answers
pm_status pm_window_choose(bool x_display, bool interactive);

#ifdef __cplusplus
}
#endif
#endif

// How figures get their windows.
#ifndef PM_WINDOW_H
#define PM_WINDOW_H

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Before the first figure is opened: draw on the X display (true), or without one where the
/// system can (false, the default).
void pm_window_choose(bool x_display);

#ifdef __cplusplus
}
#endif
#endif

// The X display of the environment, opened by us and lent to VTK, which aborts where it cannot
// open one or finds no OpenGL on it.
#ifndef PM_X_DISPLAY_HH
#define PM_X_DISPLAY_HH

enum pm_x_answer {
    PM_X_UNSET, // DISPLAY is not set
    PM_X_DEAD,  // nobody answers there
    PM_X_FLAT,  // without OpenGL (GLX)
    PM_X_READY,
};

/// Opens the display. It stays open as long as the process lives, as do the libraries: Mesa
/// forgets memory when it is unloaded.
/// @param display  [out] Xlib's handle; untouched unless PM_X_READY
pm_x_answer pm_x_display_open(void **display);

#endif

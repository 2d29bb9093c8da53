// What the X display of the environment can do. VTK is never left to find out by itself,
// because it aborts.
#ifndef PM_X_DISPLAY_HH
#define PM_X_DISPLAY_HH

enum pm_x_display {
    PM_X_UNSET,   // DISPLAY is not set
    PM_X_DEAD,    // nobody answers there
    PM_X_FLAT,    // without OpenGL (GLX)
    PM_X_DRAWING, // ready for windows
};

/// Opens the display, asks, and closes it.
pm_x_display pm_x_display_probe();

#endif

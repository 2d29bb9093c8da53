// A render window that needs no display.
#ifndef PM_WINDOW_HH
#define PM_WINDOW_HH

#include "core.hh"

#include <vtkRenderWindow.h>
#include <vtkSmartPointer.h>

/// Opens an offscreen window: without any display through surfaceless EGL; failing that, on the
/// X display if there is one that answers. VTK is never left to open a display by itself,
/// because it aborts when there is none.
/// @param window  [out]
/// @return PM_ELIMIT with a line that says what to install
pm_status pm_window_open(int width, int height, vtkSmartPointer<vtkRenderWindow> *window);

#endif

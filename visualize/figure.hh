// The inside of a figure, for the C++ files that draw on it.
#ifndef PM_FIGURE_HH
#define PM_FIGURE_HH

#include "core.hh"
#include "figure.h"

#include <vtkPolyData.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>

#include <exception>
#include <new>
#include <stdexcept>
#include <string>

struct pm_figure {
    pm_viewpoint viewpoint;
    vtkSmartPointer<vtkRenderWindow> window;
    vtkSmartPointer<vtkRenderer> renderer;
    double
        column_top; // where the next block of the right column starts, pixels from the bottom

    /// A length in pixels that is `at900` in a picture 900 pixels high.
    double pixels(double at900) const
    {
        return at900 * viewpoint.height / 900.0;
    }

    /// Left edge of the right column, in pixels.
    double column_left() const
    {
        return (1.0 - PM_VIEWPOINT_RIGHT) * viewpoint.width + pixels(22.0);
    }
};

/// Puts a drawing in pixel coordinates (from the bottom left) over the scene.
void pm_figure_overlay(pm_figure *figure, vtkPolyData *data, double line_width);

/// Runs the body of a C function: no C++ exception leaves it.
template <class Body> pm_status pm_figure_guard(const char *what, Body body) noexcept
{
    try {
        return body();
    } catch (const std::bad_alloc &) {
        return PM_FAIL(PM_ENOMEM, "no memory for %s", what);
    } catch (const std::exception &fault) {
        return PM_FAIL(PM_ELIMIT, "%s: %s", what, fault.what());
    } catch (...) {
        return PM_FAIL(PM_ELIMIT, "%s: VTK failed", what);
    }
}

#endif

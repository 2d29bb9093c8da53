// The inside of a figure, for the C++ files that draw on it.
#ifndef PM_FIGURE_HH
#define PM_FIGURE_HH

#include "core.hh"
#include "figure.h"

#include <vtkActor.h>
#include <vtkPolyData.h>
#include <vtkProp.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

/// A view of a scene on the page.
struct pm_panel {
    pm_rect where;
    pm_viewpoint viewpoint;
    vtkSmartPointer<vtkRenderer> renderer;
};

/// A scalar bar as it stands on the page.
struct pm_drawn_scale {
    std::string heading;
    double low, high;
    bool logarithmic;
    pm_rect where;
};

/// A chart as it stands on the page: the rectangle between its axes and what their ends mean.
struct pm_drawn_chart {
    std::string heading;
    pm_rect where;
    double x_low, x_high, y_low, y_high;
    bool x_log, y_log;
    std::vector<std::string> x_labels, y_labels; // in order along the axes
};

/// Numbers behind what was drawn, in centred world space: written by pm_figure_export(), told
/// by a pick.
struct pm_dataset {
    std::string name; // "photon", "split plane": what one of its cells is
    vtkSmartPointer<vtkPolyData> data;
    vtkSmartPointer<vtkRenderer> renderer; // of the panel that shows it
};

/// What depends on where it is seen from, as a ball's outline does: drawn anew for another eye
/// (centred), and with nothing to draw it is empty.
using pm_drawn_for = std::function<vtkSmartPointer<vtkPolyData>(pm_vec3 eye)>;
struct pm_facing {
    vtkSmartPointer<vtkActor> actor;
    pm_drawn_for draw;
    vtkSmartPointer<vtkRenderer> renderer;
};

/// A word at a point of a panel's scene.
struct pm_drawn_mark {
    vtkSmartPointer<vtkTextActor> words;
    pm_vec3 at;
    vtkSmartPointer<vtkRenderer> renderer;
};

struct pm_chart;

struct pm_figure {
    int width, height; // pixels
    vtkSmartPointer<vtkRenderWindow> window;
    vtkSmartPointer<vtkRenderer> page;     // words and flat pictures, over the panels
    vtkSmartPointer<vtkRenderer> renderer; // of the current panel; the page without one
    pm_viewpoint viewpoint;                // of the current panel
    double column_top; // where the next block of the right column starts, from the bottom
    std::vector<pm_panel> panels;
    std::vector<pm_drawn_scale> scales;
    std::vector<pm_drawn_chart> charts;
    std::vector<std::shared_ptr<pm_chart>> open_charts; // and closed ones
    std::vector<pm_dataset> datasets;
    std::vector<pm_drawn_mark> marks;
    std::vector<vtkSmartPointer<vtkProp>> scenery; // the scene, drawn faintly
    std::vector<pm_facing> facing;
    const pm_scene *scene; // of the scenery, or NULL; it outlives the figure

    /// A length in pixels that is `at900` in a picture 900 pixels high.
    double pixels(double at900) const
    {
        return at900 * height / 900.0;
    }

    /// Left edge of the right column, in pixels.
    double column_left() const
    {
        return (1.0 - PM_VIEWPOINT_RIGHT) * width + pixels(22.0);
    }
};

/// Puts a drawing in pixel coordinates (from the bottom left) over the panels.
void pm_figure_overlay(pm_figure *figure, vtkPolyData *data, double line_width);

/// Keeps the numbers behind what is drawn. Arrays belong to points or cells and have names with
/// their units where they have one ("power [W]").
void pm_figure_keep(pm_figure *figure, const char *name, vtkPolyData *data);

/// Puts the scene's own surfaces and edges in the current panel.
void pm_figure_scenery(pm_figure *figure, const pm_scene *scene, vtkProp *prop);

/// The same for what looks different from elsewhere; `actor` shows it as it is seen now.
void pm_figure_facing(pm_figure *figure, vtkActor *actor, const pm_drawn_for &draw);

/// VTK's messages go to a listener of ours: forgets what it heard, or returns the first line of
/// the first error since, "" when there was none.
void pm_figure_forget_faults();
std::string pm_figure_fault();

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

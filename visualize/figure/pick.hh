// What is under the pointer: a dot, a line, a face of the data, else a surface of the scene.
#ifndef PM_PICK_HH
#define PM_PICK_HH

#include "figure.hh"

#include <string>

struct pm_pick {
    std::string text; // one line; "" when nothing is there
    pm_vec3 at;       // [m] centred
};

/// Finds what is at a pixel.
/// @param x, y    from the window's bottom left
/// @param center  added to what is told
pm_pick pm_pick_at(const pm_figure *figure, vtkRenderer *panel, double x, double y,
                   pm_vec3 center);

/// The datum of a chart there, or "".
/// @param x, y  from the window's bottom left
std::string pm_pick_on_chart(const pm_figure *figure, double x, double y);

#endif

// Coloured dots, lines and polygons on their way into VTK: every vertex has its own colour.
#ifndef PM_DRAWING_HH
#define PM_DRAWING_HH

#include "colours.h"
#include "core.hh"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <vector>

class pm_drawing {
  public:
    pm_drawing();

    /// `opacity` lies in [0, 1]; positions are centred world space, or pixels for overlays.
    vtkIdType vertex(pm_vec3 at, pm_colour colour, double opacity);
    void dot(pm_vec3 at, pm_colour colour, double opacity);
    void line(pm_vec3 from, pm_vec3 to, pm_colour colour, double opacity);
    void fading_line(pm_vec3 from, pm_vec3 to, pm_colour colour, double opacity,
                     double at_end = 0.0);
    /// `corner` in order around it.
    void quad(const pm_vec3 corner[4], pm_colour colour, double opacity);
    void outline(const std::vector<pm_vec3> &rim, pm_colour colour, double opacity);
    void polygon(const std::vector<pm_vec3> &rim, pm_colour colour, double opacity);
    void triangle(vtkIdType a, vtkIdType b, vtkIdType c);

    vtkSmartPointer<vtkPolyData> data() const;

    /// Unlit, in the vertices' own colours; widths in pixels. Faces are pushed back by `push`
    /// (steps of the depth buffer, and slope), so that what lies on them wins.
    vtkSmartPointer<vtkActor> actor(double line_width, double dot_size,
                                    double push = 1.0) const;

  private:
    vtkNew<vtkPoints> points;
    vtkNew<vtkUnsignedCharArray> colours;
    vtkNew<vtkCellArray> dots, lines, faces;
};

#endif

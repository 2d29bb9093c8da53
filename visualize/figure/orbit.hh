// A panel's camera moved by hand: around the middle of what it shows.
#ifndef PM_ORBIT_HH
#define PM_ORBIT_HH

#include "figure.hh"

#include <vtkCamera.h>
#include <vtkNew.h>

/// A panel that is looked around in.
struct pm_orbit {
    explicit pm_orbit(const pm_panel &panel);

    /// Turns what is seen as if a ball around it were dragged by (dx, dy) pixels, y up.
    void turn(double dx, double dy);
    void shift(double dx, double dy);
    /// Nearer by this factor of the distance, farther above 1.
    void approach(double factor);
    void reset();

    /// Before drawing: all that the figure showed stays in view, whatever the panel's shape.
    void fit();

    pm_panel panel;

  private:
    double pivot[3];
    vtkNew<vtkCamera> first; // as the picture has it
};

#endif

// Paths as strokes: how far photons have come after a length of way that is the same for all,
// and what has happened to them up to there. A still picture shows the whole way, a film a bit
// more in each frame.
#ifndef PM_PATH_STROKES_HH
#define PM_PATH_STROKES_HH

#include "core.hh"
#include "drawing.hh"
#include "figure.hh"
#include "figure_data.h"
#include "path_look.h"

#include <cstdint>

class pm_path_strokes {
  public:
    /// @param by_bounce  coloured by the bounces so far, else by what happened last
    /// @param paths      that will be added: the more they are, the fainter is what all do
    pm_path_strokes(bool by_bounce, uint64_t paths);

    /// Adds one path of `count` vertices up to `reach` [m] from its light, measured along it.
    void add(const pm_path_vertex *path, uint64_t count, double reach);

    /// Puts it on the current panel.
    /// @return the actors, for a film that takes them off again
    std::vector<vtkSmartPointer<vtkActor>> show(pm_figure *figure) const;

    // What was added, by kind of event and by bounces so far: vertices, and stretches begun.
    uint64_t events[PM_PATH_EVENTS] = {};
    uint64_t bounces[PM_PATH_BOUNCES] = {};
    uint64_t moving = 0; // photons that are still on their way

  private:
    pm_colour colour_from(const pm_path_vertex *path, uint64_t i) const;
    double opacity_from(const pm_path_vertex *path, uint64_t i) const;
    void stretch(const pm_path_vertex *path, uint64_t i, double part);

    pm_drawing faint, bright, dots, heads;
    bool by_bounce;
    double common; // opacity of the stretches that every path has
};

/// Length [m] of a path of `count` vertices.
double pm_path_length(const pm_path_vertex *path, uint64_t count);

#endif

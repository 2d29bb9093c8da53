// The page in a window: it grows and shrinks with it, and words at points of a scene follow
// them.
#ifndef PM_PAGE_LAYOUT_HH
#define PM_PAGE_LAYOUT_HH

#include "figure.hh"

#include <vtkActor2D.h>
#include <vtkChartXY.h>
#include <vtkImageMapper.h>
#include <vtkPoints.h>

#include <vector>

/// Where a point of a panel's scene is seen, in pixels of the window from its bottom left;
/// false when it is not.
bool pm_page_place(vtkRenderer *renderer, pm_vec3 at, double place[2]);

class pm_page_layout {
  public:
    /// Remembers everything as it stands on the figure's page now.
    explicit pm_page_layout(pm_figure *figure);

    /// Lays it out for the window's size: places by the window's sides, letters and pictures by
    /// the smaller of the two, so that nothing overlaps that did not before.
    void resize();

    /// Words at points of a scene go where their point is seen, or hide; balls keep their
    /// outlines.
    void follow();

    bool marks_shown = true;

  private:
    struct words {
        vtkSmartPointer<vtkTextActor> actor;
        double x, y;
        int size;
    };
    struct drawing {
        vtkSmartPointer<vtkPolyData> data;
        vtkSmartPointer<vtkPoints> points;
    };
    struct picture {
        vtkSmartPointer<vtkActor2D> actor;
        vtkSmartPointer<vtkImageMapper> mapper;
        double x, y, width, height;
    };
    struct chart {
        vtkSmartPointer<vtkChartXY> chart;
        vtkRectf where;
    };

    void remember(vtkProp *prop);
    void scale(double across, double up, double letters);
    void remember_actor(vtkActor2D *actor);

    pm_figure *figure;
    int width, height; // laid out for
    std::vector<words> all_words;
    std::vector<drawing> drawings;
    std::vector<picture> pictures;
    std::vector<chart> charts;
};

#endif

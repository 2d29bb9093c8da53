// Paths in a still picture, and the numbers behind them.
#include "draw_paths.h"
#include "core.hh"
#include "figure.hh"
#include "path_legend.hh"
#include "path_strokes.hh"

extern "C" {
#include "path_pick.h"
}

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>

#include <cmath>

namespace {

/// The paths that are drawn as data: a polyline each. Its points know the step, the event and
/// the power that goes on; the line knows its photon.
class path_table {
  public:
    path_table()
    {
        step->SetName("step");
        event->SetName("event (L 0, D 1, S 2, T 3, V 4, A 5, E 6, C 7)");
        power->SetName("power [W]");
        power->SetNumberOfComponents(3);
        photon->SetName("photon");
    }

    void add(const pm_path_vertex *path, uint64_t count, uint64_t number)
    {
        lines->InsertNextCell(static_cast<int>(count));
        for (uint64_t i = 0; i < count; i++) {
            const pm_vec3 &at = path[i].position;
            lines->InsertCellPoint(points->InsertNextPoint(at.x, at.y, at.z));
            step->InsertNextValue(static_cast<int>(i));
            event->InsertNextValue(pm_path_look_of(path[i].event));
            power->InsertNextTypedTuple(path[i].power.c);
        }
        photon->InsertNextValue(static_cast<vtkTypeInt64>(number));
    }

    void keep(pm_figure *figure)
    {
        vtkNew<vtkPolyData> data;
        data->SetPoints(points);
        data->SetLines(lines);
        data->GetPointData()->AddArray(step);
        data->GetPointData()->AddArray(event);
        data->GetPointData()->AddArray(power);
        data->GetCellData()->AddArray(photon);
        pm_figure_keep(figure, "path", data);
    }

  private:
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> lines;
    vtkNew<vtkIntArray> step, event;
    vtkNew<vtkDoubleArray> power;
    vtkNew<vtkTypeInt64Array> photon;
};

} // namespace

pm_status pm_draw_paths(pm_figure *figure, const pm_path_set *paths, uint64_t most,
                        bool by_bounce, uint64_t *drawn)
{
    return pm_figure_guard("paths", [&] {
        uint64_t count = paths->path_count < most ? paths->path_count : most;
        pm_path_strokes strokes(by_bounce, count);
        path_table table;
        for (uint64_t i = 0; i < count; i++) {
            uint64_t p = pm_path_pick(paths->path_count, count, i);
            const pm_path_vertex *path = &paths->vertices[paths->first[p]];
            uint64_t vertices = paths->first[p + 1] - paths->first[p];
            strokes.add(path, vertices, HUGE_VAL);
            table.add(path, vertices, paths->photon[p]);
        }
        strokes.show(figure);
        table.keep(figure);
        *drawn = count;
        return by_bounce ? pm_path_legend_by_bounce(figure, strokes, strokes)
                         : pm_path_legend_by_event(figure, strokes, strokes);
    });
}

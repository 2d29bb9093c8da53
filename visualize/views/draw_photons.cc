// Photons as plain GL points: a million take a second, where spheres or splats take minutes or
// burn out. A point shows its photon's hue and power; how dense they lie shows the irradiance.
#include "draw_photons.h"
#include "core.hh"
#include "figure.hh"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkUnsignedCharArray.h>

namespace {

const double round_from = 2.0; // dot size

vtkSmartPointer<vtkUnsignedCharArray> colour_points(const pm_photon_cloud *cloud,
                                                    double brightness)
{
    auto colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
    colours->SetNumberOfComponents(3);
    colours->SetNumberOfTuples(cloud->count);
    double full = cloud->full_power > 0.0 ? cloud->full_power : 1.0;
    for (vtkIdType i = 0; i < cloud->count; i++) {
        double power[3];
        for (int c = 0; c < 3; c++) {
            power[c] = static_cast<double>(cloud->power[i][c]) / full;
        }
        pm_colour c = pm_colour_dim(pm_colour_linear(power[0], power[1], power[2]), brightness);
        const unsigned char rgb[3] = {c.r, c.g, c.b};
        colours->SetTypedTuple(i, rgb);
    }
    return colours;
}

/// The cloud's own positions, not copied: it must outlive the figure.
vtkSmartPointer<vtkPolyData> make_points(const pm_photon_cloud *cloud)
{
    vtkNew<vtkFloatArray> positions;
    positions->SetNumberOfComponents(3);
    positions->SetArray(&cloud->position[0][0], static_cast<vtkIdType>(cloud->count) * 3, 1);
    vtkNew<vtkPoints> points;
    points->SetData(positions);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell(static_cast<int>(cloud->count));
    for (vtkIdType i = 0; i < cloud->count; i++) {
        cells->InsertCellPoint(i);
    }
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetVerts(cells);
    return data;
}

pm_colour grey(double position)
{
    return pm_colour_linear(position, position, position);
}

} // namespace

pm_status pm_draw_photons(pm_figure *figure, const pm_photon_cloud *cloud, double dot_size,
                          double brightness)
{
    return pm_figure_guard("photons", [&] {
        if (cloud->count == 0) {
            return PM_OK;
        }
        vtkSmartPointer<vtkPolyData> data = make_points(cloud);
        data->GetPointData()->SetScalars(colour_points(cloud, brightness));
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(data);
        mapper->SetColorModeToDirectScalars();
        vtkNew<vtkActor> actor;
        actor->SetMapper(mapper);
        actor->GetProperty()->LightingOff();
        actor->GetProperty()->SetPointSize(static_cast<float>(figure->pixels(dot_size)));
        // Small dots look the same as squares, and a million are drawn much faster so.
        actor->GetProperty()->SetRenderPointsAsSpheres(dot_size > round_from);
        figure->renderer->AddActor(actor);
        return PM_OK;
    });
}

pm_status pm_draw_photon_scale(pm_figure *figure, const char *heading, double full_power)
{
    pm_scale scale = {heading, 0.0, full_power, false, grey};
    return full_power > 0.0 ? pm_figure_scale(figure, &scale) : PM_OK;
}

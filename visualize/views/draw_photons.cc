// Photons as plain GL points: a million take a second, where spheres or splats take minutes or
// burn out. A point shows its photon's hue and power; how dense they lie shows the irradiance.
//
// The arrays behind a picture are the cloud's own, not copies.
#include "draw_photons.h"
#include "core.hh"
#include "figure.hh"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkStringArray.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedIntArray.h>

#include <algorithm>

namespace {

const double round_from = 2.0; // dot size

vtkSmartPointer<vtkUnsignedCharArray> make_colours(const pm_photon_cloud *cloud)
{
    auto colours = vtkSmartPointer<vtkUnsignedCharArray>::New();
    colours->SetName("colour");
    colours->SetNumberOfComponents(3);
    colours->SetNumberOfTuples(cloud->count);
    return colours;
}

vtkSmartPointer<vtkUnsignedCharArray> colour_by_power(const pm_photon_cloud *cloud,
                                                      double brightness)
{
    auto colours = make_colours(cloud);
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

vtkSmartPointer<vtkFloatArray> vectors(const char *name, float (*values)[3], uint32_t count)
{
    auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetName(name);
    array->SetNumberOfComponents(3);
    array->SetArray(&values[0][0], static_cast<vtkIdType>(count) * 3, 1);
    return array;
}

void add_numbers(vtkPolyData *data, const char *name, uint32_t *values, uint32_t count)
{
    if (values != nullptr) {
        vtkNew<vtkUnsignedIntArray> array;
        array->SetName(name);
        array->SetArray(values, count, 1);
        data->GetPointData()->AddArray(array);
    }
}

/// Which map they are in, and what its numbers stand for.
void add_map(vtkPolyData *data, const pm_photon_cloud *cloud)
{
    vtkNew<vtkIntArray> map;
    map->SetName("map");
    map->SetNumberOfTuples(cloud->count);
    map->FillValue(cloud->map);
    data->GetPointData()->AddArray(map);
    vtkNew<vtkStringArray> names;
    names->SetName("map names");
    for (const char *name : {"global", "caustic", "volume"}) {
        names->InsertNextValue(name);
    }
    data->GetFieldData()->AddArray(names);
}

/// A cell a photon, each of one point.
vtkSmartPointer<vtkCellArray> make_cells(uint32_t count)
{
    vtkNew<vtkTypeInt32Array> starts;
    vtkNew<vtkTypeInt32Array> points;
    starts->SetNumberOfValues(static_cast<vtkIdType>(count) + 1);
    points->SetNumberOfValues(count);
    int32_t next = 0;
    std::generate_n(starts->GetPointer(0), static_cast<size_t>(count) + 1,
                    [&] { return next++; });
    std::copy_n(starts->GetPointer(0), count, points->GetPointer(0));
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->SetData(starts, points);
    return cells;
}

/// With the cloud's own arrays: it must outlive the figure.
vtkSmartPointer<vtkPolyData> make_points(const pm_photon_cloud *cloud)
{
    vtkNew<vtkPoints> points;
    points->SetData(vectors("position", cloud->position, cloud->count));
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetVerts(make_cells(cloud->count));
    vtkPointData *numbers = data->GetPointData();
    numbers->AddArray(vectors("power [W]", cloud->power, cloud->count));
    numbers->AddArray(vectors("direction", cloud->direction, cloud->count));
    add_numbers(data, "bounce", cloud->bounce, cloud->count);
    add_numbers(data, "light", cloud->light, cloud->count);
    add_map(data, cloud);
    return data;
}

void draw(pm_figure *figure, const pm_photon_cloud *cloud, vtkUnsignedCharArray *colours,
          double dot_size)
{
    vtkSmartPointer<vtkPolyData> data = make_points(cloud);
    data->GetPointData()->SetScalars(colours);
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
    pm_figure_keep(figure, "photon", data);
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
        if (cloud->count > 0) {
            draw(figure, cloud, colour_by_power(cloud, brightness), dot_size);
        }
        return PM_OK;
    });
}

pm_status pm_draw_painted_photons(pm_figure *figure, const pm_photon_cloud *cloud,
                                  const pm_colour *colours, double dot_size)
{
    return pm_figure_guard("photons", [&] {
        if (cloud->count > 0) {
            auto copies = make_colours(cloud);
            for (vtkIdType i = 0; i < cloud->count; i++) {
                const unsigned char rgb[3] = {colours[i].r, colours[i].g, colours[i].b};
                copies->SetTypedTuple(i, rgb);
            }
            draw(figure, cloud, copies, dot_size);
        }
        return PM_OK;
    });
}

pm_status pm_draw_photon_scale(pm_figure *figure, const char *heading, double full_power)
{
    pm_scale scale = {heading, 0.0, full_power, false, grey};
    return full_power > 0.0 ? pm_figure_scale(figure, &scale) : PM_OK;
}

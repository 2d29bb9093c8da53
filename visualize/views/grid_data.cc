// The numbers of a grid, point by point, as they were read.
#include "grid_data.hh"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

namespace {

vtkSmartPointer<vtkDoubleArray> add_array(vtkPolyData *data, const char *name, int components)
{
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    data->GetPointData()->AddArray(array);
    return array;
}

vtkSmartPointer<vtkCellArray> quads_of(const pm_grid *grid)
{
    auto quads = vtkSmartPointer<vtkCellArray>::New();
    vtkIdType columns = static_cast<vtkIdType>(grid->columns);
    vtkIdType rows = static_cast<vtkIdType>(grid->rows);
    for (vtkIdType j = 0; j + 1 < rows; j++) {
        for (vtkIdType i = 0; i + 1 < columns; i++) {
            vtkIdType at = j * columns + i;
            const vtkIdType corner[4] = {at, at + 1, at + columns + 1, at + columns};
            quads->InsertNextCell(4, corner);
        }
    }
    return quads;
}

} // namespace

vtkSmartPointer<vtkPolyData> pm_grid_data(const pm_grid *grid)
{
    auto data = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    auto irradiance = add_array(data, "irradiance [W/m^2]", 3);
    auto radius = add_array(data, "radius [m]", 1);
    auto found = add_array(data, "found", 1);
    auto normal = add_array(data, "normal", 3);
    for (uint64_t n = 0; n < grid->columns * grid->rows; n++) {
        const pm_grid_point &p = grid->points[n];
        points->InsertNextPoint(p.position.x, p.position.y, p.position.z);
        irradiance->InsertNextTuple(p.irradiance.c);
        radius->InsertNextValue(p.radius);
        found->InsertNextValue(static_cast<double>(p.found));
        normal->InsertNextTuple3(p.normal.x, p.normal.y, p.normal.z);
    }
    data->SetPoints(points);
    data->SetPolys(quads_of(grid));
    return data;
}

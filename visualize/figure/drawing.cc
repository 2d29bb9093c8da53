// Points and colours grow together; cells refer to them by index.
#include "drawing.hh"

#include <vtkMapper.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>

#include <cmath>

pm_drawing::pm_drawing()
{
    points->SetDataTypeToFloat();
    colours->SetNumberOfComponents(4);
    colours->SetName("colour");
}

vtkIdType pm_drawing::vertex(pm_vec3 at, pm_colour colour, double opacity)
{
    const unsigned char rgba[4] = {colour.r, colour.g, colour.b,
                                   static_cast<unsigned char>(std::lround(255.0 * opacity))};
    colours->InsertNextTypedTuple(rgba);
    return points->InsertNextPoint(at.x, at.y, at.z);
}

void pm_drawing::dot(pm_vec3 at, pm_colour colour, double opacity)
{
    vtkIdType id = vertex(at, colour, opacity);
    dots->InsertNextCell(1, &id);
}

void pm_drawing::line(pm_vec3 from, pm_vec3 to, pm_colour colour, double opacity)
{
    const vtkIdType ids[2] = {vertex(from, colour, opacity), vertex(to, colour, opacity)};
    lines->InsertNextCell(2, ids);
}

void pm_drawing::fading_line(pm_vec3 from, pm_vec3 to, pm_colour colour, double opacity,
                             double at_end)
{
    const vtkIdType ids[2] = {vertex(from, colour, opacity), vertex(to, colour, at_end)};
    lines->InsertNextCell(2, ids);
}

void pm_drawing::quad(const pm_vec3 corner[4], pm_colour colour, double opacity)
{
    polygon({corner[0], corner[1], corner[2], corner[3]}, colour, opacity);
}

void pm_drawing::outline(const std::vector<pm_vec3> &rim, pm_colour colour, double opacity)
{
    for (size_t i = 0; i < rim.size(); i++) {
        line(rim[i], rim[(i + 1) % rim.size()], colour, opacity);
    }
}

void pm_drawing::polygon(const std::vector<pm_vec3> &rim, pm_colour colour, double opacity)
{
    faces->InsertNextCell(static_cast<int>(rim.size()));
    for (const pm_vec3 &at : rim) {
        faces->InsertCellPoint(vertex(at, colour, opacity));
    }
}

void pm_drawing::triangle(vtkIdType a, vtkIdType b, vtkIdType c)
{
    const vtkIdType ids[3] = {a, b, c};
    faces->InsertNextCell(3, ids);
}

vtkSmartPointer<vtkPolyData> pm_drawing::data() const
{
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetVerts(dots);
    data->SetLines(lines);
    data->SetPolys(faces);
    data->GetPointData()->SetScalars(colours);
    return data;
}

vtkSmartPointer<vtkActor> pm_drawing::actor(double line_width, double dot_size,
                                            double push) const
{
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data());
    mapper->SetColorModeToDirectScalars();
    mapper->SetResolveCoincidentTopologyToPolygonOffset();
    mapper->SetRelativeCoincidentTopologyPolygonOffsetParameters(push, push);
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    actor->GetProperty()->LightingOff();
    actor->GetProperty()->RenderPointsAsSpheresOn();
    actor->GetProperty()->SetLineWidth(static_cast<float>(line_width));
    actor->GetProperty()->SetPointSize(static_cast<float>(dot_size));
    return actor;
}

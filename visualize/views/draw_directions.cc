// The sphere is opaque, so that its far side's dots do not mix with the near ones; dots and
// circles float a little above it.
#include "draw_directions.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>

#include <cmath>

namespace {

const int segments = 96; // around the axis
const int dark_rings = 48;
const double line_height = 1.004;
const double dot_height = 1.012;
const double axis_end = 1.22; // of the line that shows it
const double word_at = 1.34;

/// Points at an angle to the axis and an azimuth, at a height over the sphere's middle.
class globe {
  public:
    explicit globe(const pm_direction_sphere *sphere) : s(sphere)
    {
    }

    pm_vec3 at(double angle, double azimuth, double height) const
    {
        return place(pm_vec(std::sin(angle) * std::cos(azimuth),
                            std::sin(angle) * std::sin(azimuth), std::cos(angle)),
                     height);
    }

    pm_vec3 place(pm_vec3 way, double height) const
    {
        return pm_vec_along(s->middle, pm_frame_to_world(&s->axis, way), height);
    }

  private:
    const pm_direction_sphere *s;
};

void add_ring(pm_drawing *drawing, const globe &g, double from, double to, pm_colour colour)
{
    for (int i = 0; i < segments; i++) {
        double a = 2.0 * PM_PI * i / segments;
        double b = 2.0 * PM_PI * (i + 1) / segments;
        const pm_vec3 corner[4] = {g.at(from, a, 1.0), g.at(from, b, 1.0), g.at(to, b, 1.0),
                                   g.at(to, a, 1.0)};
        drawing->quad(corner, colour, 1.0);
    }
}

void add_surface(pm_drawing *drawing, const globe &g, const pm_direction_sphere *s)
{
    for (int i = 0; i < s->ring_count; i++) {
        add_ring(drawing, g, s->reach * i / s->ring_count, s->reach * (i + 1) / s->ring_count,
                 s->colours[i]);
    }
    for (int i = 0; i < dark_rings && s->reach < PM_PI; i++) {
        double wide = (PM_PI - s->reach) / dark_rings;
        add_ring(drawing, g, s->reach + wide * i, s->reach + wide * (i + 1),
                 pm_direction_dark());
    }
}

void add_lines(pm_drawing *drawing, const globe &g, const pm_direction_sphere *s)
{
    pm_colour line = pm_colour_named(PM_COLOUR_WHITE);
    for (int c = 0; c < s->circle_count; c++) {
        for (int i = 0; i < segments; i++) {
            drawing->line(g.at(s->circle[c], 2.0 * PM_PI * i / segments, line_height),
                          g.at(s->circle[c], 2.0 * PM_PI * (i + 1) / segments, line_height),
                          line, 0.22);
        }
    }
    if (s->axis_word != nullptr) {
        drawing->line(g.place(pm_vec(0.0, 0.0, 1.0), 1.0),
                      g.place(pm_vec(0.0, 0.0, 1.0), axis_end), line, 0.9);
    }
}

vtkSmartPointer<vtkPolyData> numbers_of(const pm_direction_sphere *s, const globe &g)
{
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> dots;
    vtkNew<vtkFloatArray> power;
    vtkNew<vtkFloatArray> direction;
    vtkNew<vtkIntArray> light;
    power->SetName("power [W]");
    power->SetNumberOfComponents(3);
    direction->SetName("direction");
    direction->SetNumberOfComponents(3);
    light->SetName("light");
    for (uint64_t i = 0; i < s->count; i++) {
        const double *watts = s->dots[i].power.c;
        pm_vec3 at = g.place(s->dots[i].way, 1.0);
        pm_vec3 way = pm_vec_sub(at, s->middle);
        vtkIdType id = points->InsertNextPoint(at.x, at.y, at.z);
        dots->InsertNextCell(1, &id);
        power->InsertNextTuple3(watts[0], watts[1], watts[2]);
        direction->InsertNextTuple3(way.x, way.y, way.z);
        light->InsertNextValue(s->light);
    }
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetVerts(dots);
    data->GetPointData()->AddArray(power);
    data->GetPointData()->AddArray(direction);
    data->GetPointData()->AddArray(light);
    return data;
}

} // namespace

pm_colour pm_direction_dark(void)
{
    return {44, 47, 58};
}

pm_colour pm_direction_stray(void)
{
    return pm_colour_named(PM_COLOUR_VERMILLION);
}

pm_status pm_draw_directions(pm_figure *figure, const pm_direction_sphere *sphere,
                             double dot_size)
{
    return pm_figure_guard("directions", [&] {
        globe g(sphere);
        pm_drawing surface;
        pm_drawing lines;
        pm_drawing dots;
        add_surface(&surface, g, sphere);
        add_lines(&lines, g, sphere);
        for (uint64_t i = 0; i < sphere->count; i++) {
            pm_colour colour =
                sphere->dots[i].stray ? pm_direction_stray() : pm_colour_named(PM_COLOUR_WHITE);
            dots.dot(g.place(sphere->dots[i].way, dot_height), colour, 1.0);
        }
        figure->renderer->AddActor(surface.actor(1.0, 1.0));
        figure->renderer->AddActor(lines.actor(figure->pixels(1.5), 1.0));
        figure->renderer->AddActor(dots.actor(1.0, figure->pixels(dot_size)));
        pm_figure_keep(figure, "direction", numbers_of(sphere, g));
        return sphere->axis_word == nullptr
                   ? PM_OK
                   : pm_figure_mark(figure, g.place(pm_vec(0.0, 0.0, 1.0), word_at),
                                    sphere->axis_word);
    });
}

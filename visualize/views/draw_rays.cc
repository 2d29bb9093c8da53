// Arrows are flat: their two barbs lie across the eye's line, so that each reads as an arrow
// from where it is seen.
#include "draw_rays.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

#include "light_pick.h"

#include <vtkFloatArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>

namespace {

const double shaft_opacity = 0.45; // where many start at one place, each is still to be seen
const double head_opacity = 0.9;
const double dot_opacity = 0.75;
const double barb = 0.1; // of the arrow's length

void add_arrow(pm_drawing *drawing, const pm_ray_shown &photon, double length, pm_vec3 eye,
               pm_colour colour)
{
    pm_vec3 way = photon.ray->direction;
    pm_vec3 tip = pm_vec_along(photon.start, way, length);
    drawing->line(photon.start, tip, colour, shaft_opacity);
    pm_vec3 across = pm_vec_cross(way, pm_vec_sub(eye, tip));
    double wide = pm_vec_length(across);
    if (wide == 0.0) {
        return;
    }
    pm_vec3 back = pm_vec_along(tip, way, -barb * length);
    for (double side : {-1.0, 1.0}) {
        pm_vec3 end = pm_vec_along(back, across, side * 0.5 * barb * length / wide);
        drawing->line(tip, end, colour, head_opacity);
    }
}

vtkSmartPointer<vtkFloatArray> named_array(const char *name)
{
    auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetName(name);
    array->SetNumberOfComponents(3);
    return array;
}

/// The numbers of the photons shown, one dot each.
vtkSmartPointer<vtkPolyData> photons_of(const pm_ray_choice *choice)
{
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> dots;
    auto power = named_array("power [W]");
    auto direction = named_array("direction");
    vtkNew<vtkIntArray> light;
    light->SetName("light");
    for (uint64_t i = 0; i < choice->count; i++) {
        const pm_ray_shown &photon = choice->shown[i];
        const double *watts = photon.ray->power.c;
        const pm_vec3 &way = photon.ray->direction;
        vtkIdType id = points->InsertNextPoint(photon.start.x, photon.start.y, photon.start.z);
        dots->InsertNextCell(1, &id);
        power->InsertNextTuple3(watts[0], watts[1], watts[2]);
        direction->InsertNextTuple3(way.x, way.y, way.z);
        light->InsertNextValue(static_cast<int>(photon.ray->light));
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

pm_status pm_draw_rays(pm_figure *figure, const pm_ray_choice *choice, double dot_size,
                       double length)
{
    return pm_figure_guard("rays", [&] {
        pm_drawing dots;
        pm_drawing arrows;
        for (uint64_t i = 0; i < choice->count; i++) {
            const pm_ray_shown &photon = choice->shown[i];
            pm_colour colour = pm_light_colour(static_cast<int>(photon.ray->light));
            dots.dot(photon.start, colour, dot_opacity);
            if (photon.arrow) {
                add_arrow(&arrows, photon, length, figure->viewpoint.position, colour);
            }
        }
        figure->renderer->AddActor(arrows.actor(figure->pixels(1.6), 1.0));
        figure->renderer->AddActor(dots.actor(1.0, figure->pixels(dot_size)));
        pm_figure_keep(figure, "photon", photons_of(choice));
        return PM_OK;
    });
}

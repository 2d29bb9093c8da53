// Dots are flat discs in the surface, a little above each other with the heaviest on top, so
// that none hides one that counts more.
#include "draw_weights.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

#include <vtkDoubleArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

namespace {

const int sides = 96;        // of the rim
const int dot_sides = 20;    // of a dot
const double dot_900 = 8.5;  // radius of the heaviest dot among `usual`
const double usual = 100.0;  // photons
const double smallest = 0.3; // of the heaviest one's radius
const double border = 1.22;  // radius of a dot with its border, over the dot's
const double ring = 2.0;     // of one that counts nothing, over the smallest
const pm_colour dark = {24, 26, 36};
const double lift = 0.02; // of the topmost dot, in radii

const char *const array_names[PM_WEIGHT_KERNELS] = {"weight none", "weight cone",
                                                    "weight gaussian", "weight epanechnikov"};

/// Shown in a size, too, so that colours need not be told apart.
double part_of(double weight, double high)
{
    return std::sqrt(std::max(weight, 0.0) / high);
}

/// A circle in the plane across `frame`.
std::vector<pm_vec3> circle(const pm_frame &frame, pm_vec3 middle, double radius, int count)
{
    std::vector<pm_vec3> rim;
    for (int i = 0; i < count; i++) {
        double phi = 2.0 * PM_PI * i / count;
        pm_vec3 local = pm_vec(radius * std::cos(phi), radius * std::sin(phi), 0.0);
        rim.push_back(pm_vec_add(middle, pm_frame_to_world(&frame, local)));
    }
    return rim;
}

/// Metres at the disc that a pixel of the current panel shows.
double metres_of_pixel(const pm_figure *figure, pm_vec3 at)
{
    const pm_viewpoint &v = figure->viewpoint;
    double depth = pm_vec_dot(pm_vec_sub(at, v.position), v.forward);
    return 2.0 * depth * v.tan_y / v.height;
}

/// Photons, the lightest first.
std::vector<uint32_t> by_weight(const pm_weighed_set *set, int kernel)
{
    std::vector<uint32_t> order(set->count);
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
        return set->photons[a].weight[kernel] < set->photons[b].weight[kernel];
    });
    return order;
}

struct dot {
    double radius, step; // [m]; above the last dot, and below the next
    bool counts;
    pm_colour colour;
};

/// A disc with a dark border, or a ring.
void add_dot(pm_drawing *drawing, const pm_frame &frame, pm_vec3 middle, const dot &d)
{
    if (!d.counts) {
        drawing->outline(circle(frame, middle, ring * d.radius, dot_sides),
                         pm_colour_named(PM_COLOUR_GREY), 1.0);
        return;
    }
    drawing->polygon(circle(frame, middle, border * d.radius, dot_sides), dark, 1.0);
    pm_vec3 normal = pm_frame_to_world(&frame, pm_vec(0.0, 0.0, 1.0));
    drawing->polygon(circle(frame, pm_vec_along(middle, normal, d.step), d.radius, dot_sides),
                     d.colour, 1.0);
}

vtkSmartPointer<vtkDoubleArray> add_array(vtkPolyData *data, const char *name, int components)
{
    auto array = vtkSmartPointer<vtkDoubleArray>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    data->GetPointData()->AddArray(array);
    return array;
}

/// Ends of the one scale that all kernels share, low below 0 only where a weight is.
void measure_range(const pm_weighed_set *set, double *low, double *high)
{
    double least = 0.0;
    double most = 0.0;
    for (uint32_t i = 0; i < set->count; i++) {
        for (double weight : set->photons[i].weight) {
            least = std::min(least, weight);
            most = std::max(most, weight);
        }
    }
    *low = least;
    *high = most > 0.0 ? most : 1.0;
}

} // namespace

pm_status pm_draw_weights(pm_figure *figure, const pm_weighed_set *set, int kernel)
{
    return pm_figure_guard("weights", [&] {
        double low = 0.0;
        double high = 1.0;
        measure_range(set, &low, &high);
        double pixel = metres_of_pixel(figure, set->at);
        double full = pixel * figure->pixels(dot_900) *
                      std::min(1.0, std::sqrt(std::sqrt(usual / set->count)));
        pm_frame frame = pm_frame_around(set->normal);
        pm_drawing drawing;
        drawing.outline(circle(frame, set->at, set->radius, sides),
                        pm_colour_named(PM_COLOUR_WHITE), 1.0);
        double step = 0.5 * lift * set->radius / set->count;
        double height = 0.0;
        for (uint32_t i : by_weight(set, kernel)) {
            const pm_weighed_photon &photon = set->photons[i];
            double weight = photon.weight[kernel];
            height += 2.0 * step;
            add_dot(&drawing, frame, pm_vec_along(photon.position, set->normal, height),
                    {full * std::max(smallest, part_of(weight, high)), step, weight != 0.0,
                     pm_colour_viridis((weight - low) / (high - low))});
        }
        vtkSmartPointer<vtkActor> actor = drawing.actor(figure->pixels(1.8), 1.0);
        actor->ForceOpaqueOn(); // or borders would shine through the dots on them
        figure->renderer->AddActor(actor);
        return PM_OK;
    });
}

pm_status pm_draw_weights_legend(pm_figure *figure, const pm_weighed_set *set)
{
    return pm_figure_guard("a legend", [&] {
        pm_scale scale = {"weight of a photon\n(size and colour)", 0.0, 1.0, false,
                          pm_colour_viridis};
        measure_range(set, &scale.low, &scale.high);
        PM_TRY(pm_figure_scale(figure, &scale));
        char radius[48];
        std::snprintf(radius, sizeof radius, "rim, radius %.3g m", set->radius);
        const pm_legend_entry entries[] = {
            {PM_SWATCH_LINE, pm_colour_named(PM_COLOUR_WHITE), radius},
            {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_GREY), "grey ring: counts 0, as it"},
            {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_GREY), "only sets the radius"}};
        return pm_figure_legend(figure, "the disc", entries, 3);
    });
}

pm_status pm_draw_weights_place(pm_figure *figure, const pm_weighed_set *set, double length)
{
    return pm_figure_guard("a place", [&] {
        pm_drawing drawing;
        pm_colour yellow = pm_colour_named(PM_COLOUR_YELLOW);
        drawing.line(set->at, pm_vec_along(set->at, set->normal, length), yellow, 1.0);
        drawing.dot(set->at, yellow, 1.0);
        figure->renderer->AddActor(drawing.actor(figure->pixels(2.5), figure->pixels(9.0)));
        return PM_OK;
    });
}

pm_status pm_draw_weights_keep(pm_figure *figure, const pm_weighed_set *set)
{
    return pm_figure_guard("photons", [&] {
        auto data = vtkSmartPointer<vtkPolyData>::New();
        vtkNew<vtkPoints> points;
        vtkNew<vtkCellArray> dots;
        auto power = add_array(data, "power [W]", 3);
        auto distance = add_array(data, "distance [m]", 1);
        vtkSmartPointer<vtkDoubleArray> weights[PM_WEIGHT_KERNELS];
        for (int k = 0; k < PM_WEIGHT_KERNELS; k++) {
            weights[k] = add_array(data, array_names[k], 1);
        }
        for (uint32_t i = 0; i < set->count; i++) {
            const pm_weighed_photon &photon = set->photons[i];
            const pm_vec3 &at = photon.position;
            vtkIdType id = points->InsertNextPoint(at.x, at.y, at.z);
            dots->InsertNextCell(1, &id);
            power->InsertNextTuple(photon.power);
            distance->InsertNextValue(photon.distance);
            for (int k = 0; k < PM_WEIGHT_KERNELS; k++) {
                weights[k]->InsertNextValue(photon.weight[k]);
            }
        }
        data->SetPoints(points);
        data->SetVerts(dots);
        pm_figure_keep(figure, "photon", data);
        return PM_OK;
    });
}

// Colours are logarithmic: a caustic is ten times as bright as what it lies on.
#include "draw_edge.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

#include <vtkDoubleArray.h>
#include <vtkPointData.h>

#include <cmath>

namespace {

const pm_colour none = {70, 74, 84}; // 0, which has no logarithm: not on the scale
const double lift = 0.002;           // of the line over the map, in lengths of a row

const char *const array_names[PM_EDGE_KERNELS] = {"irradiance none [W/m^2]",
                                                  "irradiance cone [W/m^2]",
                                                  "irradiance gaussian [W/m^2]",
                                                  "irradiance epanechnikov [W/m^2]",
                                                  "irradiance none-lecture [W/m^2]",
                                                  "irradiance cone-lecture [W/m^2]",
                                                  "irradiance gaussian-lecture [W/m^2]",
                                                  "irradiance epanechnikov-lecture [W/m^2]",
                                                  "irradiance differential [W/m^2]"};

pm_colour colour_of(double value, const pm_edge_range *range)
{
    return value > 0.0 ? pm_colour_inferno(std::log(value / range->low) /
                                           std::log(range->high / range->low))
                       : none;
}

/// Calls `cell` with the four corners of every cell, as indices.
template <class Cell> void for_each_cell(const pm_edge_grid *grid, Cell cell)
{
    vtkIdType columns = static_cast<vtkIdType>(grid->columns);
    vtkIdType rows = static_cast<vtkIdType>(grid->rows);
    for (vtkIdType j = 0; j + 1 < rows; j++) {
        for (vtkIdType i = 0; i + 1 < columns; i++) {
            vtkIdType at = j * columns + i;
            cell(at, at + 1, at + columns + 1, at + columns);
        }
    }
}

pm_vec3 at(const pm_edge_grid *grid, uint64_t i, uint64_t j)
{
    return grid->points[j * grid->columns + i].position;
}

} // namespace

pm_status pm_draw_edge(pm_figure *figure, const pm_edge_grid *grid, int kernel,
                       const pm_edge_range *range, uint64_t row)
{
    return pm_figure_guard("irradiance", [&] {
        pm_drawing map;
        for (uint64_t n = 0; n < grid->columns * grid->rows; n++) {
            map.vertex(grid->points[n].position,
                       colour_of(grid->points[n].irradiance[kernel], range), 1.0);
        }
        for_each_cell(grid, [&](vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d) {
            map.triangle(a, b, c);
            map.triangle(a, c, d);
        });
        figure->renderer->AddActor(map.actor(1.0, 1.0));
        pm_vec3 from = at(grid, 0, row);
        pm_vec3 to = at(grid, grid->columns - 1, row);
        double up = -lift * pm_vec_length(pm_vec_sub(to, from));
        pm_drawing line;
        line.line(pm_vec_along(from, figure->viewpoint.forward, up),
                  pm_vec_along(to, figure->viewpoint.forward, up),
                  pm_colour_named(PM_COLOUR_SKY), 1.0);
        vtkSmartPointer<vtkActor> actor = line.actor(figure->pixels(2.4), 1.0);
        actor->ForceOpaqueOn();
        figure->renderer->AddActor(actor);
        return PM_OK;
    });
}

pm_status pm_draw_edge_scale(pm_figure *figure, const pm_edge_range *range)
{
    return pm_figure_guard("a scale", [&] {
        pm_scale scale = {"irradiance [W/m\xC2\xB2]\n(luminance)", range->low, range->high,
                          true, pm_colour_inferno};
        PM_TRY(pm_figure_scale(figure, &scale));
        std::vector<pm_legend_entry> entries;
        if (range->above) {
            entries.push_back({PM_SWATCH_FILL, pm_colour_inferno(1.0), "and all above"});
        }
        if (range->below) {
            entries.push_back({PM_SWATCH_FILL, pm_colour_inferno(0.0), "and all below"});
        }
        if (range->has_zero) {
            entries.push_back({PM_SWATCH_FILL, none, "0: no photon counts"});
        }
        return entries.empty() ? PM_OK
                               : pm_figure_legend(figure, "beyond the scale", entries.data(),
                                                  static_cast<int>(entries.size()));
    });
}

pm_status pm_draw_edge_place(pm_figure *figure, const pm_edge_grid *grid)
{
    return pm_figure_guard("a place", [&] {
        uint64_t i = grid->columns - 1;
        uint64_t j = grid->rows - 1;
        pm_drawing drawing;
        drawing.outline({at(grid, 0, 0), at(grid, i, 0), at(grid, i, j), at(grid, 0, j)},
                        pm_colour_named(PM_COLOUR_YELLOW), 1.0);
        figure->renderer->AddActor(drawing.actor(figure->pixels(2.0), 1.0));
        return PM_OK;
    });
}

pm_status pm_draw_edge_keep(pm_figure *figure, const pm_edge_grid *grid)
{
    return pm_figure_guard("a grid", [&] {
        auto data = vtkSmartPointer<vtkPolyData>::New();
        vtkNew<vtkPoints> points;
        vtkNew<vtkCellArray> quads;
        for (uint64_t n = 0; n < grid->columns * grid->rows; n++) {
            const pm_vec3 &p = grid->points[n].position;
            points->InsertNextPoint(p.x, p.y, p.z);
        }
        for_each_cell(grid, [&](vtkIdType a, vtkIdType b, vtkIdType c, vtkIdType d) {
            const vtkIdType corner[4] = {a, b, c, d};
            quads->InsertNextCell(4, corner);
        });
        data->SetPoints(points);
        data->SetPolys(quads);
        for (int kernel = 0; kernel < PM_EDGE_KERNELS; kernel++) {
            vtkNew<vtkDoubleArray> values;
            values->SetName(array_names[kernel]);
            for (uint64_t n = 0; n < grid->columns * grid->rows; n++) {
                values->InsertNextValue(grid->points[n].irradiance[kernel]);
            }
            data->GetPointData()->AddArray(values);
        }
        pm_figure_keep(figure, "grid point", data);
        return PM_OK;
    });
}

// Every estimate is a square of its own colour: nothing is smoothed between points, and the
// squares of the outermost points end where the surface does.
#include "draw_bias.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"
#include "grid_data.hh"

#include <vtkDoubleArray.h>
#include <vtkPointData.h>

namespace {

double ratio_of(const pm_grid_point &point, double truth)
{
    return pm_spectrum_luminance(point.irradiance) / truth;
}

void add_squares(pm_figure *figure, const pm_grid *grid, double truth, double reach)
{
    const pm_grid_point *p = grid->points;
    pm_vec3 across = pm_vec_scale(pm_vec_sub(p[1].position, p[0].position), 0.5);
    pm_vec3 down = pm_vec_scale(pm_vec_sub(p[grid->columns].position, p[0].position), 0.5);
    pm_drawing squares;
    for (uint64_t n = 0; n < grid->columns * grid->rows; n++) {
        pm_vec3 left = pm_vec_sub(p[n].position, across);
        pm_vec3 right = pm_vec_add(p[n].position, across);
        const pm_vec3 corner[4] = {pm_vec_sub(left, down), pm_vec_sub(right, down),
                                   pm_vec_add(right, down), pm_vec_add(left, down)};
        double t = 0.5 + 0.5 * (ratio_of(p[n], truth) - 1.0) / reach;
        squares.quad(corner, pm_colour_diverging(t), 1.0);
    }
    figure->renderer->AddActor(squares.actor(1.0, 1.0));
}

void keep(pm_figure *figure, const pm_grid *grid, double truth, const char *name)
{
    vtkSmartPointer<vtkPolyData> data = pm_grid_data(grid);
    vtkNew<vtkDoubleArray> ratio;
    ratio->SetName("estimate / truth");
    for (uint64_t n = 0; n < grid->columns * grid->rows; n++) {
        ratio->InsertNextValue(ratio_of(grid->points[n], truth));
    }
    data->GetPointData()->AddArray(ratio);
    pm_figure_keep(figure, name, data);
}

} // namespace

pm_status pm_draw_bias(pm_figure *figure, const pm_grid *grid, double truth, double reach,
                       const char *name)
{
    return pm_figure_guard("bias", [&] {
        add_squares(figure, grid, truth, reach);
        keep(figure, grid, truth, name);
        return PM_OK;
    });
}

pm_status pm_draw_bias_scale(pm_figure *figure, double reach, bool beyond)
{
    pm_scale scale = {"estimate / truth", 1.0 - reach, 1.0 + reach, false, pm_colour_diverging};
    PM_TRY(pm_figure_scale(figure, &scale));
    const pm_legend_entry words[] = {{PM_SWATCH_FILL, pm_colour_diverging(0.0), "too dark"},
                                     {PM_SWATCH_FILL, pm_colour_diverging(0.5), "right"},
                                     {PM_SWATCH_FILL, pm_colour_diverging(1.0),
                                      beyond ? "too bright, or far more" : "too bright"}};
    return pm_figure_legend(figure, "colours", words, 3);
}

// A heat map with a logarithmic scale. Irradiance 0 has no logarithm: such points are drawn in
// a grey that is not on the scale, and the legend says so.
#include "core.hh"
#include "draw.h"
#include "drawing.hh"
#include "figure.hh"

#include <algorithm>
#include <cmath>

namespace {

// Values further below the largest than this share the scale's lowest colour.
const double span = 1e4;

// A flat field still gets a scale: so much around its value.
const double least_span = 1.1;

const pm_colour none = {70, 74, 84};

struct value_range {
    double low, high;
    bool has_zero;
};

value_range measure(const pm_grid *grid)
{
    value_range r = {INFINITY, 0.0, false};
    for (uint64_t i = 0; i < grid->columns * grid->rows; i++) {
        double y = pm_spectrum_luminance(grid->points[i].irradiance);
        if (y > 0.0) {
            r.low = std::min(r.low, y);
            r.high = std::max(r.high, y);
        } else {
            r.has_zero = true;
        }
    }
    if (r.high == 0.0) {
        return {0.1, 1.0, true};
    }
    r.low = std::max(r.low, r.high / span);
    if (r.high / r.low < least_span) {
        r.high *= std::sqrt(least_span);
        r.low /= std::sqrt(least_span);
    }
    return r;
}

pm_colour colour_of(const pm_grid_point &point, const value_range &r)
{
    double y = pm_spectrum_luminance(point.irradiance);
    return y > 0.0 ? pm_colour_inferno(std::log(y / r.low) / std::log(r.high / r.low)) : none;
}

void add_surface(const pm_grid *grid, const value_range &r, pm_drawing *drawing)
{
    for (uint64_t i = 0; i < grid->columns * grid->rows; i++) {
        drawing->vertex(grid->points[i].position, colour_of(grid->points[i], r), 1.0);
    }
    vtkIdType columns = static_cast<vtkIdType>(grid->columns);
    vtkIdType rows = static_cast<vtkIdType>(grid->rows);
    for (vtkIdType j = 0; j + 1 < rows; j++) {
        for (vtkIdType i = 0; i + 1 < columns; i++) {
            vtkIdType at = j * columns + i;
            drawing->triangle(at, at + 1, at + columns + 1);
            drawing->triangle(at, at + columns + 1, at + columns);
        }
    }
}

} // namespace

pm_status pm_draw_irradiance(pm_figure *figure, const pm_grid *grid)
{
    return pm_figure_guard("irradiance", [&] {
        value_range r = measure(grid);
        pm_drawing surface;
        add_surface(grid, r, &surface);
        figure->renderer->AddActor(surface.actor(1.0, 1.0));
        pm_scale scale = {"irradiance [W/m\xC2\xB2]\n(luminance)", r.low, r.high, true,
                          pm_colour_inferno};
        PM_TRY(pm_figure_scale(figure, &scale));
        const pm_legend_entry dark[] = {{PM_SWATCH_FILL, none, "0: no photon in reach"}};
        return r.has_zero ? pm_figure_legend(figure, "not on the scale", dark, 1) : PM_OK;
    });
}

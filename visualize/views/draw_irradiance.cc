// A heat map with a logarithmic scale, on its surface and once more face on in the right
// column, turned so that right and up are roughly the same in both. Irradiance 0 has no
// logarithm: such points are drawn in a grey that is not on the scale, and the legend says so.
#include "draw_irradiance.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"
#include "grid_data.hh"

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
    bool cut; // values below `low` exist
};

value_range measure(const pm_grid *grid)
{
    value_range r = {HUGE_VAL, 0.0, false, false};
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
        return {0.1, 1.0, true, false};
    }
    r.cut = r.low < r.high / span;
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

/// Two triangles for each cell of the grid, whose points are the drawing's vertices in order.
void connect(const pm_grid *grid, pm_drawing *drawing)
{
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

void add_surface(pm_figure *figure, const pm_grid *grid, const value_range &r)
{
    pm_drawing surface;
    for (uint64_t i = 0; i < grid->columns * grid->rows; i++) {
        surface.vertex(grid->points[i].position, colour_of(grid->points[i], r), 1.0);
    }
    connect(grid, &surface);
    figure->renderer->AddActor(surface.actor(1.0, 1.0));
}

/// The grid's two sides as a flat picture shows them.
struct facing {
    bool upright;        // columns run up the picture instead of across
    bool back_i, back_j; // i, j run left or down
    double width, height;
};

facing turn(const pm_figure *figure, const pm_grid *grid)
{
    const pm_vec3 at[3] = {grid->points[0].position, grid->points[grid->columns - 1].position,
                           grid->points[grid->columns * (grid->rows - 1)].position};
    double x[3] = {0, 0, 0};
    double y[3] = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        pm_viewpoint_project(&figure->viewpoint, at[i], &x[i], &y[i]);
    }
    facing f;
    f.upright = std::fabs(x[2] - x[0]) > std::fabs(x[1] - x[0]);
    f.back_i = f.upright ? y[1] > y[0] : x[1] < x[0];
    f.back_j = f.upright ? x[2] < x[0] : y[2] > y[0];
    double i_side = pm_vec_length(pm_vec_sub(at[1], at[0]));
    double j_side = pm_vec_length(pm_vec_sub(at[2], at[0]));
    f.width = f.upright ? j_side : i_side;
    f.height = f.upright ? i_side : j_side;
    return f;
}

/// Draws the grid flat into the right column, as large as it fits.
pm_status add_inset(pm_figure *figure, const pm_grid *grid, const value_range &r)
{
    PM_TRY(pm_figure_legend(figure, "the same, face on", nullptr, 0));
    facing f = turn(figure, grid);
    double room_x = figure->width - figure->column_left() - figure->pixels(24.0);
    double room_y = figure->column_top - figure->pixels(24.0);
    if (!(f.width > 0.0 && f.height > 0.0 && room_y > 0.0)) {
        return PM_OK;
    }
    double scale = std::min(room_x / f.width, room_y / f.height);
    double low = figure->column_top - scale * f.height;
    pm_drawing flat;
    for (uint64_t j = 0; j < grid->rows; j++) {
        for (uint64_t i = 0; i < grid->columns; i++) {
            const pm_grid_point &point = grid->points[j * grid->columns + i];
            double u = static_cast<double>(i) / static_cast<double>(grid->columns - 1);
            double v = static_cast<double>(j) / static_cast<double>(grid->rows - 1);
            u = f.back_i ? 1.0 - u : u;
            v = f.back_j ? 1.0 - v : v;
            double across = f.upright ? v : u;
            double upward = f.upright ? u : v;
            flat.vertex(pm_vec(figure->column_left() + across * scale * f.width,
                               low + upward * scale * f.height, 0.0),
                        colour_of(point, r), 1.0);
        }
    }
    connect(grid, &flat);
    pm_figure_overlay(figure, flat.data(), 1.0);
    figure->column_top = low;
    return PM_OK;
}

} // namespace

pm_status pm_draw_irradiance(pm_figure *figure, const pm_grid *grid)
{
    return pm_figure_guard("irradiance", [&] {
        value_range r = measure(grid);
        add_surface(figure, grid, r);
        pm_figure_keep(figure, "irradiance", pm_grid_data(grid));
        pm_scale scale = {"irradiance [W/m\xC2\xB2]\n(luminance)", r.low, r.high, true,
                          pm_colour_inferno};
        PM_TRY(pm_figure_scale(figure, &scale));
        const pm_legend_entry dark[] = {{PM_SWATCH_FILL, none, "0: no photon in reach"}};
        const pm_legend_entry below[] = {
            {PM_SWATCH_FILL, pm_colour_inferno(0.0), "smaller values, too"}};
        if (r.has_zero) {
            PM_TRY(pm_figure_legend(figure, "not on the scale", dark, 1));
        }
        if (r.cut) {
            PM_TRY(pm_figure_legend(figure, "lowest colour", below, 1));
        }
        return add_inset(figure, grid, r);
    });
}

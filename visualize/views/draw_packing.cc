// Cells are outlined by lines a little above a dark ball, which hides what is behind it; dots
// and the lines between them lie a little higher.
#include "core.hh"

#include "draw_packing.h"
#include "drawing.hh"
#include "figure.hh"

#include <vtkFloatArray.h>
#include <vtkPointData.h>
#include <vtkProperty.h>

#include <cmath>

namespace {

const double grid_height = 1.0005;
const double dot_height = 1.001;
const double ball_height = 0.9985;
const pm_colour ball_colour = {22, 25, 36};
const pm_colour_name exact_colour = PM_COLOUR_ORANGE;
const pm_colour_name packed_colour = PM_COLOUR_SKY;

const double turn = 2.0 * PM_PI;
const double cell_theta = PM_PI / PM_SPHERE_CELLS;
const double cell_phi = turn / PM_SPHERE_CELLS;

/// Which lines between cells, and how far.
struct grid {
    int theta_from, theta_to; // numbers of lines, 0 to PM_SPHERE_CELLS
    int phi_from, phi_to;
    int step;
    double opacity;
};

pm_vec3 raised(pm_vec3 direction, double height)
{
    return pm_vec_scale(direction, height);
}

/// From above `middle`, a piece of the sphere `half` wide to each side.
pm_viewpoint look_at(pm_vec3 middle, double half, double distance, const pm_rect &where)
{
    pm_vec3 top = std::fabs(middle.z) > 0.999 ? pm_vec(0.0, 1.0, 0.0) : pm_vec(0.0, 0.0, 1.0);
    pm_viewpoint v = {};
    v.width = where.width;
    v.height = where.height;
    v.forward = pm_vec_scale(middle, -1.0);
    v.right = pm_vec_normalize(pm_vec_cross(v.forward, top));
    v.up = pm_vec_cross(v.right, v.forward);
    v.position = pm_vec_scale(middle, distance);
    v.tan_y = half;
    v.tan_x = half * where.width / where.height;
    return v;
}

void draw_ball(pm_figure *figure)
{
    pm_drawing ball;
    const int rows = 96;
    for (int i = 0; i < rows; i++) {
        for (int j = 0; j < rows; j++) {
            double t0 = PM_PI * i / rows;
            double t1 = PM_PI * (i + 1) / rows;
            double p0 = turn * j / rows;
            double p1 = turn * (j + 1) / rows;
            const pm_vec3 corner[4] = {raised(pm_sphere_at(t0, p0), ball_height),
                                       raised(pm_sphere_at(t1, p0), ball_height),
                                       raised(pm_sphere_at(t1, p1), ball_height),
                                       raised(pm_sphere_at(t0, p1), ball_height)};
            ball.quad(corner, ball_colour, 1.0);
        }
    }
    figure->renderer->AddActor(ball.actor(1.0, 1.0));
}

/// A line along theta or phi in pieces of half a cell or a degree, whichever is shorter.
void draw_arc(pm_drawing *drawing, double t0, double p0, double t1, double p1, double opacity)
{
    double longest = std::max(std::fabs(t1 - t0), std::fabs(p1 - p0));
    int pieces = static_cast<int>(std::ceil(longest / (0.5 * cell_phi)));
    for (int i = 0; i < pieces; i++) {
        double a = static_cast<double>(i) / pieces;
        double b = static_cast<double>(i + 1) / pieces;
        drawing->line(raised(pm_sphere_at(t0 + a * (t1 - t0), p0 + a * (p1 - p0)), grid_height),
                      raised(pm_sphere_at(t0 + b * (t1 - t0), p0 + b * (p1 - p0)), grid_height),
                      pm_colour_named(PM_COLOUR_WHITE), opacity);
    }
}

void draw_grid(pm_figure *figure, const grid &g, double width)
{
    pm_drawing lines;
    double t0 = g.theta_from * cell_theta;
    double t1 = g.theta_to * cell_theta;
    double p0 = g.phi_from * cell_phi;
    double p1 = g.phi_to * cell_phi;
    for (int i = g.theta_from; i <= g.theta_to; i += g.step) {
        draw_arc(&lines, i * cell_theta, p0, i * cell_theta, p1, g.opacity);
    }
    for (int j = g.phi_from; j <= g.phi_to; j += g.step) {
        draw_arc(&lines, t0, j * cell_phi, t1, j * cell_phi, g.opacity);
    }
    figure->renderer->AddActor(lines.actor(figure->pixels(width), 1.0));
}

/// The lines that a patch shows, a few more to each side.
grid grid_of(const pm_sphere_patch *patch)
{
    const int beyond = 8;
    int theta = static_cast<int>(std::lround(patch->theta / cell_theta));
    int phi = static_cast<int>(std::lround(patch->phi / cell_phi));
    grid g = {std::max(theta - beyond, 0),
              std::min(theta + beyond, PM_SPHERE_CELLS),
              phi - beyond,
              phi + beyond,
              1,
              0.35};
    if (theta == 0 || theta == PM_SPHERE_CELLS) {
        g.phi_from = 0;
        g.phi_to = PM_SPHERE_CELLS - 1;
        g.opacity = 0.18;
    }
    return g;
}

void draw_pairs(pm_figure *figure, const pm_sphere_patch *patch)
{
    pm_drawing links;
    pm_drawing exact;
    pm_drawing packed;
    for (int i = 0; i < patch->count; i++) {
        pm_vec3 from = raised(patch->pairs[i].exact, dot_height);
        pm_vec3 to = raised(patch->pairs[i].packed, dot_height);
        links.line(from, to, pm_colour_named(PM_COLOUR_WHITE), 0.9);
        exact.dot(from, pm_colour_named(exact_colour), 1.0);
        packed.dot(to, pm_colour_named(packed_colour), 1.0);
    }
    figure->renderer->AddActor(links.actor(figure->pixels(1.6), 1.0));
    figure->renderer->AddActor(packed.actor(1.0, figure->pixels(8.0)));
    figure->renderer->AddActor(exact.actor(1.0, figure->pixels(7.0)));
}

void draw_ring(pm_figure *figure, const pm_sphere_patch *patch)
{
    pm_drawing ring;
    const int sides = 48;
    pm_vec3 middle = pm_sphere_at(patch->theta, patch->phi);
    pm_vec3 across = pm_vec_normalize(
        pm_vec_cross(middle, std::fabs(middle.z) > 0.9 ? pm_vec(1, 0, 0) : pm_vec(0, 0, 1)));
    pm_vec3 along = pm_vec_cross(middle, across);
    std::vector<pm_vec3> rim;
    for (int i = 0; i < sides; i++) {
        double a = turn * i / sides;
        pm_vec3 out =
            pm_vec_add(pm_vec_scale(across, std::cos(a)), pm_vec_scale(along, std::sin(a)));
        pm_vec3 at = pm_vec_along(middle, out, 1.6 * PM_SPHERE_REACH);
        rim.push_back(raised(pm_vec_normalize(at), 1.004));
    }
    ring.outline(rim, pm_colour_named(PM_COLOUR_WHITE), 1.0);
    figure->renderer->AddActor(ring.actor(figure->pixels(2.5), 1.0));
}

/// Between the patches and above the equator, so that all are seen.
pm_vec3 choose_view(const pm_sphere_patch *patches, int count)
{
    pm_vec3 sum = pm_vec(0.0, 0.0, 0.0);
    for (int i = 0; i < count; i++) {
        sum = pm_vec_add(sum, pm_sphere_at(patches[i].theta, patches[i].phi));
    }
    return pm_vec_normalize(sum);
}

vtkSmartPointer<vtkFloatArray> wrap(const char *name, float *values, int components,
                                    uint32_t count)
{
    auto array = vtkSmartPointer<vtkFloatArray>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    array->SetArray(values, static_cast<vtkIdType>(count) * components, 1);
    return array;
}

} // namespace

pm_status pm_draw_sphere(pm_figure *figure, const pm_rect *where, const pm_sphere_choice *whole,
                         const pm_sphere_patch *patches, int count)
{
    return pm_figure_guard("a sphere of directions", [&] {
        const double distance = 5.0;
        double half = 1.05 / std::sqrt(distance * distance - 1.0);
        pm_viewpoint v = look_at(choose_view(patches, count), half, distance, *where);
        PM_TRY(pm_figure_panel(figure, where, &v));
        draw_ball(figure);
        draw_grid(figure, {0, PM_SPHERE_CELLS, 0, PM_SPHERE_CELLS - 1, PM_SPHERE_STEP, 0.3},
                  1.0);
        pm_drawing dots;
        for (int i = 0; i < whole->count; i++) {
            dots.dot(raised(whole->pairs[i].exact, dot_height), pm_colour_named(exact_colour),
                     1.0);
        }
        figure->renderer->AddActor(dots.actor(1.0, figure->pixels(2.2)));
        for (int i = 0; i < count; i++) {
            draw_ring(figure, &patches[i]);
        }
        return PM_OK;
    });
}

pm_status pm_draw_patch(pm_figure *figure, const pm_rect *where, const pm_sphere_patch *patch)
{
    return pm_figure_guard("a patch of directions", [&] {
        const double above = 8.0 * PM_SPHERE_REACH;
        pm_viewpoint v = look_at(pm_sphere_at(patch->theta, patch->phi), PM_SPHERE_HALF / above,
                                 1.0 + above, *where);
        PM_TRY(pm_figure_panel(figure, where, &v));
        draw_ball(figure);
        draw_grid(figure, grid_of(patch), 1.2);
        draw_pairs(figure, patch);
        return PM_OK;
    });
}

pm_status pm_draw_packing_legend(pm_figure *figure, const pm_rect *row)
{
    figure->column_top = figure->height - row->y;
    const pm_legend_entry dots[] = {
        {PM_SWATCH_DOT, pm_colour_named(exact_colour), "exact direction"},
        {PM_SWATCH_DOT, pm_colour_named(packed_colour), "where its bytes put it"},
        {PM_SWATCH_LINE, pm_colour_named(PM_COLOUR_WHITE), "the error between"},
    };
    PM_TRY(pm_figure_legend(figure, "directions", dots, 3));
    const pm_legend_entry cells[] = {
        {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_GREY), "256 steps from pole to pole,"},
        {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_GREY), "256 around: 65,536 cells."},
        {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_GREY), "The ball shows every 8th"},
        {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_GREY), "line, the others all lines."},
    };
    return pm_figure_legend(figure, "grid", cells, 4);
}

pm_status pm_draw_packing_keep(pm_figure *figure, float (*exact)[3], float (*packed)[3],
                               float *angle, float *power, uint32_t count)
{
    return pm_figure_guard("directions", [&] {
        vtkNew<vtkPoints> points;
        points->SetData(wrap("exact direction", &exact[0][0], 3, count));
        vtkNew<vtkCellArray> cells;
        for (vtkIdType i = 0; i < count; i++) {
            cells->InsertNextCell(1, &i);
        }
        auto data = vtkSmartPointer<vtkPolyData>::New();
        data->SetPoints(points);
        data->SetVerts(cells);
        vtkPointData *numbers = data->GetPointData();
        numbers->AddArray(wrap("packed direction", &packed[0][0], 3, count));
        numbers->AddArray(wrap("angle between [degrees]", angle, 1, count));
        numbers->AddArray(wrap("error of power [of the strongest channel]", power, 3, count));
        pm_figure_keep(figure, "direction", data);
        return PM_OK;
    });
}

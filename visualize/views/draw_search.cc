// Colours tell the order, so everything of a visit has its colour. Balls are circles that face
// the camera: that is how a ball looks.
#include "draw_search.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>

#include <cmath>

namespace {

const int ball_sides = 96;
const int ring_sides = 28;      // many short lines have gaps
const double ring_radius = 8.5; // of photons found, in pixels of a picture 900 high
const size_t circles_most = 4;  // on the way to the last one

/// Dark ones would be lost on the ground.
pm_colour order_colour(double position)
{
    return pm_colour_viridis(0.22 + 0.78 * position);
}

pm_colour colour_of(const pm_visit_set *search, uint64_t visit)
{
    double steps = search->count > 1 ? static_cast<double>(search->count - 1) : 1.0;
    return order_colour(static_cast<double>(visit) / steps);
}

void add_box(pm_drawing *drawing, pm_vec3 low, pm_vec3 high, pm_colour colour, double opacity)
{
    auto corner = [&](int i) {
        return pm_vec((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y,
                      (i & 4) != 0 ? high.z : low.z);
    };
    for (int i = 0; i < 8; i++) {
        for (int bit = 1; bit < 8; bit *= 2) {
            if ((i & bit) == 0) {
                drawing->line(corner(i), corner(i + bit), colour, opacity);
            }
        }
    }
}

/// Late cells are small and lie in early ones: they are drawn over them.
void draw_cells(pm_figure *figure, const pm_visit_set *search)
{
    pm_drawing boxes;
    for (uint64_t i = 0; i < search->count; i++) {
        const pm_visited &visit = search->visits[i];
        add_box(&boxes, visit.low, visit.high, colour_of(search, i), 0.7);
    }
    figure->renderer->AddActor(boxes.actor(figure->pixels(1.4), 1.0));
}

/// The rectangles that the plane through the point across `axis` cuts out of the cells.
void draw_cut_cells(pm_figure *figure, const pm_visit_set *search, int axis)
{
    pm_drawing rectangles;
    double plane = pm_vec_axis(search->at, axis);
    auto flat = [&](pm_vec3 p) {
        return pm_vec(axis == 0 ? plane : p.x, axis == 1 ? plane : p.y,
                      axis == 2 ? plane : p.z);
    };
    for (uint64_t i = 0; i < search->count; i++) {
        const pm_visited &visit = search->visits[i];
        if (pm_vec_axis(visit.low, axis) <= plane && pm_vec_axis(visit.high, axis) >= plane) {
            add_box(&rectangles, flat(visit.low), flat(visit.high), colour_of(search, i), 0.8);
        }
    }
    figure->renderer->AddActor(rectangles.actor(figure->pixels(1.8), 1.0));
}

void add_circle(pm_drawing *drawing, const pm_viewpoint &v, pm_vec3 at, double radius,
                int sides, double opacity)
{
    std::vector<pm_vec3> rim;
    for (int i = 0; i < sides; i++) {
        double phi = 2.0 * PM_PI * i / sides;
        pm_vec3 along = pm_vec_along(pm_vec_scale(v.right, std::cos(phi)), v.up, std::sin(phi));
        rim.push_back(pm_vec_along(at, along, radius));
    }
    drawing->outline(rim, pm_colour_named(PM_COLOUR_WHITE), opacity);
}

/// The visits after which the ball is drawn: some of those that made it smaller, and the last.
std::vector<uint64_t> choose_balls(const pm_visit_set *search)
{
    std::vector<uint64_t> smaller;
    for (uint64_t i = 0; i < search->count; i++) {
        double before = i > 0 ? search->visits[i - 1].radius : HUGE_VAL;
        if (search->visits[i].radius < before) {
            smaller.push_back(i);
        }
    }
    std::vector<uint64_t> chosen;
    size_t count = std::min(smaller.size(), circles_most + 1);
    for (size_t i = 0; i < count; i++) {
        chosen.push_back(smaller[count > 1 ? i * (smaller.size() - 1) / (count - 1) : 0]);
    }
    return chosen;
}

void draw_balls(pm_figure *figure, const pm_visit_set *search)
{
    pm_drawing on_the_way;
    pm_drawing last;
    std::vector<uint64_t> balls = choose_balls(search);
    for (uint64_t visit : balls) {
        pm_drawing *to = visit == balls.back() ? &last : &on_the_way;
        add_circle(to, figure->viewpoint, search->at, search->visits[visit].radius, ball_sides,
                   visit == balls.back() ? 1.0 : 0.55);
    }
    figure->renderer->AddActor(on_the_way.actor(figure->pixels(1.2), 1.0));
    figure->renderer->AddActor(last.actor(figure->pixels(3.0), 1.0));
}

/// How many metres a pixel is where `at` is seen.
double metres_per_pixel(const pm_viewpoint &v, pm_vec3 at)
{
    double depth = pm_vec_dot(pm_vec_sub(at, v.position), v.forward);
    return 2.0 * depth * v.tan_y / v.height;
}

/// Dots, and rings around those of the answer.
void draw_photons(pm_figure *figure, const pm_visit_set *search)
{
    pm_drawing rings;
    pm_drawing dots;
    const pm_viewpoint &v = figure->viewpoint;
    for (uint64_t i = 0; i < search->count; i++) {
        const pm_visited &visit = search->visits[i];
        dots.dot(visit.position, colour_of(search, i), 1.0);
        if (visit.found) {
            double radius = figure->pixels(ring_radius) * metres_per_pixel(v, visit.position);
            add_circle(&rings, v, visit.position, radius, ring_sides, 1.0);
        }
    }
    figure->renderer->AddActor(dots.actor(1.0, figure->pixels(9.0)));
    figure->renderer->AddActor(rings.actor(figure->pixels(2.0), 1.0));
}

void draw_cross(pm_figure *figure, const pm_visit_set *search, double arm)
{
    pm_drawing cross;
    const pm_viewpoint &v = figure->viewpoint;
    for (const pm_vec3 &along : {v.right, v.up}) {
        cross.line(pm_vec_along(search->at, along, -arm), pm_vec_along(search->at, along, arm),
                   pm_colour_named(PM_COLOUR_VERMILLION), 1.0);
    }
    figure->renderer->AddActor(cross.actor(figure->pixels(3.0), 1.0));
}

} // namespace

pm_status pm_draw_search(pm_figure *figure, const pm_visit_set *search, int cut_across,
                         double cross)
{
    return pm_figure_guard("a search", [&] {
        if (cut_across < 0) {
            draw_cells(figure, search);
        } else {
            draw_cut_cells(figure, search, cut_across);
        }
        draw_balls(figure, search);
        draw_photons(figure, search);
        draw_cross(figure, search, cross);
        return PM_OK;
    });
}

pm_status pm_draw_search_legend(pm_figure *figure, const pm_visit_set *search, bool others)
{
    return pm_figure_guard("a legend", [&] {
        double last = static_cast<double>(search->count > 1 ? search->count : 2);
        const pm_scale order = {"cell and photon:\norder of the visit", 1.0, last, false,
                                order_colour};
        PM_TRY(pm_figure_scale(figure, &order));
        const pm_colour white = pm_colour_named(PM_COLOUR_WHITE);
        const pm_legend_entry signs[] = {
            {PM_SWATCH_LINE, pm_colour_named(PM_COLOUR_VERMILLION), "cross: asked about here"},
            {PM_SWATCH_DOT, white, "ring: one of the nearest"},
            {PM_SWATCH_LINE, white, "bold circle: final ball"},
            {PM_SWATCH_LINE, pm_colour_dim(white, 0.55), "thin: ball on the way"},
            {PM_SWATCH_DOT, pm_colour_named(PM_COLOUR_GREY), "dim: never looked at"},
        };
        return pm_figure_legend(figure, "signs", signs, others ? 5 : 4);
    });
}

pm_status pm_draw_search_keep(pm_figure *figure, const pm_visit_set *search)
{
    return pm_figure_guard("visits", [&] {
        vtkNew<vtkPoints> points;
        vtkNew<vtkCellArray> dots;
        vtkNew<vtkIntArray> whole[5];
        vtkNew<vtkDoubleArray> distance;
        const char *const names[5] = {"order", "photon", "depth", "kept", "found"};
        for (int i = 0; i < 5; i++) {
            whole[i]->SetName(names[i]);
        }
        distance->SetName("distance [m]");
        points->SetDataTypeToFloat();
        for (uint64_t i = 0; i < search->count; i++) {
            const pm_visited &visit = search->visits[i];
            const uint64_t values[5] = {i + 1, visit.photon, visit.depth, visit.kept ? 1u : 0u,
                                        visit.found ? 1u : 0u};
            vtkIdType id =
                points->InsertNextPoint(visit.position.x, visit.position.y, visit.position.z);
            dots->InsertNextCell(1, &id);
            for (int a = 0; a < 5; a++) {
                whole[a]->InsertNextValue(static_cast<int>(values[a]));
            }
            distance->InsertNextValue(visit.distance);
        }
        auto data = vtkSmartPointer<vtkPolyData>::New();
        data->SetPoints(points);
        data->SetVerts(dots);
        for (const auto &array : whole) {
            data->GetPointData()->AddArray(array);
        }
        data->GetPointData()->AddArray(distance);
        pm_figure_keep(figure, "photon looked at", data);
        return PM_OK;
    });
}

// The ball and the disc are one thing to draw: a ball flattened along the normal, as the search
// measures distances in it. It is lit by nothing; like a soap bubble it is denser towards its
// outline, so that its photons stay the brightest thing in the picture.
#include "draw_gather.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>

#include <cmath>

namespace {

const int sides = 72; // of a circle
const int rings = 24; // from pole to pole
const double thin = 0.05;
const double dense = 0.42;
const double dim = 0.45; // opacity of photons that do not count

pm_colour shell_colour()
{
    return pm_colour_named(PM_COLOUR_YELLOW);
}

/// The region's own axes: in its plane s and t, n along the normal.
struct region {
    pm_vec3 at;
    pm_frame frame;
    double radius, height;

    pm_vec3 place(double s, double t, double n) const
    {
        pm_vec3 local = pm_vec(radius * s, radius * t, height * n);
        return pm_vec_add(at, pm_frame_to_world(&frame, local));
    }
};

region region_of(const pm_gathered *g)
{
    return {g->at, pm_frame_around(g->normal), g->radius, g->radius * g->flatness};
}

/// How dense the shell looks at a point of the unit ball, seen from `eye`.
double density(const region &r, pm_vec3 on, pm_vec3 eye)
{
    pm_vec3 slope = pm_vec(on.x / r.radius, on.y / r.radius, on.z / r.height);
    pm_vec3 out = pm_vec_normalize(pm_frame_to_world(&r.frame, slope));
    pm_vec3 to = pm_vec_normalize(pm_vec_sub(eye, r.place(on.x, on.y, on.z)));
    double edge = 1.0 - std::fabs(pm_vec_dot(out, to));
    return thin + (dense - thin) * edge * edge * edge;
}

void add_shell(pm_figure *figure, const region &r)
{
    pm_drawing shell;
    for (int i = 0; i <= rings; i++) {
        double theta = PM_PI * i / rings;
        for (int j = 0; j < sides; j++) {
            double phi = 2.0 * PM_PI * j / sides;
            pm_vec3 on = pm_vec(std::sin(theta) * std::cos(phi),
                                std::sin(theta) * std::sin(phi), std::cos(theta));
            shell.vertex(r.place(on.x, on.y, on.z), shell_colour(),
                         density(r, on, figure->viewpoint.position));
        }
    }
    for (vtkIdType i = 0; i < rings; i++) {
        for (vtkIdType j = 0; j < sides; j++) {
            vtkIdType next = (j + 1) % sides;
            shell.triangle(i * sides + j, i * sides + next, (i + 1) * sides + next);
            shell.triangle(i * sides + j, (i + 1) * sides + next, (i + 1) * sides + j);
        }
    }
    figure->renderer->AddActor(shell.actor(1.0, 1.0));
}

/// The circle in which the region meets its surface, and two across it.
void add_rims(pm_figure *figure, const region &r)
{
    std::vector<pm_vec3> level;
    std::vector<pm_vec3> across[2];
    for (int i = 0; i < sides; i++) {
        double c = std::cos(2.0 * PM_PI * i / sides);
        double s = std::sin(2.0 * PM_PI * i / sides);
        level.push_back(r.place(c, s, 0.0));
        across[0].push_back(r.place(c, 0.0, s));
        across[1].push_back(r.place(0.0, c, s));
    }
    pm_drawing strong;
    pm_drawing weak;
    strong.outline(level, shell_colour(), 0.95);
    weak.outline(across[0], shell_colour(), 0.35);
    weak.outline(across[1], shell_colour(), 0.35);
    figure->renderer->AddActor(strong.actor(figure->pixels(2.2), 1.0));
    figure->renderer->AddActor(weak.actor(figure->pixels(1.0), 1.0));
}

/// The normal as an arrow from the point, and the radius as a line to the right of the picture.
pm_status add_measures(pm_figure *figure, const pm_gathered *g)
{
    const double tip = 1.15; // in radii
    const double head = 0.16;
    pm_colour white = pm_colour_named(PM_COLOUR_WHITE);
    pm_frame frame = pm_frame_around(g->normal);
    pm_vec3 end = pm_vec_along(g->at, g->normal, tip * g->radius);
    pm_vec3 neck = pm_vec_along(g->at, g->normal, (tip - head) * g->radius);
    pm_vec3 right = figure->viewpoint.right;
    right = pm_vec_normalize(pm_vec_along(right, g->normal, -pm_vec_dot(right, g->normal)));
    pm_vec3 rim = pm_vec_along(g->at, right, g->radius);
    pm_drawing measures;
    measures.line(g->at, neck, white, 1.0);
    measures.line(g->at, rim, white, 0.8);
    for (int i = 0; i < sides; i++) {
        double phi[2] = {2.0 * PM_PI * i / sides, 2.0 * PM_PI * (i + 1) / sides};
        pm_vec3 foot[2];
        for (int k = 0; k < 2; k++) {
            pm_vec3 local = pm_vec(0.35 * head * g->radius * std::cos(phi[k]),
                                   0.35 * head * g->radius * std::sin(phi[k]), 0.0);
            foot[k] = pm_vec_add(neck, pm_frame_to_world(&frame, local));
        }
        measures.polygon({end, foot[0], foot[1]}, white, 1.0);
    }
    measures.dot(g->at, white, 1.0);
    figure->renderer->AddActor(measures.actor(figure->pixels(2.0), figure->pixels(7.0)));
    PM_TRY(pm_figure_mark(figure, pm_vec_along(end, g->normal, 0.12 * g->radius), "normal"));
    return pm_figure_mark(figure, pm_vec_along(g->at, right, 1.09 * g->radius), "r");
}

pm_colour colour_of(const pm_gathered *g, const pm_gathered_photon &photon)
{
    switch (photon.fate) {
    case PM_GATHERED_COUNTED:
        return pm_vec_dot(photon.normal, g->normal) > PM_GATHER_SAME
                   ? pm_colour_named(PM_COLOUR_ORANGE)
                   : pm_colour_named(PM_COLOUR_SKY);
    case PM_GATHERED_RIM:
        return pm_colour_named(PM_COLOUR_WHITE);
    case PM_GATHERED_NEAR:
        return pm_colour_named(PM_COLOUR_GREY);
    case PM_GATHERED_BEHIND:
        break;
    }
    return pm_colour_named(PM_COLOUR_PURPLE);
}

void add_photons(pm_figure *figure, const pm_gathered *g)
{
    pm_drawing bright;
    pm_drawing faint;
    for (uint64_t i = 0; i < g->count; i++) {
        const pm_gathered_photon &photon = g->photons[i];
        bool inside = photon.fate == PM_GATHERED_COUNTED || photon.fate == PM_GATHERED_RIM;
        if (inside) {
            bright.dot(photon.position, colour_of(g, photon), 1.0);
        } else {
            faint.dot(photon.position, colour_of(g, photon), dim);
        }
    }
    figure->renderer->AddActor(faint.actor(1.0, figure->pixels(4.0)));
    figure->renderer->AddActor(bright.actor(1.0, figure->pixels(8.0)));
}

template <class Array> vtkSmartPointer<Array> named(const char *name, int components)
{
    auto array = vtkSmartPointer<Array>::New();
    array->SetName(name);
    array->SetNumberOfComponents(components);
    return array;
}

void keep_photons(pm_figure *figure, const pm_gathered *g)
{
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> dots;
    auto power = named<vtkDoubleArray>("power [W]", 3);
    auto normal = named<vtkDoubleArray>("surface normal", 3);
    auto direction = named<vtkDoubleArray>("direction", 3);
    auto distance = named<vtkDoubleArray>("distance [m]", 1);
    auto weight = named<vtkDoubleArray>("weight", 1);
    auto fate = named<vtkIntArray>("fate (0 counted, 1 rim, 2 near, 3 behind)", 1);
    for (uint64_t i = 0; i < g->count; i++) {
        const pm_gathered_photon &p = g->photons[i];
        vtkIdType id = points->InsertNextPoint(p.position.x, p.position.y, p.position.z);
        dots->InsertNextCell(1, &id);
        power->InsertNextTuple(p.power.c);
        normal->InsertNextTuple3(p.normal.x, p.normal.y, p.normal.z);
        direction->InsertNextTuple3(p.direction.x, p.direction.y, p.direction.z);
        distance->InsertNextValue(p.distance);
        weight->InsertNextValue(p.weight);
        fate->InsertNextValue(static_cast<int>(p.fate));
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetVerts(dots);
    for (vtkDataArray *array :
         {static_cast<vtkDataArray *>(power), static_cast<vtkDataArray *>(normal),
          static_cast<vtkDataArray *>(direction), static_cast<vtkDataArray *>(distance),
          static_cast<vtkDataArray *>(weight), static_cast<vtkDataArray *>(fate)}) {
        data->GetPointData()->AddArray(array);
    }
    pm_figure_keep(figure, g->disc ? "photon around a disc" : "photon around a ball", data);
}

} // namespace

pm_status pm_draw_gather(pm_figure *figure, const pm_gathered *gathered)
{
    return pm_figure_guard("a gather region", [&] {
        add_photons(figure, gathered);
        keep_photons(figure, gathered);
        if (!(gathered->radius > 0.0)) {
            return PM_OK;
        }
        region r = region_of(gathered);
        add_rims(figure, r);
        add_shell(figure, r);
        return add_measures(figure, gathered);
    });
}

pm_status pm_draw_gather_legend(pm_figure *figure, bool behind)
{
    const pm_legend_entry photons[] = {
        {PM_SWATCH_DOT, pm_colour_named(PM_COLOUR_ORANGE), "counts, on this surface"},
        {PM_SWATCH_DOT, pm_colour_named(PM_COLOUR_SKY), "counts, on another one"},
        {PM_SWATCH_DOT, pm_colour_named(PM_COLOUR_WHITE), "sets r, does not count"},
        {PM_SWATCH_DOT, pm_colour_dim(pm_colour_named(PM_COLOUR_GREY), 0.6), "out of reach"},
        {PM_SWATCH_DOT, pm_colour_dim(pm_colour_named(PM_COLOUR_PURPLE), 0.6), "faces away"},
    };
    const pm_legend_entry shell[] = {{PM_SWATCH_LINE, shell_colour(), "reach of the search"}};
    PM_TRY(pm_figure_legend(figure, "photons", photons, behind ? 5 : 4));
    return pm_figure_legend(figure, "ball or disc", shell, 1);
}

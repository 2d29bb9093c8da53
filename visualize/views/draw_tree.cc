// Split planes as translucent faces with outlines. Depth thins both out, so that the first
// splits stand out and the small cells of the last ones do not bury them.
#include "draw_tree.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>

#include <algorithm>
#include <cmath>

namespace {

const pm_colour_name axis_colours[3] = {PM_COLOUR_VERMILLION, PM_COLOUR_GREEN, PM_COLOUR_SKY};
const int numbered = 3; // depths whose planes bear their number

double face_opacity(int depth)
{
    return 0.30 * std::pow(0.62, depth) + 0.03;
}

double outline_opacity(int depth)
{
    return std::max(0.95 - 0.13 * depth, 0.35);
}

double outline_width(int depth)
{
    return std::max(6.5 * std::pow(0.62, depth), 1.0);
}

uint64_t draw_depth(pm_figure *figure, const pm_tree_split_set *tree, int depth)
{
    pm_drawing drawing;
    uint64_t drawn = 0;
    for (uint32_t i = 0; i < tree->count; i++) {
        const pm_tree_split *split = &tree->splits[i];
        if (split->depth == depth) {
            pm_colour colour = pm_colour_named(axis_colours[split->axis]);
            drawing.quad(split->corner, colour, face_opacity(depth));
            drawing.outline({split->corner, split->corner + 4}, colour, outline_opacity(depth));
            drawn++;
        }
    }
    // Thinner in a small panel, but not as much as it is smaller.
    double shrink = std::sqrt(static_cast<double>(figure->viewpoint.height) / figure->height);
    double width = std::max(shrink * outline_width(depth), 1.0);
    figure->renderer->AddActor(drawing.actor(figure->pixels(width), 1.0));
    return drawn;
}

struct spot {
    double x, y; // pixels in the panel
};

double room_around(const spot &at, const std::vector<spot> &taken, const pm_viewpoint &v)
{
    double room = std::min({at.x, v.width - at.x, at.y, v.height - at.y}) + 40.0;
    for (const spot &other : taken) {
        room = std::min(room, std::hypot(at.x - other.x, at.y - other.y));
    }
    return room;
}

/// Puts a plane's number near that one of its corners that has most room around it.
pm_status put_number(pm_figure *figure, const pm_tree_split *split, std::vector<spot> *taken)
{
    const double towards_corner = 0.86;
    pm_vec3 middle = pm_vec_scale(pm_vec_add(split->corner[0], split->corner[2]), 0.5);
    pm_vec3 best = middle;
    spot best_spot = {0.0, 0.0};
    double most = -HUGE_VAL;
    for (const pm_vec3 &corner : split->corner) {
        pm_vec3 at = pm_vec_along(middle, pm_vec_sub(corner, middle), towards_corner);
        spot here = {0.0, 0.0};
        if (!pm_viewpoint_project(&figure->viewpoint, at, &here.x, &here.y)) {
            continue;
        }
        double room = room_around(here, *taken, figure->viewpoint);
        if (room > most) {
            most = room;
            best = at;
            best_spot = here;
        }
    }
    taken->push_back(best_spot);
    return pm_figure_mark(figure, best, std::to_string(split->depth).c_str());
}

pm_status put_numbers(pm_figure *figure, const pm_tree_split_set *tree, int depths)
{
    std::vector<spot> taken;
    for (uint32_t i = 0; i < tree->count; i++) {
        if (tree->splits[i].depth < std::min(depths, numbered)) {
            PM_TRY(put_number(figure, &tree->splits[i], &taken));
        }
    }
    return PM_OK;
}

/// The planes as polygons with their numbers.
vtkSmartPointer<vtkPolyData> make_data(const pm_tree_split_set *tree, int depths,
                                       pm_vec3 center)
{
    vtkNew<vtkPoints> points;
    vtkNew<vtkCellArray> planes;
    vtkNew<vtkIntArray> axis;
    vtkNew<vtkIntArray> depth;
    vtkNew<vtkDoubleArray> position;
    axis->SetName("axis");
    depth->SetName("depth");
    position->SetName("position [m]");
    points->SetDataTypeToFloat();
    for (uint32_t i = 0; i < tree->count; i++) {
        const pm_tree_split *split = &tree->splits[i];
        if (split->depth >= depths) {
            continue;
        }
        planes->InsertNextCell(4);
        for (const pm_vec3 &at : split->corner) {
            planes->InsertCellPoint(points->InsertNextPoint(at.x, at.y, at.z));
        }
        axis->InsertNextValue(split->axis);
        depth->InsertNextValue(split->depth);
        position->InsertNextValue(pm_vec_axis(split->corner[0], split->axis) +
                                  pm_vec_axis(center, split->axis));
    }
    auto data = vtkSmartPointer<vtkPolyData>::New();
    data->SetPoints(points);
    data->SetPolys(planes);
    data->GetCellData()->AddArray(axis);
    data->GetCellData()->AddArray(depth);
    data->GetCellData()->AddArray(position);
    return data;
}

} // namespace

pm_status pm_draw_tree(pm_figure *figure, const pm_tree_split_set *tree, int depths,
                       const char *name, pm_vec3 center, uint64_t *drawn)
{
    return pm_figure_guard("a tree", [&] {
        uint64_t planes = 0;
        for (int depth = 0; depth < std::min(depths, tree->depths); depth++) {
            planes += draw_depth(figure, tree, depth);
        }
        PM_TRY(put_numbers(figure, tree, depths));
        pm_figure_keep(figure, name, make_data(tree, depths, center));
        *drawn = planes;
        return PM_OK;
    });
}

pm_status pm_draw_tree_legend(pm_figure *figure, int depths)
{
    const pm_legend_entry axes[] = {
        {PM_SWATCH_FILL, pm_colour_named(axis_colours[0]), "across x"},
        {PM_SWATCH_FILL, pm_colour_named(axis_colours[1]), "across y"},
        {PM_SWATCH_FILL, pm_colour_named(axis_colours[2]), "across z"},
    };
    PM_TRY(pm_figure_legend(figure, "split plane", axes, 3));
    const pm_colour white = pm_colour_named(PM_COLOUR_WHITE);
    const pm_legend_entry numbers[] = {
        {PM_SWATCH_NONE, white, "0  boldest: the first cut"},
        {PM_SWATCH_NONE, white, "1  then each side of it"},
        {PM_SWATCH_NONE, white, "2  then each part again"},
        {PM_SWATCH_NONE, white, "thinner still: deeper"},
    };
    int count = depths > numbered ? numbered + 1 : depths;
    return pm_figure_legend(figure, "number: depth of a plane", numbers, count);
}

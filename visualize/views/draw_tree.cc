// Split planes as translucent faces with outlines. Depth fades both, so that the first splits
// stand out and the small cells of the last ones do not bury them.
#include "draw_tree.h"
#include "core.hh"
#include "drawing.hh"
#include "figure.hh"

#include <algorithm>
#include <cmath>

namespace {

const pm_colour_name axis_colours[3] = {PM_COLOUR_VERMILLION, PM_COLOUR_GREEN, PM_COLOUR_SKY};

double face_opacity(int depth)
{
    return 0.30 * std::pow(0.62, depth) + 0.03;
}

double outline_width(int depth)
{
    return std::max(3.2 - 0.5 * depth, 1.0);
}

void draw_depth(pm_figure *figure, const pm_tree_split_set *tree, int depth)
{
    pm_drawing drawing;
    for (uint32_t i = 0; i < tree->count; i++) {
        const pm_tree_split *split = &tree->splits[i];
        if (split->depth == depth) {
            pm_colour colour = pm_colour_named(axis_colours[split->axis]);
            drawing.quad(split->corner, colour, face_opacity(depth));
            drawing.outline({split->corner, split->corner + 4}, colour, 0.9);
        }
    }
    figure->renderer->AddActor(drawing.actor(figure->pixels(outline_width(depth)), 1.0));
}

} // namespace

pm_status pm_draw_tree(pm_figure *figure, const pm_tree_split_set *tree)
{
    return pm_figure_guard("a tree", [&] {
        for (int depth = 0; depth < tree->depths; depth++) {
            draw_depth(figure, tree, depth);
        }
        const pm_legend_entry axes[] = {
            {PM_SWATCH_FILL, pm_colour_named(axis_colours[0]), "across x"},
            {PM_SWATCH_FILL, pm_colour_named(axis_colours[1]), "across y"},
            {PM_SWATCH_FILL, pm_colour_named(axis_colours[2]), "across z"},
        };
        PM_TRY(pm_figure_legend(figure, "split plane", axes, 3));
        const pm_legend_entry depths[] = {
            {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_WHITE),
             "bold outline: depth 0, the root"},
            {PM_SWATCH_NONE, pm_colour_named(PM_COLOUR_WHITE), "thin: deeper, smaller cells"},
        };
        return pm_figure_legend(figure, "depth", depths, 2);
    });
}

// One light of `view directions`: its sphere and, below or beside it, the chart of its photons
// over the angle.
#ifndef PM_VIEW_DIRECTIONS_PANEL_H
#define PM_VIEW_DIRECTIONS_PANEL_H

#include "draw_directions.h"
#include "ray_tally.h"
#include "view.h"

/// One light and all that is drawn of it.
typedef struct {
    int index; // in the scene
    pm_light_law law;
    pm_ray_tally tally;
    pm_direction_dot *dots; // some of its photons
    uint64_t dot_count;
} pm_direction_light;

/// Draws a light in a cell of the page, under its name.
/// @param place   0, 1 ..: of the light in the figure
/// @param beside  the chart stands beside the sphere, not below it
pm_status pm_draw_direction_light(pm_view *view, const pm_direction_light *light, int place,
                                  bool beside, const pm_rect *cell);

/// The colour of a density, as part of the light's most. Dark enough for white dots.
pm_colour pm_direction_colour(double t);

#endif

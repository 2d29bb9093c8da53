// Directions on a unit sphere over the density that they should have.
#ifndef PM_DRAW_DIRECTIONS_H
#define PM_DRAW_DIRECTIONS_H

#include "figure.h"
#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A direction taken, as a point of the sphere.
typedef struct {
    pm_vec3 way;       // unit, in the sphere's coordinates: z is the axis
    pm_spectrum power; // [W]
    bool stray;        // where none should be
} pm_direction_dot;

typedef struct {
    pm_vec3 middle;           // [m, centred] of the sphere, whose radius is 1
    pm_frame axis;            // how it stands
    const char *axis_word;    // at the axis' end; NULL: the axis is not drawn
    double reach;             // [rad] from the axis that any direction goes; 0: only one is
    const pm_colour *colours; // of rings of equal width, from the axis to `reach`
    int ring_count;           // of them
    const double *circle;     // [rad] circles drawn on the sphere, for orientation
    int circle_count;         // of them
    const pm_direction_dot *dots;
    uint64_t count;
    int light;
} pm_direction_sphere;

/// Draws the sphere in the current panel; what is behind it is not seen. Keeps the dots.
pm_status pm_draw_directions(pm_figure *figure, const pm_direction_sphere *sphere,
                             double dot_size);

/// Of the part of the sphere that no direction should be on, and of a direction that is.
pm_colour pm_direction_dark(void);
pm_colour pm_direction_stray(void);

#ifdef __cplusplus
}
#endif
#endif

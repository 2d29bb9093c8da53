// From where a picture is seen: a pinhole camera with a shifted film, so that the whole scene
// stands in the part of the picture that title and legend leave free.
//
// A point at (x, y, z) along right, up, forward from the position lands at
// (x / (z tan_x) - shift_x, y / (z tan_y) - shift_y) in [-1, 1]^2, y up.
#ifndef PM_VIEWPOINT_H
#define PM_VIEWPOINT_H

#include "scene.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

// What is kept free for text, as parts of the picture's width and height.
#define PM_VIEWPOINT_TOP 0.125
#define PM_VIEWPOINT_BOTTOM 0.03
#define PM_VIEWPOINT_LEFT 0.02
#define PM_VIEWPOINT_RIGHT 0.26

typedef struct {
    pm_vec3 position;           // [m], centred
    pm_vec3 right, up, forward; // unit; right is a picture's right
    double tan_x, tan_y;        // of half the field of view
    double shift_x, shift_y;    // of the film, in half widths and half heights
    int width, height;          // pixels
} pm_viewpoint;

/// The scene's camera (an oblique one when it has none) with the field of view that shows all
/// of the scene's bounds. A camera inside the bounds, or too close for that, is moved straight
/// back.
pm_viewpoint pm_viewpoint_of(const pm_scene *scene, int width, int height);

/// The same for a panel, which keeps nothing free but a narrow border.
pm_viewpoint pm_viewpoint_fill(const pm_scene *scene, int width, int height);

/// A view of the box `low` to `high` [m, centred] along `forward`, for a panel.
/// @param forward  unit, not along `up`
pm_viewpoint pm_viewpoint_box(pm_vec3 low, pm_vec3 high, pm_vec3 forward, pm_vec3 up, int width,
                              int height);

/// Where `point` lands, in pixels from the top left corner of the picture; false behind the
/// camera.
bool pm_viewpoint_project(const pm_viewpoint *viewpoint, pm_vec3 point, double *x, double *y);

#ifdef __cplusplus
}
#endif
#endif

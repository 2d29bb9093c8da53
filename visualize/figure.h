// A picture in the making: one offscreen window with a camera, on which draw.h puts things;
// then title, legend and scale; then it becomes a PNG. C on this side, VTK behind it.
//
// Order: open, draw and label in any order, write, close. One figure at a time, in one thread.
// No display is needed, and none is opened where the system can draw without.
#ifndef PM_FIGURE_H
#define PM_FIGURE_H

#include "colours.h"
#include "status.h"
#include "viewpoint.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PM_FIGURE_SIZE_MIN 160
#define PM_FIGURE_SIZE_MAX 8192

typedef struct pm_figure pm_figure;

/// How a legend entry's swatch looks.
typedef enum {
    PM_SWATCH_FILL,
    PM_SWATCH_LINE,
    PM_SWATCH_DOT,
    PM_SWATCH_NONE, // text alone
} pm_swatch;

typedef struct {
    pm_swatch swatch;
    pm_colour colour;
    const char *text;
} pm_legend_entry;

/// An amount as colour: the colour at `position` in [0, 1] of the scale stands for a value.
typedef struct {
    const char *heading; // with the unit
    double low, high;    // values at the ends, low < high
    bool logarithmic;    // then low > 0
    pm_colour (*colour)(double position);
} pm_scale;

/// Opens an empty figure.
/// @param viewpoint  size and camera; each side within PM_FIGURE_SIZE_MIN and _MAX
/// @param figure     [out] close with pm_figure_close()
/// @return PM_EINPUT for a size out of range; PM_ELIMIT when neither EGL nor an X display can
/// draw;
///         PM_ENOMEM
pm_status pm_figure_open(const pm_viewpoint *viewpoint, pm_figure **figure);

/// Opens an empty figure that has no scene, and no margins kept free of one: for
/// pm_figure_text() and pm_figure_picture(). Otherwise as pm_figure_open().
pm_status pm_figure_open_flat(int width, int height, pm_figure **figure);

/// A bold title and a smaller note under it, at the top left. '\n' starts a new line.
pm_status pm_figure_title(pm_figure *figure, const char *title, const char *note);

/// A block in the right column, under those there are.
pm_status pm_figure_legend(pm_figure *figure, const char *heading,
                           const pm_legend_entry *entries, int count);

/// A scalar bar in the right column, under what there is, with its ends' values.
pm_status pm_figure_scale(pm_figure *figure, const pm_scale *scale);

/// A small word at a point of the scene.
pm_status pm_figure_mark(pm_figure *figure, pm_vec3 at, const char *text);

/// How a line of text looks.
typedef enum {
    PM_TEXT_PLAIN,
    PM_TEXT_STRONG,
    PM_TEXT_DIM,
    PM_TEXT_DIM_RIGHT, // and ends at x, where the others start
} pm_text_look;

/// A line of text whose top left corner is at (x, y), pixels from the figure's top left. Its
/// letters have `size` pixels in a figure of any size.
pm_status pm_figure_text(pm_figure *figure, const char *text, double x, double y, double size,
                         pm_text_look look);

/// An 8-bit picture, rows from the top, whose top left corner is at pixel (x, y) from the
/// figure's top left: not a value is changed.
pm_status pm_figure_picture(pm_figure *figure, const uint8_t *pixels, int width, int height,
                            int x, int y);

/// Draws everything and writes a PNG beside `path`, then renames it.
pm_status pm_figure_write(pm_figure *figure, const char *path);

/// Frees; NULL is fine.
void pm_figure_close(pm_figure *figure);

#ifdef __cplusplus
}
#endif
#endif

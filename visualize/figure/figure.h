// A picture in the making: one offscreen window with a page for words and one or several panels
// that show a scene, on which the views put things. Then it becomes a PNG, a file for ParaView
// or a window to look around in. C on this side, VTK behind it.
//
// Order: open, draw and label in any order, take pixels or write, close. One figure at a time,
// in one thread. No display is needed, and none is opened where the system can draw without.
#ifndef PM_FIGURE_H
#define PM_FIGURE_H

#ifdef __cplusplus
#include "core.hh" // before any header of core
#endif

#include "colours.h"
#include "status.h"
#include "viewpoint.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PM_FIGURE_SIZE_MIN 160
#define PM_FIGURE_SIZE_MAX 8192

typedef struct pm_figure pm_figure;

/// A part of a figure: pixels from its top left corner.
typedef struct {
    int x, y, width, height;
} pm_rect;

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

/// Opens a figure of one panel: the scene, seen as `viewpoint` says, beside the margins that it
/// keeps free for words.
/// @param viewpoint  size and camera; each side within PM_FIGURE_SIZE_MIN and _MAX
/// @param figure     [out] close with pm_figure_close()
/// @return PM_EINPUT for a size out of range; PM_ELIMIT when neither EGL nor an X display can
///         draw; PM_ENOMEM
pm_status pm_figure_open(const pm_viewpoint *viewpoint, pm_figure **figure);

/// Opens an empty page: for panels, charts, pictures and words. Otherwise as pm_figure_open().
pm_status pm_figure_open_flat(int width, int height, pm_figure **figure);

/// Adds a panel; what is drawn from now on is drawn in it, and marks are found by its camera.
/// Its frame cuts off what sticks out.
/// @param where      within the figure
/// @param viewpoint  of the rectangle's size (pm_viewpoint_fill())
pm_status pm_figure_panel(pm_figure *figure, const pm_rect *where,
                          const pm_viewpoint *viewpoint);

/// Its size in pixels.
/// @param width, height  [out]
void pm_figure_size(const pm_figure *figure, int *width, int *height);

/// What of the figure title and right column leave free, less a small margin.
pm_rect pm_figure_room(const pm_figure *figure);

/// The same for a page without a right column.
pm_rect pm_figure_wide_room(const pm_figure *figure);

/// `count` equal rectangles side by side in `room`, with a gap for a line of text over each.
/// @param cells  [out] room for `count`
void pm_figure_columns(const pm_figure *figure, const pm_rect *room, int count, pm_rect *cells);

/// A length in pixels that is `at900` in a figure 900 pixels high.
double pm_figure_pixels_of(const pm_figure *figure, double at900);

/// A bold title and a smaller note under it, at the top left. '\n' starts a new line.
pm_status pm_figure_title(pm_figure *figure, const char *title, const char *note);

/// A block in the right column, under those there are.
pm_status pm_figure_legend(pm_figure *figure, const char *heading,
                           const pm_legend_entry *entries, int count);

/// A scalar bar in the right column, under what there is, with its ends' values.
pm_status pm_figure_scale(pm_figure *figure, const pm_scale *scale);

/// A small word at a point of the current panel's scene; none where the panel does not reach.
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

/// A heading over a rectangle: strong, in the line that pm_figure_columns() leaves over it.
pm_status pm_figure_caption(pm_figure *figure, const pm_rect *under, const char *text);

/// An 8-bit picture, rows from the top, whose top left corner is at pixel (x, y) from the
/// figure's top left: not a value is changed.
pm_status pm_figure_picture(pm_figure *figure, const uint8_t *pixels, int width, int height,
                            int x, int y);

/// Draws everything.
/// @param pixels  [out] width * height * 3 bytes, rows from the top; free()
pm_status pm_figure_pixels(pm_figure *figure, uint8_t **pixels);

/// Draws everything and writes a PNG beside `path`, then renames it.
pm_status pm_figure_write(pm_figure *figure, const char *path);

/// Writes the data behind the picture, not the picture: polygons, lines and dots with the
/// numbers that belong to them as named arrays, in the scene file's coordinates, as VTK's XML
/// PolyData for ParaView. Writes beside `path`, then renames.
/// @param center  that scene coordinates are counted from (pm_scene.center)
/// @return PM_EINPUT when this figure has no such data (charts, pictures); PM_EIO
pm_status pm_figure_export(pm_figure *figure, const char *path, pm_vec3 center);

/// A window on the X display to look around in: orbit, pick, keys. Returns when it is closed.
/// @param center  as above; picks are told in the scene file's coordinates
/// @return PM_EINPUT with a line when there is no display that answers
pm_status pm_figure_show(pm_figure *figure, const char *title, pm_vec3 center);

/// Where everything is, for programs that look up pixels: {"panels": [{x y width height
/// camera}], "scales": [{heading low high logarithmic x y width height}], "charts": [...]}, in
/// pixels from the top left; cameras in the scene file's coordinates. The caller's reference;
/// NULL without memory.
json_t *pm_figure_json(const pm_figure *figure, pm_vec3 center);

/// Frees; NULL is fine.
void pm_figure_close(pm_figure *figure);

#ifdef __cplusplus
}
#endif
#endif

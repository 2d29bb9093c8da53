// Pictures by `view`, looked at: the program runs without a display, and the pixels where
// something must be seen are found by what its --json says of cameras, scales and charts, by
// the pinhole formula and not by VTK. Calls that fail end the running test.
#ifndef PM_SEEN_H
#define PM_SEEN_H

#include "test.h"
#include "vec.h"

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

/// A picture, read back. Free with pm_seen_free().
typedef struct {
    int width, height;
    uint8_t *pixels; // RGB, rows from the top
    json_t *answer;  // of --json
} pm_seen;

/// Runs `line` ("view paths {S} --scene {O}", words as in pm_command_run()) with -o and --json,
/// and no DISPLAY. Nothing may be said on standard error.
pm_seen pm_seen_look(const char *line, const char *s, const char *o);

/// A PNG as it is, without an answer.
pm_seen pm_seen_read(const char *path);
void pm_seen_free(pm_seen *seen);

/// A member of the answer, which must be there; `key` may be a path: "panels.0.camera".
json_t *pm_seen_member(const pm_seen *seen, const char *key);
double pm_seen_number(const pm_seen *seen, const char *key);
const char *pm_seen_text(const pm_seen *seen, const char *key);

/// A pixel counted from the top left.
const uint8_t *pm_seen_at(const pm_seen *seen, int x, int y);

/// Where a point in the scene file's coordinates lands, by the camera of a panel; and that
/// pixel.
void pm_seen_place(const pm_seen *seen, int panel, pm_vec3 point, int *x, int *y);
const uint8_t *pm_seen_pixel(const pm_seen *seen, int panel, pm_vec3 point);

/// Where a pair of values lands on a chart.
void pm_seen_chart(const pm_seen *seen, int chart, double x, double y, int *px, int *py);

/// The colour of a scale at `position` in [0, 1] from its low to its high end.
const uint8_t *pm_seen_scale(const pm_seen *seen, int scale, double position);

/// Whether a pixel of about this colour lies within `reach` pixels of (x, y).
bool pm_seen_near(const pm_seen *seen, int x, int y, int reach, const uint8_t colour[3],
                  int tolerance);

/// Ends the test unless each channel of `got` is within the tolerance.
#define CHECK_COLOUR(got, red, green, blue, tolerance)                                         \
    do {                                                                                       \
        const uint8_t *rgb_seen = (got);                                                       \
        CHECK_NEAR((double)rgb_seen[0], red, tolerance);                                       \
        CHECK_NEAR((double)rgb_seen[1], green, tolerance);                                     \
        CHECK_NEAR((double)rgb_seen[2], blue, tolerance);                                      \
    } while (0)

#endif

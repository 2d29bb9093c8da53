// The JSON object of a finished picture.
#ifndef PM_RENDER_JSON_H
#define PM_RENDER_JSON_H

#include "progressive.h"

#include <jansson.h>

/// A finished picture, to be reported.
typedef struct {
    const pm_scene *scene;
    const pm_render_settings *settings;
    const pm_render_maps *maps; // of a progressive picture: pm_progressive_books()
    const pm_eye_report *eye;
    const pm_progressive *progressive; // NULL: one pass made it
    uint32_t passes;                   // asked for
} pm_render_done;

/// The sums of one map: photons over all passes, power [W] as each pass has it.
pm_map_sum pm_render_sum(const pm_render_done *done, pm_map_kind kind);

/// Radius [m] of a map in the first pass of a progressive picture and the last one; 0: none.
void pm_render_radii(const pm_render_done *done, pm_map_kind kind, double radius[2]);

/// {scene, plan, settings, maps, flux, direct, gather, precompute, choices, .., seconds,
/// peak_bytes}, and of a progressive picture progressive{passes, alpha, radius{MAP[first,
/// last]}}. There photons, lookups and seconds are those of all passes together, powers are
/// means over the passes [W], and bytes are the most that a pass held. The caller's reference;
/// NULL without memory.
json_t *pm_render_json(const pm_render_done *done);

#endif

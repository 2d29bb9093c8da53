// Photon paths as lines from event to event.
#ifndef PM_DRAW_PATHS_H
#define PM_DRAW_PATHS_H

#include "figure.h"
#include "figure_data.h"

#ifdef __cplusplus
extern "C" {
#endif

/// `most` of the paths, picked fairly: each stretch in the colour of the event that it starts
/// from, or of the bounces so far; each event a dot. With a legend, and the numbers behind it.
/// @param drawn  [out] paths drawn
pm_status pm_draw_paths(pm_figure *figure, const pm_path_set *paths, uint64_t most,
                        bool by_bounce, uint64_t *drawn);

#ifdef __cplusplus
}
#endif
#endif

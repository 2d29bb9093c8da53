// Photon paths that grow: the same picture again and again, each time a bit later.
#ifndef PM_DRAW_GROWTH_H
#define PM_DRAW_GROWTH_H

#include "figure.h"
#include "figure_data.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct pm_growth pm_growth;

/// Begins with `most` of the paths, picked as pm_draw_paths() does. What stands on the figure
/// by then stays on every frame.
/// @param paths   must outlive the growth, as the figure must
/// @param growth  [out] free with pm_growth_close()
pm_status pm_growth_open(pm_figure *figure, const pm_path_set *paths, uint64_t most,
                         bool by_bounce, pm_growth **growth);

/// Length [m] of the longest of them.
double pm_growth_length(const pm_growth *growth);

/// Draws every path up to `reach` [m] from its light, instead of what was drawn before, with
/// the counts up to there.
pm_status pm_growth_show(pm_growth *growth, double reach);

/// Frees; NULL is fine.
void pm_growth_close(pm_growth *growth);

#ifdef __cplusplus
}
#endif
#endif

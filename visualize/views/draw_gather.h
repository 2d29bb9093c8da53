// The ball or disc of one estimate with its photons.
#ifndef PM_DRAW_GATHER_H
#define PM_DRAW_GATHER_H

#include "figure.h"
#include "figure_data.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Surfaces whose normals are closer than this (a cosine) are taken for the same one.
#define PM_GATHER_SAME 0.7

/// Draws the region, its photons and its normal into the current panel: bright what counts, dim
/// what does not. Keeps the photons' numbers.
pm_status pm_draw_gather(pm_figure *figure, const pm_gathered *gathered);

/// Says what the colours mean. `behind`: there are photons that face away.
pm_status pm_draw_gather_legend(pm_figure *figure, bool behind);

#ifdef __cplusplus
}
#endif
#endif

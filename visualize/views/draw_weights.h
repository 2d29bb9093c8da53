// The photons of an estimate seen from straight above, each as large and as bright as a kernel
// makes it count.
#ifndef PM_DRAW_WEIGHTS_H
#define PM_DRAW_WEIGHTS_H

#include "figure.h"
#include "kernel_data.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The estimate's disc and its photons under one kernel, in the current panel. A photon that
/// counts for nothing is a ring.
pm_status pm_draw_weights(pm_figure *figure, const pm_weighed_set *set, int kernel);

/// The scale, and what rims and rings are, in the right column.
pm_status pm_draw_weights_legend(pm_figure *figure, const pm_weighed_set *set);

/// A pin in the current panel's scene, `length` [m] along the normal, for where the disc lies
/// that is too small to be seen.
pm_status pm_draw_weights_place(pm_figure *figure, const pm_weighed_set *set, double length);

/// Keeps the photons with their numbers for .vtp files and picks in the current panel.
pm_status pm_draw_weights_keep(pm_figure *figure, const pm_weighed_set *set);

#ifdef __cplusplus
}
#endif
#endif

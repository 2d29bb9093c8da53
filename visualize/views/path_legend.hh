// The legend of paths, with counts.
#ifndef PM_PATH_LEGEND_HH
#define PM_PATH_LEGEND_HH

#include "figure.hh"
#include "path_strokes.hh"

/// What colours stand for: kinds of events with their counts in `so_far`, or numbers of bounces
/// with the stretches begun. What never occurs in `whole` is left out, so that the legends of a
/// film's frames have the same lines.
pm_status pm_path_legend_by_event(pm_figure *figure, const pm_path_strokes &so_far,
                                  const pm_path_strokes &whole);
pm_status pm_path_legend_by_bounce(pm_figure *figure, const pm_path_strokes &so_far,
                                   const pm_path_strokes &whole);

#endif

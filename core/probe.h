// Where a program's estimates are asked for: one point (--at --normal), a file of them
// (--points), or a grid on a rectangle (--on --grid).
#ifndef PM_PROBE_H
#define PM_PROBE_H

#include "estimate.h"
#include "options.h"

/// Points in order; those of a grid row by row, `columns` in each.
typedef struct {
    pm_estimate_point *points; // centred coordinates
    uint32_t count;
    uint32_t columns; // count when there is no grid
    bool free;        // one point without a normal, as it may lie in a medium
} pm_probes;

/// What `options` ask for.
///
/// A grid has its points in the middles of equal cells; the first of its two numbers counts
/// along the rectangle's first edge; with --part it covers that part alone. Its normals are the
/// rectangle's. In a scene that has media
/// --at may stand without --normal; whether the point lies in one is not looked at.
///
/// @param program  its name, for messages
/// @param probes   [out] untouched unless PM_OK; free with pm_probes_free()
/// @return PM_EINPUT when not exactly one way is used, or a line of the file is wrong (one line
///         per fault, as far as 20); PM_EIO; PM_ENOMEM
pm_status pm_probes_make(const char *program, const pm_options *options, const pm_scene *scene,
                         pm_probes *probes);
void pm_probes_free(pm_probes *probes);

#endif

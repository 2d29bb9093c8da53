// The median without sorting, the one costly step in building a kd-tree.
#ifndef PM_SELECT_H
#define PM_SELECT_H

#include "photon.h"

/// Photons, in lockstep with what packing rounded away.
typedef struct {
    pm_photon *photons;
    pm_photon_exact *exact; // NULL when packing is on
} pm_photon_run;

/// Reorders photons low .. high (both included, low <= place <= high) so that the one at
/// `place` is where sorting by `axis` would put one of its coordinate: none before it is beyond
/// it, none after it before it.
///
/// Takes O(n) for any input - sorted, equal, organ pipe - and no memory but a stack of
/// O(log n). The same run gives the same order. Coordinates must be finite.
/// @source Floyd and Rivest, "Expected time bounds for selection", CACM 18(3), 1975
void pm_select_place(const pm_photon_run *run, uint32_t low, uint32_t high, uint32_t place,
                     int axis);

#endif

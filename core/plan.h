// Model only what the scene requires: which parts of light transport exist in a scene, and why.
#ifndef PM_PLAN_H
#define PM_PLAN_H

#include "photon.h"
#include "scene.h"

typedef enum {
    PM_PLAN_DIRECT,
    PM_PLAN_SPECULAR,
    PM_PLAN_CAUSTIC,
    PM_PLAN_INDIRECT,
    PM_PLAN_VOLUME,
    PM_PLAN_DISPERSION,
    PM_PLAN_PROJECTION,
    PM_PLAN_COUNT,
} pm_plan_part;

typedef struct {
    bool needed;
    bool missing;  // needed, but switched off: `why` names the paths that are left out
    char why[160]; // one sentence without a full stop
} pm_plan_item;

typedef struct {
    pm_plan_item item[PM_PLAN_COUNT];
} pm_plan;

/// Reads the plan off materials and lights. Takes no other argument, so it says what the scene
/// needs, not what a user switched off.
pm_plan pm_plan_scene(const pm_scene *scene);

/// Whether the plan asks for the map of `kind`.
bool pm_plan_needs_map(const pm_plan *plan, pm_map_kind kind);

/// Notes that a part which the scene needs was switched off, and what that leaves out.
void pm_plan_miss(pm_plan *plan, pm_plan_part part, const char *what);

/// The part's name as reports spell it.
const char *pm_plan_name(pm_plan_part part);

#endif

// Model only what the scene requires: which parts of light transport exist in a scene, and why.
#ifndef PM_PLAN_H
#define PM_PLAN_H

#include "photon.h"
#include "projection.h"
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
    bool missing;       // needed, but its map is off by choice: `left_out` names the paths
    char why[400];      // one sentence without a full stop
    char left_out[160]; // the same; "" unless missing
} pm_plan_item;

typedef struct {
    pm_plan_item item[PM_PLAN_COUNT];
} pm_plan;

/// Reads the plan off materials, media and lights. Takes no other argument, so it says what the
/// scene needs, not what a user switched off. What projection maps are worth is not known yet.
pm_plan pm_plan_scene(const pm_scene *scene);

/// Whether the plan asks for the map of `kind`.
bool pm_plan_needs_map(const pm_plan *plan, pm_map_kind kind);

/// Plans the projection maps.
///
/// @param aim  one a map; NULL for a map that is not traced
void pm_plan_aim(pm_plan *plan, const pm_projections *const aim[PM_MAP_COUNT]);

/// Notes that a part which the scene needs was switched off, and what that leaves out.
void pm_plan_miss(pm_plan *plan, pm_plan_part part, const char *what);

/// Shares `total` photons out to the maps of a picture in the proportion of their defaults,
/// 2 : 2 : 1 for global, caustic and volume map. An aimed map gets no fewer: aiming is to make
/// it better.
///
/// @param traced   maps that are to be traced; the others get 0
/// @param photons  [out] untouched unless PM_OK; they add up to `total` where a map is traced
/// @return PM_EINPUT when `total` is so small that a traced map would get none
pm_status pm_plan_split(uint64_t total, const bool traced[PM_MAP_COUNT],
                        uint64_t photons[PM_MAP_COUNT]);

/// The part's name as reports spell it.
const char *pm_plan_name(pm_plan_part part);

/// The path classes that a part carries in this scene, from the light on ("LS+D"); V is in them
/// where a medium scatters. "" for a part that only helps others.
const char *pm_plan_paths(const pm_plan *plan, pm_plan_part part);

#endif

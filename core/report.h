// What programs say as JSON, by jansson: the parts that several of them share. Every function
// that makes a value gives the caller a reference; it is NULL without memory, or when a number
// is not finite, which JSON cannot say. jansson's packing passes NULL on, so only
// pm_report_end() has to look.
#ifndef PM_REPORT_H
#define PM_REPORT_H

#include "audit.h"
#include "map_power.h"
#include "options.h"
#include "photon_pass.h"
#include "plan.h"
#include "projection.h"

#include <jansson.h>

/// [r, g, b] and [x, y, z].
json_t *pm_report_spectrum(pm_spectrum spectrum);
json_t *pm_report_vector(pm_vec3 vector);

/// flux{emitted, absorbed, escaped, lost, roulette, roulette_sd, dispersion, dispersion_sd} in
/// W.
json_t *pm_report_flux(const pm_audit *audit);

/// {"direct": {"needed": .., "why": .., "paths": .., "missing": ..}, ..}; `missing` is null, or
/// says what is left out by choice.
json_t *pm_report_plan(const pm_plan *plan);

/// {cells, active, dark[3] in W, saved, why} of a pass that emits `emitted` photons: how many
/// more it would take without.
json_t *pm_report_projection(const pm_projections *projections, uint64_t emitted);

/// [{id, type, flux[3], photons}, ..]; `share` may be NULL.
json_t *pm_report_lights(const pm_scene *scene, const uint64_t *share);

/// {global: N, ..}: photons that each map is to be made of.
json_t *pm_report_photons(const uint64_t photons[PM_MAP_COUNT]);

/// {id: {incident[3], absorbed[3]}, ..} in W.
json_t *pm_report_by_shape(const pm_scene *scene, const pm_audit *audit);

/// {id: {collisions, incident[3], absorbed[3]}, ..}, powers in W.
json_t *pm_report_by_medium(const pm_scene *scene, const pm_audit *audit);

/// {emitted, stored, power[3], refused, clamped, vanished, bytes} of one map, or of many.
json_t *pm_report_map(const pm_photon_map *map);
json_t *pm_report_map_sum(const pm_map_sum *sum);

/// Lines about what the scene file says that is not used.
json_t *pm_report_notes(const pm_scene *scene);

/// Adds `value` under `key` and gives `object` back; NULL when either is or memory ran out.
/// Both references are taken.
json_t *pm_report_add(json_t *object, const char *key, json_t *value);

/// Appends `value` and gives `array` back; as pm_report_add().
json_t *pm_report_append(json_t *array, json_t *value);

/// Writes the object where the options want it: --json to standard output, --report to a file.
/// Takes the reference. Doubles have 17 digits, keys the order in which they were added.
/// @return PM_ENOMEM when `object` is NULL; PM_EIO
pm_status pm_report_end(const pm_options *options, json_t *object);

#endif

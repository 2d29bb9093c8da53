// Fills one photon map: emits, traces and stores in fixed chunks on all threads, in an order
// that does not depend on their number, and keeps the books (audit.h).
#ifndef PM_PHOTON_PASS_H
#define PM_PHOTON_PASS_H

#include "audit.h"
#include "trace.h"

/// How a pass is run. Zero-initialise, then set.
typedef struct {
    uint32_t seed;
    uint32_t pass;
    uint64_t count;  // photons to emit; with `stored` the most to emit
    uint64_t stored; // stop with the photon that fills this number; 0: emit all
    pm_roulette_rule rule;
    uint32_t max_bounces;             // 0: the rule of the design (caps.h)
    bool unpacked;                    // keep exact powers and directions
    const pm_projection *projections; // one a light, or NULL
    pm_trace_sink tap; // sees every deposit that is stored, and every event, in photon order;
                       // both may be NULL. Runs on one thread when given
} pm_pass_settings;

typedef struct {
    uint64_t emitted;
    uint64_t deposits;
    uint64_t *share;       // photons per light of a full pass; freed by pm_pass_report_free()
    pm_audit audit;        // unscaled powers divided by `emitted`: [W]
    pm_spectrum deposited; // [W] handed over, before packing
    double seconds;        // on the wall
    double emit_cpu, trace_cpu, store_cpu; // [s] summed over the threads
} pm_pass_report;

/// Emits, traces, stores and scales the map of `kind`. Where no light sends
/// any power nothing is emitted, and the map is empty.
///
/// @param map     [out] trimmed and scaled; untouched unless PM_OK
/// @param report  [out] may be NULL
/// @return what a stage returned; PM_ELIMIT with a line when `stored` is not reached after
/// `count`;
///         PM_ESTOPPED on SIGINT
pm_status pm_photon_pass(const pm_intersector *world, pm_map_kind kind,
                         const pm_pass_settings *settings, pm_photon_map *map,
                         pm_pass_report *report);

/// Follows photon number `photon` of a pass again, alone: what it did in the pass, it does
/// here.
///
/// @param sink   sees its events and, where `deposit` is not NULL, its deposits
/// @param light  [out] that sent it
/// @return PM_EINPUT when the pass has no such photon
pm_status pm_photon_replay(const pm_intersector *world, pm_map_kind kind,
                           const pm_pass_settings *settings, uint64_t photon,
                           const pm_trace_sink *sink, uint32_t *light);

void pm_pass_report_free(pm_pass_report *report);

#endif

// What happened to the photons of a test, written down while they are traced: a sink for
// trace.h that counts deposits and ends, and checks each deposit against the path before it.
#ifndef PM_LEDGER_H
#define PM_LEDGER_H

#include "scenes.h"
#include "trace.h"

enum { PM_LEDGER_PATH = 64 };

typedef struct {
    uint64_t deposits, first, caustic, in_medium;
    uint64_t specular_late;                // deposits after an S event that are no caustics
    uint64_t lengths[PM_LEDGER_PATH];      // photons by events that carried them on
    uint64_t absorbed, escaped, cut, done; // photons by how they ended
    uint64_t events;
    pm_spectrum direct, indirect, lost; // power of first and later deposits, and cut
    bool check_path;                    // hold each deposit's marks against its path
    uint64_t current;                   // photon whose path is spelled
    char path[PM_LEDGER_PATH];
    pm_spectrum carried; // by that photon from its last event
} pm_ledger;

/// An empty ledger, and a tracing that writes into it: seed 5, uncapped but for 1000 specular
/// events in a row.
pm_tracing pm_ledger_open(const pm_scenes *s, pm_ledger *ledger);

/// Emits `count` photons from the scene's lights and traces them.
void pm_ledger_trace(const pm_scenes *s, const pm_tracing *tracing, uint32_t count);

#endif

// The books of a pass: where the emitted power went, channel by channel, kept outside the
// stages that move it. emitted = absorbed + escaped + lost holds by construction, so the
// roulette is judged apart: what it carried on against what the albedos it was given promise,
// with its own deviation.
#ifndef PM_AUDIT_H
#define PM_AUDIT_H

#include "trace.h"

#define PM_AUDIT_BOUNCES 32 // the last bin holds all further ones

typedef struct {
    pm_spectrum incident; // [W] arriving at the shape
    pm_spectrum absorbed; // [W] signed: arriving minus carried on
} pm_audit_shape;

typedef struct {
    uint64_t photons;                                   // emitted
    uint64_t ended_absorbed, ended_escaped, ended_lost; // they add up to `photons`
    uint64_t events;                                    // meetings with surfaces and media
    uint64_t bounces[PM_AUDIT_BOUNCES]; // photons by number of events that carried them on
    pm_spectrum emitted, absorbed, escaped, lost; // [W]
    pm_spectrum roulette, roulette_variance;      // sum and the variance of that sum
    double largest;         // [W] power in one channel that met a roulette
    pm_audit_shape *shapes; // one per scene shape
    int shape_count;
} pm_audit;

pm_status pm_audit_make(int shape_count, pm_audit *audit);
void pm_audit_free(pm_audit *audit);
void pm_audit_clear(pm_audit *audit);

/// Books one event (the form of pm_trace_sink.event with the audit as context).
void pm_audit_event(void *audit, const pm_start *start, const pm_event *event);

/// Books `count` photons as emitted.
void pm_audit_emit(pm_audit *audit, const pm_start *starts, uint32_t count);

/// Adds `part` to `audit`.
void pm_audit_add(pm_audit *audit, const pm_audit *part);

/// Multiplies all powers by `factor` (1 / emitted).
void pm_audit_scale(pm_audit *audit, double factor);

/// Whether the books close: powers to 1e-12 of what was emitted, counts exactly, roulette
/// within 5 standard deviations and, for surfaces so dark that hardly a photon survives and the
/// deviation seen says little, 15 survivors more. PM_ELIMIT with a line that says which does
/// not.
pm_status pm_audit_check(const pm_audit *audit);

#endif

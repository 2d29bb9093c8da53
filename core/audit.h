// The books of a pass: where the emitted power went, channel by channel, kept outside the
// stages that move it. emitted = absorbed + escaped + lost holds by construction, so two parts
// of it are judged apart, each with its own deviation: the roulette, by what it carried on
// against what the albedos it was given promise; and dispersion, which changes a photon's power
// at every wavelength, but not on average.
#ifndef PM_AUDIT_H
#define PM_AUDIT_H

#include "trace.h"

#define PM_AUDIT_BOUNCES 32 // the last bin holds all further ones

typedef struct {
    pm_spectrum incident; // [W] arriving at the shape
    pm_spectrum absorbed; // [W] signed: arriving minus carried on
} pm_audit_shape;

typedef struct {
    uint64_t collisions;
    pm_spectrum incident; // [W] of the photons that collided, over all collisions
    pm_spectrum absorbed; // [W] signed, as a shape's
} pm_audit_medium;

typedef struct {
    uint64_t photons;                                   // emitted
    uint64_t ended_absorbed, ended_escaped, ended_lost; // they add up to `photons`
    uint64_t events;                                    // meetings with surfaces and media
    uint64_t bounces[PM_AUDIT_BOUNCES]; // photons by number of events that carried them on
    pm_spectrum emitted, absorbed, escaped, lost; // [W]
    pm_spectrum roulette, roulette_variance;      // sum and the variance of that sum
    pm_spectrum dispersion, dispersion_variance;  // the same of what wavelengths add
    double largest;         // [W] power in one channel that met a roulette
    const pm_scene *scene;  // whose media promise their albedos; borrowed
    pm_audit_shape *shapes; // one per scene shape
    pm_audit_medium *media; // one per medium
} pm_audit;

/// Empty books for `scene`, which must outlive them.
/// @param audit  [out] free with pm_audit_free() when PM_OK
pm_status pm_audit_make(const pm_scene *scene, pm_audit *audit);
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
/// deviation seen says little, 15 survivors more; dispersion within 5. It needs no more: a
/// channel's weights are rarely far above 1, and n changes never add up to more than sqrt(n)
/// of the deviations that are taken from them. PM_ELIMIT with a line that says which does not.
pm_status pm_audit_check(const pm_audit *audit);

#endif

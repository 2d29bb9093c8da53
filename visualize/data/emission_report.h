// Reading what emission --report says of the lights.
#ifndef PM_EMISSION_REPORT_H
#define PM_EMISSION_REPORT_H

#include "status.h"

#include <stdint.h>

typedef struct {
    char *id, *type;
    double power;     // [W] mean of the light's flux over red, green, blue
    uint64_t photons; // that it sent
} pm_report_light;

/// Freed by pm_emission_report_free().
typedef struct {
    pm_report_light *lights;
    int count;
    double power;           // [W] of all lights
    double sent;            // [W] that all photons carry: the mean of power_sum
    uint64_t photons;       // of all lights
    uint64_t cells, active; // of all projection maps
} pm_emission_report;

/// @param report  [out] untouched unless PM_OK
/// @return PM_EINPUT with file:line for text that is no JSON, with file and key for members
/// that
///         are missing, of another kind or below 0, and when no light has any power; PM_EIO,
///         PM_ENOMEM
pm_status pm_emission_report_read(const char *path, pm_emission_report *report);
void pm_emission_report_free(pm_emission_report *report);

#endif

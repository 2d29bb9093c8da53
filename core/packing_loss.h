// What is lost when photons are packed into 20 bytes, measured on maps that keep the exact
// values as well.
#ifndef PM_PACKING_LOSS_H
#define PM_PACKING_LOSS_H

#include "photon.h"

#include <jansson.h>

/// Sums over all photons that were added. Zero-initialised it is empty.
typedef struct {
    pm_spectrum exact, packed;   // [W]
    double error2, power2;       // squares of channel errors and of channel powers
    double angle_sum, angle_max; // [rad], between exact and packed directions
    uint64_t count;
} pm_packing_loss;

/// The same map with the exact values out of sight: it unpacks from the bytes. Shares the
/// photons; not to be freed.
pm_photon_map pm_packing_loss_bytes(const pm_photon_map *map);

/// Angle between two unit directions [rad], exact for small ones, too.
double pm_packing_loss_angle(pm_vec3 a, pm_vec3 b);

/// Adds all photons of a map that is unpacked.
void pm_packing_loss_add(pm_packing_loss *loss, const pm_photon_map *map);

/// Change of the power of all photons together, per channel, as a part of it.
pm_spectrum pm_packing_loss_bias(const pm_packing_loss *loss);

/// Root mean square of the channels' errors, as a part of that of the channels.
double pm_packing_loss_rms(const pm_packing_loss *loss);

/// Mean and largest angle in degrees.
double pm_packing_loss_mean_degrees(const pm_packing_loss *loss);
double pm_packing_loss_max_degrees(const pm_packing_loss *loss);

/// {power_bias[3], power_rms, angle_mean_deg, angle_max_deg}
json_t *pm_packing_loss_json(const pm_packing_loss *loss);

#endif

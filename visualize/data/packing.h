// Photons as they were and as their 20 bytes give them back, side by side.
#ifndef PM_PACKING_H
#define PM_PACKING_H

#include "figure_data.h"
#include "packing_loss.h"
#include "status.h"

#include <stdint.h>

#define PM_PACKING_BINS 40

/// How often each size of error occurs; bin i starts at low + i (high - low) / PM_PACKING_BINS.
typedef struct {
    double low, high;
    double share[PM_PACKING_BINS]; // of all; they add up to 1
} pm_packing_histogram;

/// Freed by pm_packing_free().
typedef struct {
    float (*exact)[3]; // directions
    float (*packed)[3];
    float *angle; // between them [degrees]
    float *power; // error of each channel, 3 a photon, as a part of the strongest one
    uint32_t count;
    pm_packing_loss loss;
} pm_packing;

/// Adds the photons of a file. Zero-initialise before the first.
/// @param packing  as it was unless PM_OK
/// @return PM_EINPUT when the file keeps no exact values, or has no photons; PM_ELIMIT
pm_status pm_packing_read(pm_packing *packing, const char *path);

/// Errors of direction from 0, or of power around 0; the ends are those that right packing
/// of full channels cannot pass, or the next full step above the largest error.
pm_packing_histogram pm_packing_angles(const pm_packing *packing);
pm_packing_histogram pm_packing_powers(const pm_packing *packing);

void pm_packing_free(pm_packing *packing);

#endif

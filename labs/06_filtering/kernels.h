// What is set side by side: every kernel with the constants that are right, every kernel as the
// lecture has it, and differential checking. A row each, in every table and file of
// `filtering`.
#ifndef PM_KERNELS_H
#define PM_KERNELS_H

#include "estimate.h"

#define PM_KERNELS_COUNT (2 * PM_FILTER_COUNT)   // the right ones, then the lecture's
#define PM_KERNELS_ROWS (PM_KERNELS_COUNT + 1)   // and differential checking, the last
#define PM_KERNELS_DIFFERENTIAL PM_KERNELS_COUNT // its row

#define PM_KERNELS_HEADER "kernel,distance,weight,inside"

/// "cone", "cone-lecture", "differential".
const char *pm_kernels_name(int row);

/// The settings of an estimate with the kernel of `row`; differential checking has a flat one.
pm_estimate_settings pm_kernels_settings(const pm_estimate_settings *base, int row);

/// How much a photon counts at `distance` (over the radius, 0 to 1) against the plain average:
/// the stage's weight over the stage's normalisation.
/// @param weight  [out]
pm_status pm_kernels_weight(int row, double distance, double *weight);

/// What the weights are divided by, and their mean over the disc before that: the two should be
/// the same.
/// @param divided_by, mean  [out]
pm_status pm_kernels_constants(int row, double *divided_by, double *mean);

/// Writes PM_KERNELS_HEADER and the curves of all kernels, 201 rows each: the weight at a
/// distance over the radius, and the part of a flat field's power that is counted nearer than
/// that. The last of these is the mean weight: 1 where light is neither lost nor made.
pm_status pm_kernels_write(const char *path);

#endif

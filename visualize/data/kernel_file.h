// Kernels by distance as `filtering --curves` writes them: the rows of a kernel together, from
// distance 0 to 1.
#ifndef PM_KERNEL_FILE_H
#define PM_KERNEL_FILE_H

#include "kernel_data.h"
#include "status.h"

#define PM_KERNEL_HEADER "kernel,distance,weight,inside"

/// Reads a dump. Refuses, with file:line, distances that do not rise from 0 to 1, a kernel that
/// comes twice, and numbers that are not finite. Weights may be negative or wrong: they are
/// what a stage gave.
/// @param set  [out] untouched unless PM_OK; free with pm_kernel_file_free()
pm_status pm_kernel_file_read(const char *path, pm_kernel_set *set);
void pm_kernel_file_free(pm_kernel_set *set);

/// The curve of this name, or NULL.
const pm_kernel_curve *pm_kernel_file_find(const pm_kernel_set *set, const char *name);

#endif

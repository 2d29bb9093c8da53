// Refractive indices by name, as Mitsuba 3 knows them.
#ifndef PM_IOR_H
#define PM_IOR_H

#include <stdbool.h>

/// The index of the material `name`, whatever its capitals.
/// @param index    [out] untouched unless found
/// @param nearest  [out] the nearest known name when it is not found; a static string
bool pm_ior_find(const char *name, double *index, const char **nearest);

#endif

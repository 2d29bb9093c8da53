// The photons of one estimate with their weights, and what each kernel made of them: two files
// of one call, `filtering --at --normal --gathered PHOTONS.csv --report REPORT.json`.
#ifndef PM_WEIGHT_FILE_H
#define PM_WEIGHT_FILE_H

#include "kernel_data.h"
#include "scene.h"
#include "status.h"

#define PM_WEIGHT_HEADER "x,y,z,r,g,b,distance,none,cone,gaussian,epanechnikov"

/// "none", "cone", "gaussian", "epanechnikov".
const char *pm_weight_file_kernel(int kernel);

/// Reads both. Refuses, with file:line, photons whose distance falls, powers below 0 and
/// numbers that are not finite; and a report without the members that are needed, or of other
/// photons than the file's.
/// @param scene  that the data came from
/// @param set    [out] untouched unless PM_OK; free with pm_weight_file_free()
pm_status pm_weight_file_read(const char *photons, const char *report, const pm_scene *scene,
                              pm_weighed_set *set);
void pm_weight_file_free(pm_weighed_set *set);

#endif

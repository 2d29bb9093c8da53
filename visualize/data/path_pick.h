// Some of many paths, so that a picture stays legible and still shows what all of them do.
#ifndef PM_PATH_PICK_H
#define PM_PATH_PICK_H

#include <stdint.h>

/// The index of number `which` of `picked` paths among `count`: each equal part of the file
/// gives one, at a place that varies from part to part. Increasing in `which`; all paths when
/// `picked` equals `count`.
/// @param picked  1 to `count`; `which` is below it
uint64_t pm_path_pick(uint64_t count, uint64_t picked, uint64_t which);

#endif

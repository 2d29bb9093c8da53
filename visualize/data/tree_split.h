// The split planes of a balanced photon map, each clipped to the cell that it halves.
#ifndef PM_TREE_SPLIT_H
#define PM_TREE_SPLIT_H

#include "figure_data.h"
#include "photon.h"
#include "status.h"

#define PM_TREE_DEPTHS_MAX 16

/// Walks the first `depths` levels of the tree. The root's cell is the photons' bounding box.
///
/// @param where   the file's name, for messages
/// @param splits  [out] untouched unless PM_OK; free with pm_tree_split_free()
/// @return PM_EINPUT when the map is not balanced, or a photon lies outside of its cell, so
///         that the flag must be wrong; PM_ENOMEM
pm_status pm_tree_split_make(const pm_photon_map *map, const char *where, int depths,
                             pm_tree_split_set *splits);

/// The rectangle where the plane across `axis` at `at` cuts the cell `low` to `high`.
/// @param corner  [out] in order around it
void pm_tree_split_cut(const float low[3], const float high[3], int axis, float at,
                       pm_vec3 corner[4]);

void pm_tree_split_free(pm_tree_split_set *splits);

#endif

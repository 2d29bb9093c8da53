// What pictures are made of: data that programs wrote, already read and checked, in centred
// world space. No functions here; readers fill it (path_file, grid_file, photon_cloud,
// tree_split), and draw.h puts it on a figure.
#ifndef PM_FIGURE_DATA_H
#define PM_FIGURE_DATA_H

#include "spectrum.h"
#include "vec.h"

#include <stdint.h>

/// Photons of one map. Freed by pm_photon_cloud_free().
typedef struct {
    float (*position)[3];
    float (*power)[3]; // [W]
    uint32_t count;    // that are here
    uint32_t stored;   // that the map has
    uint64_t emitted;  // photons sent to fill the map
    double full_power; // [W] in one channel; only one photon in a hundred has more
    const char *name;  // "global", "caustic" or "volume"
} pm_photon_cloud;

/// One split plane of a kd-tree, clipped to its cell.
typedef struct {
    pm_vec3 corner[4]; // in order around the rectangle
    int axis;          // 0 x, 1 y, 2 z
    int depth;         // 0 the root
} pm_tree_split;

/// The splits of depths 0 to `depths` - 1. Freed by pm_tree_split_free().
typedef struct {
    pm_tree_split *splits;
    uint32_t count;
    int depths; // that are shown
    int height; // depths that the whole tree has
} pm_tree_split_set;

/// One vertex of a path. `event` is L (leaves the light), S (mirror or glass), D (diffuse),
/// V (medium), A (absorbed), E (escaped: a point on its way out), C (cut by a cap on bounces).
typedef struct {
    pm_vec3 position;
    char event;
} pm_path_vertex;

/// Path i is vertices[first[i]] to vertices[first[i + 1] - 1]. Freed by pm_path_file_free().
typedef struct {
    pm_path_vertex *vertices;
    uint64_t *first; // path_count + 1 entries
    uint64_t path_count;
} pm_path_set;

typedef struct {
    pm_vec3 position;
    pm_spectrum irradiance; // [W/m^2]
    uint64_t found;         // photons that the estimate is made of
} pm_grid_point;

/// Irradiance on a rectangle; point (i, j) is points[j * columns + i]. Freed by
/// pm_grid_file_free().
typedef struct {
    pm_grid_point *points;
    uint64_t columns, rows; // at least 2
} pm_grid;

#endif

// What pictures are made of: data that programs wrote, already read and checked, in centred
// world space. No functions here; readers fill it (path_file, grid_file, photon_cloud,
// tree_split), and draw.h puts it on a figure.
#ifndef PM_FIGURE_DATA_H
#define PM_FIGURE_DATA_H

#include "spectrum.h"
#include "vec.h"

#include <stdbool.h>
#include <stdint.h>

/// Photons of one map. Freed by pm_photon_cloud_free().
typedef struct {
    float (*position)[3];
    float (*power)[3];     // [W]
    float (*direction)[3]; // the way each travelled
    uint32_t *bounce;      // events before it landed; NULL where the file does not say
    uint32_t *light;       // index in the scene; NULL where the file does not say
    uint32_t count;        // that are here
    uint32_t stored;       // that the map has
    uint64_t emitted;      // photons sent to fill the map; 0 where the file does not say
    double full_power;     // [W] in one channel; only one photon in a hundred has more
    int map;               // a pm_map_kind
    const char *name;      // "global", "caustic" or "volume"
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

/// One vertex of a path. `event` is L (leaves the light), D (diffuse), S (mirrored), T (through
/// the surface), V (medium), A (absorbed), E (escaped: a point on its way out), C (cut by a cap
/// on bounces).
typedef struct {
    pm_vec3 position;
    pm_spectrum power; // [W] that goes on from here
    char event;
} pm_path_vertex;

/// Path i is vertices[first[i]] to vertices[first[i + 1] - 1]. Freed by pm_path_file_free().
typedef struct {
    pm_path_vertex *vertices;
    uint64_t *first;  // path_count + 1 entries
    uint64_t *photon; // index of the photon that took path i
    uint64_t path_count;
} pm_path_set;

typedef struct {
    pm_vec3 position;
    pm_vec3 normal;         // unit, of the side looked at
    pm_spectrum irradiance; // [W/m^2]
    double radius;          // [m] that the estimate took; 0 when nothing was found
    uint64_t found;         // photons that the estimate is made of
} pm_grid_point;

/// Irradiance on a rectangle; point (i, j) is points[j * columns + i]. Freed by
/// pm_grid_file_free().
typedef struct {
    pm_grid_point *points;
    uint64_t columns, rows; // at least 2
} pm_grid;

/// What became of a photon near a gather region.
typedef enum {
    PM_GATHERED_COUNTED,
    PM_GATHERED_RIM,    // it sets the radius and is left out
    PM_GATHERED_NEAR,   // out of reach
    PM_GATHERED_BEHIND, // its surface faces away
} pm_gathered_fate;

typedef struct {
    pm_gathered_fate fate;
    pm_vec3 position;
    pm_vec3 normal;    // unit, of its surface
    pm_vec3 direction; // unit, the way it travelled
    pm_spectrum power; // [W]
    double distance;   // [m] in the measure of the search
    double weight;     // share of the power that counts
} pm_gathered_photon;

/// The ball or disc of one estimate of irradiance with the photons in and around it. Freed by
/// pm_gathered_file_free().
typedef struct {
    bool disc;
    double flatness; // height over radius; 1 of a ball
    pm_vec3 at, normal;
    double radius;          // [m]
    pm_spectrum irradiance; // [W/m^2], as the estimate told it
    uint64_t found;         // counted ones and the rim
    pm_gathered_photon *photons;
    uint64_t count;
} pm_gathered;

#endif

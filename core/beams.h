// The beam radiance estimate: one query for all photons near a ray through a medium, in place
// of many along it. Each photon is a ball; the ray sees it as a disc across.
//
// Invariant: photons count whose nearest point of the ray lies between its two ends, and whose
// distance d from it is below their radius r: with the kernel (3 / pi) (1 - d^2/r^2)^2 / r^2,
// whose integral over the disc is 1. So an even field comes out right on average for any
// radii, without a correction for k.
//
// Where a medium ends, a disc reaches over. Photons beyond the end do not count, and the others
// count the more, by the share of the disc that lies before it (rim.h): flat walls have no dark
// rim.
// @source Jarosz, Zwicker and Jensen, "The Beam Radiance Estimate for Volumetric Photon
// Mapping", CGF 27(2), 2008
#ifndef PM_BEAMS_H
#define PM_BEAMS_H

#include "estimate.h"
#include "rim.h"

enum {
    PM_BEAMS_LEAF = 8, // balls in a leaf
    PM_BEAMS_WIDE = 4, // boxes side by side in a node
    PM_BEAMS_LEVELS = 16,
};

/// How far off, in the beams' unit, a query in floats may see a ball.
#define PM_BEAMS_SLACK 0x1p-18f

/// Balls, in the beams' unit of length; radius 0: none.
typedef struct {
    float at[3][PM_BEAMS_LEAF];
    float radius[PM_BEAMS_LEAF];
} pm_beam_leaf;

/// Boxes around what is in the node's children: x y z of their low and high corners, in the
/// beams' unit. A child that is not there has an empty box.
typedef struct {
    float low[3][PM_BEAMS_WIDE];
    float high[3][PM_BEAMS_WIDE];
} pm_beam_node;

/// The photons of a volume map made ready for rays. Level 0 of the nodes holds leaves 4j .. 4j
/// + 3 in node j, level n the nodes 4j .. 4j + 3 of level n - 1; the last has one node.
/// Zero-initialised: none.
typedef struct {
    double unit;  // [m] a power of two, so that nothing is rounded; all balls lie in [-1, 1]^3
    double scale; // power of a photon = scale times that in `light`
    uint32_t count; // photons that count
    int levels;
    uint32_t first[PM_BEAMS_LEVELS + 1]; // where each level's nodes begin; then their number
    pm_beam_node *node;
    pm_beam_leaf *leaf;
    pm_photon_exact *light; // photon 8j + i of leaf j: unscaled power, direction
    pm_rim *rim;            // and where its medium ends; in the beams' unit
} pm_beams;

/// Makes beams of the photons of `map`, which may be freed then. Radii are found on all
/// threads.
///
/// @param world   in which media end; NULL: they go on for ever
/// @param radius  [m] > 0 of every photon; INFINITY: each its own, the distance of its
///                round(sqrt(k))-th neighbour. Fewer than k + 1 photons count as if k were all
///                the others; one alone has no neighbour and does not count. Never below the
///                spacing of float positions, where photons coincide
/// @param skip    photons with one of these flag bits do not count, nor as neighbours
/// @param out     [out] untouched unless PM_OK; free with pm_beams_free()
/// @return PM_EINPUT when the map is not a balanced and scaled volume map, the radius not > 0
///         as a float, or k is 0; PM_ENOMEM; PM_ESTOPPED on SIGINT
pm_status pm_beams_make(const pm_intersector *world, const pm_photon_map *map, double radius,
                        uint32_t k, uint16_t skip, pm_beams *out);
void pm_beams_free(pm_beams *beams);

/// What one query found.
typedef struct {
    pm_spectrum radiance; // [W/(m^2 sr)] arriving at the start of the ray
    uint32_t found;       // photons that counted
    double radius;        // [m] mean of theirs; 0 when there is none
} pm_beam;

/// Radiance that photons in `medium` send back along `along`, between its start and its t_max
/// (INFINITY: no end), attenuated on the way. Its direction unit. Any number of threads may ask
/// at once.
pm_beam pm_beams_query(const pm_beams *beams, const pm_medium *medium, const pm_ray *along);

#endif

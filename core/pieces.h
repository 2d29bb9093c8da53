// Shapes cut into pieces, each inside a ball: what a light's cells are held against.
//
// Invariant: every point of a shape lies in one of its balls.
#ifndef PM_PIECES_H
#define PM_PIECES_H

#include "scene.h"
#include "status.h"

#include <stddef.h>

typedef struct {
    pm_vec3 center;
    double radius; // [m], wider than the piece by the offset rule (intersect.h)
} pm_ball;

/// Zero-initialised: empty.
typedef struct {
    pm_ball *ball;
    size_t count, room;
} pm_pieces;

/// Adds the pieces of `shape`.
/// @return PM_ENOMEM
pm_status pm_pieces_add(pm_pieces *pieces, const pm_shape *shape);

/// The ball around all of `shape`.
pm_ball pm_pieces_whole(const pm_shape *shape);

void pm_pieces_free(pm_pieces *pieces);

#endif

// The pieces are as many as make balls fit thin shapes: a floor's one ball would fill the room.
// A mesh goes through a grid over its box: the triangles whose middles share a cell are a
// piece, so that 100,000 of them become some thousand balls in a few milliseconds.
#include "pieces.h"

#include "intersect.h"
#include "shape.h"

#include <stdlib.h>

#define PATCHES 8 // along each side of a rectangle, a disk's square, a cylinder's length
#define AROUND 16 // a cylinder
#define GRID 16   // cells along each side of a mesh's box

static pm_status push(pm_pieces *pieces, pm_vec3 center, double radius)
{
    if (pieces->count == pieces->room) {
        size_t room = 2 * pieces->room + 64;
        pm_ball *moved = realloc(pieces->ball, room * sizeof *moved);
        if (moved == NULL) {
            return PM_FAIL(PM_ENOMEM, "no memory for %zu pieces of shapes", room);
        }
        pieces->ball = moved;
        pieces->room = room;
    }
    double margin = PM_OFFSET * (pm_vec_reach(center) + radius);
    pieces->ball[pieces->count++] = (pm_ball){center, radius + margin};
    return PM_OK;
}

static pm_vec3 box_center(const pm_box *box)
{
    return pm_vec_scale(pm_vec_add(box->low, box->high), 0.5);
}

static pm_status push_box(pm_pieces *pieces, const pm_box *box)
{
    double diagonal = pm_vec_length(pm_vec_sub(box->high, box->low));
    return push(pieces, box_center(box), 0.5 * diagonal);
}

/// The parallelogram corner + [0,1] a + [0,1] b.
static pm_status push_parallelogram(pm_pieces *pieces, pm_vec3 corner, pm_vec3 a, pm_vec3 b)
{
    pm_vec3 sum = pm_vec_add(a, b);
    double longer = pm_most(pm_vec_length(sum), pm_vec_length(pm_vec_sub(a, b)));
    return push(pieces, pm_vec_along(corner, sum, 0.5), 0.5 * longer);
}

static pm_status add_rectangle(pm_pieces *pieces, const pm_shape *shape)
{
    pm_vec3 a = pm_vec_scale(shape->edge[0], 1.0 / PATCHES);
    pm_vec3 b = pm_vec_scale(shape->edge[1], 1.0 / PATCHES);
    for (int i = 0; i < PATCHES; i++) {
        for (int j = 0; j < PATCHES; j++) {
            pm_vec3 corner = pm_vec_along(pm_vec_along(shape->corner, a, i), b, j);
            PM_TRY(push_parallelogram(pieces, corner, a, b));
        }
    }
    return PM_OK;
}

/// How near 0 the interval from -1 + i step to one step further comes.
static double nearest_to_zero(int i, double step)
{
    double low = i * step - 1.0;
    return low > 0.0 ? low : pm_most(0.0, -(low + step));
}

/// The patches of the disk's square that reach into it.
static pm_status add_disk(pm_pieces *pieces, const pm_shape *shape)
{
    const double step = 2.0 / PATCHES;
    pm_frame frame = pm_frame_around(shape->axis);
    pm_vec3 a = pm_vec_scale(frame.s, step * shape->radius);
    pm_vec3 b = pm_vec_scale(frame.t, step * shape->radius);
    pm_vec3 first = pm_vec_along(shape->center, pm_vec_add(a, b), -0.5 * PATCHES);
    for (int i = 0; i < PATCHES; i++) {
        for (int j = 0; j < PATCHES; j++) {
            if (hypot(nearest_to_zero(i, step), nearest_to_zero(j, step)) < 1.0) {
                pm_vec3 corner = pm_vec_along(pm_vec_along(first, a, i), b, j);
                PM_TRY(push_parallelogram(pieces, corner, a, b));
            }
        }
    }
    return PM_OK;
}

static pm_status add_cylinder(pm_pieces *pieces, const pm_shape *shape)
{
    // A piece's points lie up to half its arc to the side of the middle, and their distance
    // from the axis as seen there varies between the radius and its cosine.
    const double half_turn = PM_PI / AROUND;
    const double half_length = 0.5 * shape->length / PATCHES;
    double middle = 0.5 * shape->radius * (1.0 + cos(half_turn));
    double across = shape->radius * sin(half_turn);
    double radius = hypot(hypot(across, shape->radius - middle), half_length);
    pm_frame frame = pm_frame_around(shape->axis);
    for (int i = 0; i < PATCHES; i++) {
        for (int j = 0; j < AROUND; j++) {
            double turn = 2.0 * j * half_turn;
            pm_vec3 local =
                pm_vec(middle * cos(turn), middle * sin(turn), (2.0 * i + 1.0) * half_length);
            pm_vec3 outward = pm_frame_to_world(&frame, local);
            PM_TRY(push(pieces, pm_vec_add(shape->center, outward), radius));
        }
    }
    return PM_OK;
}

// --- meshes ------------------------------------------------------------------------------

static pm_box box_around(pm_box a, pm_box b)
{
    return (pm_box){pm_vec_min(a.low, b.low), pm_vec_max(a.high, b.high)};
}

static pm_box nothing(void)
{
    pm_vec3 far = pm_vec(HUGE_VAL, HUGE_VAL, HUGE_VAL);
    return (pm_box){far, pm_vec_negate(far)};
}

/// Which of GRID slices between `low` and `high` holds `at`.
static int slice_of(double at, double low, double high)
{
    double slice = high > low ? (at - low) / (high - low) * GRID : 0.0;
    return (int)pm_most(0.0, pm_least(slice, GRID - 1.0));
}

static int cell_of(const pm_box *whole, pm_vec3 at)
{
    int x = slice_of(at.x, whole->low.x, whole->high.x);
    int y = slice_of(at.y, whole->low.y, whole->high.y);
    int z = slice_of(at.z, whole->low.z, whole->high.z);
    return (z * GRID + y) * GRID + x;
}

static pm_box mesh_box(const pm_shape *shape)
{
    pm_box whole = nothing();
    for (uint32_t i = 0; i < shape->triangle_count; i++) {
        whole = box_around(whole, pm_shape_box(shape, i));
    }
    return whole;
}

static pm_status push_cells(pm_pieces *pieces, const pm_box *cells)
{
    for (int i = 0; i < GRID * GRID * GRID; i++) {
        if (cells[i].low.x <= cells[i].high.x) {
            PM_TRY(push_box(pieces, &cells[i]));
        }
    }
    return PM_OK;
}

static pm_status add_mesh(pm_pieces *pieces, const pm_shape *shape)
{
    pm_box *cells = malloc(GRID * GRID * GRID * sizeof *cells);
    if (cells == NULL) {
        return PM_FAIL(PM_ENOMEM, "no memory for a grid over %s", shape->id);
    }
    for (int i = 0; i < GRID * GRID * GRID; i++) {
        cells[i] = nothing();
    }
    pm_box whole = mesh_box(shape);
    for (uint32_t i = 0; i < shape->triangle_count; i++) {
        pm_box box = pm_shape_box(shape, i);
        pm_box *cell = &cells[cell_of(&whole, box_center(&box))];
        *cell = box_around(*cell, box);
    }
    pm_status status = push_cells(pieces, cells);
    free(cells);
    return status;
}

// --- any shape ---------------------------------------------------------------------------

pm_status pm_pieces_add(pm_pieces *pieces, const pm_shape *shape)
{
    switch (shape->type) {
    case PM_SHAPE_RECTANGLE:
        return add_rectangle(pieces, shape);
    case PM_SHAPE_SPHERE:
        return push(pieces, shape->center, shape->radius);
    case PM_SHAPE_DISK:
        return add_disk(pieces, shape);
    case PM_SHAPE_CYLINDER:
        return add_cylinder(pieces, shape);
    case PM_SHAPE_MESH:
        break;
    }
    return add_mesh(pieces, shape);
}

pm_ball pm_pieces_whole(const pm_shape *shape)
{
    pm_box box = shape->type == PM_SHAPE_MESH ? mesh_box(shape) : pm_shape_box(shape, 0);
    pm_vec3 center = box_center(&box);
    double radius = 0.5 * pm_vec_length(pm_vec_sub(box.high, box.low));
    return (pm_ball){center, radius + PM_OFFSET * (pm_vec_reach(center) + radius)};
}

void pm_pieces_free(pm_pieces *pieces)
{
    free(pieces->ball);
    *pieces = (pm_pieces){0};
}

// Cells are conservative: what is sent through dark ones meets no target, for every light that
// is aimed, every shape and any scale; and tight enough to be worth it.
#include "projection.h"

#include "cells.h"
#include "scenes.h"
#include "shape.h"
#include "shapes.h"
#include "test.h"

#include <stdlib.h>
#include <string.h>

enum { LIGHTS = 5, TARGETS = 6, SCALES = 3, SENT = 2000 };
static const pm_rng_source source = {.seed = 4, .stream = PM_STREAM_TEST};
static const double scales[SCALES] = {1.0, 1e-3, 1e4};

// --- pieces

static void check_pieces(const pm_shape *shape)
{
    pm_pieces pieces = {0};
    CHECK_OK(pm_pieces_add(&pieces, shape));
    pm_ball whole = pm_pieces_whole(shape);
    for (uint64_t i = 0; i < 300; i++) {
        pm_rng rng = pm_rng_at(&source, i, 0);
        double u = pm_rng_draw(&rng);
        double v = pm_rng_draw(&rng);
        pm_hit hit = {0};
        pm_shape_point(shape, u, v, &hit);
        size_t j = 0;
        while (j < pieces.count &&
               pm_vec_length(pm_vec_sub(hit.position, pieces.ball[j].center)) >
                   pieces.ball[j].radius) {
            j++;
        }
        CHECK_THAT(j < pieces.count, "a point of shape type %d lies in no piece",
                   (int)shape->type);
        CHECK(pm_vec_length(pm_vec_sub(hit.position, whole.center)) <= whole.radius);
    }
    pm_pieces_free(&pieces);
}

static void every_point_lies_in_a_piece(void)
{
    for (uint64_t seed = 0; seed < 20; seed++) {
        pm_shape shapes[PM_SHAPES_KINDS];
        pm_shapes_each(seed, shapes);
        for (int k = 0; k < PM_SHAPES_KINDS; k++) {
            for (int scale = 0; scale < SCALES; scale++) {
                pm_shape shape = pm_shapes_scaled(&shapes[k], scales[scale]);
                check_pieces(&shape);
                pm_shapes_free(&shape, 1);
            }
        }
        pm_shapes_free(shapes, PM_SHAPES_KINDS);
    }
    pm_shape torus = pm_shapes_torus(pm_vec(0.3, -0.2, 1.0), 0.7, 0.2, 60, 30);
    check_pieces(&torus);
    pm_shapes_free(&torus, 1);
}

// --- dark cells

/// One light of kind `which` about 2 from the middle, sizes about 0.3; then shapes.
static void add_light(pm_scenes *s, int which, uint64_t seed, double scale)
{
    static const double cone[2] = {0.5, 1.3};
    pm_rng rng = pm_shapes_rng(seed, 77);
    pm_vec3 way = pm_shapes_direction(&rng);
    pm_vec3 at = pm_vec_scale(pm_vec_negate(way), 2.0 * scale);
    pm_vec3 tilted = pm_vec_normalize(pm_vec_add(way, pm_shapes_inside(&rng, 0.6)));
    pm_frame frame = pm_frame_around(tilted);
    pm_vec3 edge0 = pm_vec_scale(frame.s, 0.3 * scale);
    pm_vec3 edge1 = pm_vec_scale(frame.t, 0.2 * scale);
    switch (which) {
    case 0:
        pm_scenes_point(s, at, pm_gray(1.0));
        return;
    case 1:
        pm_scenes_spot(s, at, tilted, cone, pm_gray(1.0));
        return;
    case 2:
        pm_scenes_sun(s, tilted, pm_gray(1.0));
        return;
    default:
        break;
    }
    pm_shape lamp = which == 3 ? pm_shapes_rectangle(at, edge0, edge1)
                               : pm_shapes_disk(at, tilted, 0.2 * scale);
    pm_scenes_lamp(s, pm_scenes_add(s, lamp, PM_NONE, PM_NONE), pm_gray(1.0));
}

static pm_shape target_of(int which, uint64_t seed, double scale)
{
    pm_shape shapes[PM_SHAPES_KINDS];
    pm_shapes_each(seed, shapes);
    pm_shape torus = pm_shapes_torus(pm_vec(0.3, -0.2, 0.4), 0.5, 0.1, 10, 6);
    pm_shape target =
        pm_shapes_scaled(which < PM_SHAPES_KINDS ? &shapes[which] : &torus, scale);
    pm_shapes_free(shapes, PM_SHAPES_KINDS);
    pm_shapes_free(&torus, 1);
    return target;
}

/// The cells that the last shape of a ready scene lights for light 0.
static void light_cells(const pm_scenes *s, pm_cells *cells)
{
    pm_pieces pieces = {0};
    CHECK_OK(pm_pieces_add(&pieces, &s->shapes[s->scene.shape_count - 1]));
    CHECK(pm_cells_begin(&s->scene, &s->lights[0], cells));
    for (size_t i = 0; i < pieces.count; i++) {
        pm_cells_light(cells, &pieces.ball[i]);
    }
    pm_pieces_free(&pieces);
}

static bool borders_on_lit(const pm_cells *cells, int cell)
{
    int row = cell / PM_CELLS_COLUMNS;
    for (int i = row > 0 ? row - 1 : 0; i <= row + 1 && i < PM_CELLS_ROWS; i++) {
        for (int j = PM_CELLS_COLUMNS - 1; j <= PM_CELLS_COLUMNS + 1; j++) {
            int column = (cell + j) % PM_CELLS_COLUMNS;
            if (cells->lit[i * PM_CELLS_COLUMNS + column]) {
                return true;
            }
        }
    }
    return false;
}

/// The dark cells next to lit ones first, then the others.
static pm_projection dark_cells(const pm_cells *cells, uint32_t *list, bool borders)
{
    pm_projection dark = {PM_CELLS_ROWS, PM_CELLS_COLUMNS, list, 0};
    for (int i = 0; i < PM_CELLS; i++) {
        if (!cells->lit[i] && (!borders || borders_on_lit(cells, i))) {
            list[dark.lit_count++] = (uint32_t)i;
        }
    }
    return dark;
}

/// Sends photons through dark cells only. Returns how many.
static uint64_t send_into_the_dark(const pm_scenes *s, const pm_cells *cells)
{
    static uint32_t list[PM_CELLS];
    uint64_t sent = 0;
    int target = s->scene.shape_count - 1;
    for (int borders = 0; borders < 2; borders++) {
        pm_projection dark = dark_cells(cells, list, borders);
        for (uint64_t i = 0; i < SENT && dark.lit_count > 0; i++) {
            pm_rng rng = pm_rng_at(&source, i, (uint32_t)borders);
            pm_ray ray;
            pm_hit hit;
            CHECK_OK(pm_emit_ray(&s->scene, &s->lights[0], &dark, &rng, &ray));
            CHECK_THAT(!pm_closest(&s->world, &ray, &hit) || hit.shape != target,
                       "light type %d: a photon from a dark cell meets shape type %d",
                       (int)s->lights[0].type, (int)s->shapes[target].type);
            sent++;
        }
    }
    return sent;
}

static uint64_t check_pair(int light, int kind, uint64_t seed, double scale)
{
    static pm_cells cells;
    pm_scenes s;
    pm_scenes_begin(&s);
    add_light(&s, light, seed, scale);
    pm_scenes_add(&s, target_of(kind, seed, scale), PM_NONE, PM_NONE);
    pm_scenes_ready(&s);
    light_cells(&s, &cells);
    uint64_t sent = send_into_the_dark(&s, &cells);
    pm_scenes_free(&s);
    return sent;
}

static void dark_cells_reach_nothing(void)
{
    uint64_t sent = 0;
    for (int light = 0; light < LIGHTS; light++) {
        for (int kind = 0; kind < TARGETS; kind++) {
            for (int i = 0; i < 3 * SCALES; i++) {
                sent += check_pair(light, kind, (uint64_t)i, scales[i % SCALES]);
            }
        }
    }
    CHECK_THAT(sent > 700000, "only %llu photons were sent", (unsigned long long)sent);
}

static void check_near(int which, double gap, bool inside)
{
    // A ball of radius 1 about the origin, a light straight above it that far off its surface.
    static const double cone[2] = {0.1, 3.0};
    static pm_cells cells;
    pm_vec3 at = pm_vec(0.0, 0.0, 1.0 + gap);
    pm_scenes s;
    pm_scenes_begin(&s);
    if (which == 0) {
        pm_scenes_point(&s, at, pm_gray(1.0));
    } else if (which == 1) {
        pm_scenes_spot(&s, at, pm_vec(0.0, 0.6, -0.8), cone, pm_gray(1.0));
    } else {
        int lamp = pm_scenes_add(&s, pm_scenes_square(1e-3, at.z, true), PM_NONE, PM_NONE);
        pm_scenes_lamp(&s, lamp, pm_gray(1.0));
    }
    pm_scenes_add(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0), PM_NONE, PM_NONE);
    pm_scenes_ready(&s);
    light_cells(&s, &cells);
    if (inside) {
        CHECK(cells.lit_count == PM_CELLS);
    }
    send_into_the_dark(&s, &cells);
    pm_scenes_free(&s);
}

static void lights_touch_their_targets(void)
{
    static const double outside[5] = {1e-12, 1e-6, 1e-3, 0.01, 0.5};
    static const double inside[4] = {0.0, -1e-6, -0.5, -1.5};
    for (int which = 0; which < 3; which++) {
        for (int i = 0; i < 5; i++) {
            check_near(which, outside[i], false);
        }
        for (int i = 0; i < 4; i++) {
            check_near(which, inside[i], true);
        }
    }
}

static void check_poles(pm_vec3 center, double radius)
{
    static pm_cells cells;
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_point(&s, pm_vec(0.0, 0.0, 0.0), pm_gray(1.0));
    pm_scenes_add(&s, pm_shapes_sphere(center, radius), PM_NONE, PM_NONE);
    pm_scenes_ready(&s);
    light_cells(&s, &cells);
    // The cap's share of the sphere, and of a ring of cells around it, some 0.1 wide.
    double sine = radius / pm_vec_length(center);
    double wider = pm_least(1.0, sine + 0.1);
    double least = 0.5 * (1.0 - sqrt(1.0 - sine * sine));
    double most = 0.5 * (1.0 - sqrt(1.0 - wider * wider));
    double share = (double)cells.lit_count / PM_CELLS;
    CHECK_THAT(share >= least && share <= most + 2.0 / PM_CELLS_ROWS,
               "a ball of %g sr lights %g of the sphere", 4.0 * PM_PI * least, share);
    send_into_the_dark(&s, &cells);
    pm_scenes_free(&s);
}

static void caps_fit_at_poles_and_seams(void)
{
    static const double angles[9] = {0.0,  1e-9, 1e-5,         0.05, 0.3,
                                     1.57, 3.0,  PM_PI - 1e-6, PM_PI};
    static const double turns[5] = {0.0, 1e-12, 1.0, PM_PI, -1e-9};
    for (int i = 0; i < 9; i++) {
        for (int j = 0; j < 5; j++) {
            double sine = sin(angles[i]);
            pm_vec3 way = pm_vec(sine * cos(turns[j]), sine * sin(turns[j]), cos(angles[i]));
            check_poles(way, 1e-7);
            check_poles(way, 0.05);
            check_poles(way, 0.6);
        }
    }
}

static void lights_without_one_square_send_everywhere(void)
{
    static pm_cells cells;
    pm_scenes s;
    pm_scenes_begin(&s);
    pm_scenes_sky(&s, pm_gray(1.0));
    int ball =
        pm_scenes_add(&s, pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 1.0), PM_NONE, PM_NONE);
    pm_scenes_lamp(&s, ball, pm_gray(1.0));
    pm_scenes_ready(&s);
    CHECK(!pm_cells_begin(&s.scene, &s.lights[0], &cells));
    CHECK(!pm_cells_begin(&s.scene, &s.lights[1], &cells));
    pm_scenes_free(&s);
}

PM_TESTS({"projection.1", "every point of a shape lies in one of its pieces",
          every_point_lies_in_a_piece},
         {"projection.2",
          "no photon from a dark cell meets a target, of any shape at any scale",
          dark_cells_reach_nothing},
         {"projection.3", "lights that touch a target, or stand in it, reach it from lit cells",
          lights_touch_their_targets},
         {"projection.4", "a ball lights its cap and little more, at poles and seams too",
          caps_fit_at_poles_and_seams},
         {"projection.5", "lights whose directions hang on the place have no cells",
          lights_without_one_square_send_everywhere})

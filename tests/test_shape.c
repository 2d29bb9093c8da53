// Single shapes: hits against naive formulas in long double, points against counts by area, and
// the offset rule on examples by hand.
#include "shape.h"

#include "shape_hit.h"
#include "shapes.h"
#include "test.h"

#include <gsl/gsl_cdf.h>

static pm_ray ray_from(pm_vec3 origin, pm_vec3 direction)
{
    return (pm_ray){origin, direction, HUGE_VAL, 0.0, PM_NONE};
}

// --- what a hit holds --------------------------------------------------------------------

static void hits_lie_on_their_shape(void)
{
    for (uint64_t seed = 0; seed < 2000; seed++) {
        pm_shape shapes[PM_SHAPES_KINDS];
        pm_shapes_each(seed, shapes);
        pm_rng rng = pm_shapes_rng(seed, 5);
        for (int i = 0; i < PM_SHAPES_KINDS; i++) {
            double u = pm_rng_draw(&rng);
            double v = pm_rng_draw(&rng);
            pm_hit point;
            shapes[i].flipped = seed % 2;
            pm_shape_point(&shapes[i], u, v, &point);
            CHECK_NEAR(pm_vec_length(point.normal), 1.0, 1e-12);

            // A ray onto the front of that point, from close by, comes back to it.
            pm_ray ray = ray_from(pm_vec_along(point.position, point.normal, 1e-3),
                                  pm_vec_negate(point.normal));
            pm_hit hit = {0};
            CHECK(pm_shape_hit(&shapes[i], 0, &ray, HUGE_VAL, &hit.t));
            pm_shape_complete(&shapes[i], &ray, &hit);
            CHECK_NEAR(hit.t, 1e-3, 1e-12);
            CHECK_NEAR(pm_vec_length(pm_vec_sub(hit.position, point.position)), 0.0, 1e-12);
            CHECK_NEAR(pm_vec_dot(hit.normal, point.normal), 1.0, 1e-12);
            CHECK_NEAR(hit.offset, point.offset, 1e-18);
        }
        pm_shapes_free(shapes, PM_SHAPES_KINDS);
    }
}

static void offset_is_of_hit_and_primitive(void)
{
    pm_shape ball = pm_shapes_sphere(pm_vec(0.0, 0.0, 0.0), 4.0);
    pm_shape wall = pm_shapes_rectangle(pm_vec(-1.0, -8.0, 2.0), pm_vec(2.0, 0.0, 0.0),
                                        pm_vec(0.0, 16.0, 0.0));
    pm_frame flat = pm_shapes_upright();
    pm_shape cube = pm_shapes_cube(&flat, pm_vec(0.0, 0.0, 0.0), 0.5);
    cube.reach = 1e6; // other triangles of a mesh do not count
    pm_hit hit;
    pm_shape_point(&ball, 0.3, 0.4, &hit);
    CHECK_NEAR(hit.offset, 4.0 * 0x1p-19, 0.0);
    pm_shape_point(&wall, 0.5, 0.5, &hit);
    CHECK_NEAR(hit.offset, 8.0 * 0x1p-19, 0.0);
    CHECK_NEAR(pm_hit_leave(&hit, pm_vec(0.0, 0.6, 0.8)).z, 2.0 + hit.offset, 0.0);
    CHECK_NEAR(pm_hit_leave(&hit, pm_vec(0.0, 0.6, -0.8)).z, 2.0 - hit.offset, 0.0);
    pm_shape_point(&cube, 0.5, 0.5, &hit);
    CHECK_NEAR(hit.offset, 0.5 * 0x1p-19, 0.0);
    pm_shapes_free(&cube, 1);
}

static double to_line(pm_vec3 point, pm_vec3 from, pm_vec3 to)
{
    pm_vec3 way = pm_vec_normalize(pm_vec_sub(to, from));
    return pm_vec_length(pm_vec_cross(pm_vec_sub(point, from), way));
}

static double to_border(const pm_shape *shape, pm_vec3 point)
{
    pm_vec3 corner[4] = {shape->corner, pm_vec_add(shape->corner, shape->edge[0]),
                         pm_vec_add(shape->corner, shape->edge[1])};
    int corners = shape->type == PM_SHAPE_RECTANGLE ? 4 : 3;
    corner[3] = corner[2];
    corner[2] = pm_vec_add(corner[1], shape->edge[1]);
    for (int i = 0; i < 3 && corners == 3; i++) {
        corner[i] = shape->vertices[i];
    }
    double nearest = HUGE_VAL;
    for (int i = 0; i < corners; i++) {
        nearest = fmin(nearest, to_line(point, corner[i], corner[(i + 1) % corners]));
    }
    return nearest;
}

static void inner_keeps_off_the_border(void)
{
    pm_vec3 a = pm_vec(1.0, 0.0, 0.0);
    pm_vec3 b = pm_vec(2.0, 0.5, 0.0);
    pm_vec3 c = pm_vec(1.2, 1.0, 0.4);
    pm_shape flat[2] = {pm_shapes_rectangle(a, pm_vec_sub(b, a), pm_vec_sub(c, a)),
                        pm_shapes_triangle(a, b, c)};
    static const double edge[7] = {0.0, 1e-9, 1e-6, 0.3, 1.0 - 1e-6, 1.0 - 1e-9, 1.0 - 0x1p-53};
    for (int i = 0; i < 2 * 49; i++) {
        const pm_shape *shape = &flat[i / 49];
        pm_hit hit;
        pm_shape_point(shape, edge[i % 7], edge[i / 7 % 7], &hit);
        double here = to_border(shape, hit.position);
        CHECK(to_border(shape, hit.inner) >= 4.0 * hit.offset * (1.0 - 1e-6));
        CHECK(here < 8.0 * hit.offset ||
              pm_vec_length(pm_vec_sub(hit.inner, hit.position)) == 0.0);
        CHECK_NEAR(pm_vec_dot(pm_vec_sub(hit.inner, hit.position), hit.normal), 0.0, 1e-15);
        CHECK(pm_vec_length(pm_vec_sub(hit.inner, hit.position)) < 40.0 * hit.offset);
    }
    pm_shapes_free(flat, 2);
}

static void inner_without_room_is_the_middle(void)
{
    double tiny = 1e-9;
    pm_vec3 far = pm_vec(1.0, 0.0, 0.0);
    pm_vec3 x = pm_vec(tiny, 0.0, 0.0);
    pm_vec3 y = pm_vec(0.0, tiny, 0.0);
    pm_shape small[3] = {pm_shapes_rectangle(far, x, y),
                         pm_shapes_disk(far, pm_vec(0.0, 0.0, 1.0), tiny),
                         pm_shapes_triangle(far, pm_vec_add(far, x), pm_vec_add(far, y))};
    pm_vec3 middle[3] = {pm_vec(1.0 + 0.5 * tiny, 0.5 * tiny, 0.0), far,
                         pm_vec(1.0 + tiny / 3.0, tiny / 3.0, 0.0)};
    for (int i = 0; i < 3; i++) {
        pm_hit hit;
        pm_shape_point(&small[i], 0.9, 0.1, &hit);
        CHECK_NEAR(pm_vec_length(pm_vec_sub(hit.inner, middle[i])), 0.0, 1e-15);
    }
    pm_shape tube = pm_shapes_cylinder(far, pm_vec(0.0, 0.0, 1.0), tiny, 0.5);
    pm_hit hit;
    pm_shape_point(&tube, 0.0, 0.0, &hit);
    CHECK_NEAR(hit.inner.z, 0.5 * tiny, 1e-18);
    pm_shapes_free(small, 3);
}

// --- points and boxes --------------------------------------------------------------------

enum { CELLS = 8, POINTS = 200000 };

/// The cell, of 8 x 8 with equal areas, that a point of the shape lies in, by its own formula.
static int cell_of(const pm_shape *shape, pm_vec3 point)
{
    pm_frame frame =
        pm_frame_around(shape->type == PM_SHAPE_SPHERE ? pm_vec(0.0, 0.0, 1.0) : shape->axis);
    pm_vec3 out = pm_vec_sub(point, shape->center);
    double height = pm_vec_dot(out, frame.n);
    double turn =
        atan2(pm_vec_dot(out, frame.t), pm_vec_dot(out, frame.s)) / (2.0 * PM_PI) + 0.5;
    double part = height / shape->length;
    if (shape->type == PM_SHAPE_RECTANGLE) { // its edges are perpendicular here
        pm_vec3 from = pm_vec_sub(point, shape->corner);
        const pm_vec3 *edge = shape->edge;
        part = pm_vec_dot(from, edge[0]) / pm_vec_dot(edge[0], edge[0]);
        turn = pm_vec_dot(from, edge[1]) / pm_vec_dot(edge[1], edge[1]);
    } else if (shape->type == PM_SHAPE_SPHERE) {
        part = 0.5 + 0.5 * height / shape->radius;
    } else if (shape->type == PM_SHAPE_DISK) {
        part = pm_vec_dot(out, out) / (shape->radius * shape->radius);
    }
    int row = (int)fmin(fmax(part, 0.0) * CELLS, CELLS - 1);
    int column = (int)fmin(fmax(turn, 0.0) * CELLS, CELLS - 1);
    return row * CELLS + column;
}

/// Fails where a chi-square as large has a probability below that of 5 sigma.
static void check_counts(const long *counts, const double *expected, int cells, int kind)
{
    double chi2 = 0.0;
    for (int i = 0; i < cells; i++) {
        double off = (double)counts[i] - expected[i];
        chi2 += off * off / expected[i];
    }
    double chance = gsl_cdf_chisq_Q(chi2, cells - 1);
    CHECK_THAT(chance > 2.9e-7, "kind %d: chi-square %g over %d cells", kind, chi2, cells);
}

static void points_are_uniform(void)
{
    pm_vec3 axis = pm_vec_normalize(pm_vec(0.3, -0.5, 0.8));
    pm_vec3 center = pm_vec(0.5, 0.2, -0.3);
    pm_shape shapes[4] = {
        pm_shapes_rectangle(center, pm_vec(2.0, 0.0, 0.0), pm_vec(0.0, 0.3, 0.4)),
        pm_shapes_sphere(center, 0.7), pm_shapes_disk(center, axis, 0.7),
        pm_shapes_cylinder(center, axis, 1.5, 0.7)};
    double expected[CELLS * CELLS];
    for (int i = 0; i < CELLS * CELLS; i++) {
        expected[i] = (double)POINTS / (CELLS * CELLS);
    }
    for (int kind = 0; kind < 4; kind++) {
        long counts[CELLS * CELLS] = {0};
        pm_rng rng = pm_shapes_rng((uint64_t)kind, 6);
        for (int i = 0; i < POINTS; i++) {
            double u = pm_rng_draw(&rng);
            double v = pm_rng_draw(&rng);
            pm_hit hit;
            pm_shape_point(&shapes[kind], u, v, &hit);
            counts[cell_of(&shapes[kind], hit.position)]++;
        }
        check_counts(counts, expected, CELLS * CELLS, kind);
    }
}

/// Mesh points: triangles by area, and within a triangle the third that each vertex is nearest
/// to in barycentrics.
static void mesh_points_are_uniform(void)
{
    pm_shape ball = pm_shapes_ball(pm_vec(0.1, 0.2, 0.3), 2.0, 4, 5);
    enum { MOST = 3 * 30 };
    CHECK(ball.triangle_count == 30);
    long counts[MOST] = {0};
    double expected[MOST];
    for (uint32_t i = 0; i < MOST; i++) {
        double below = i < 3 ? 0.0 : ball.area_below[i / 3 - 1];
        expected[i] = POINTS * (ball.area_below[i / 3] - below) / (3.0 * ball.area);
    }
    pm_rng rng = pm_shapes_rng(0, 7);
    for (int i = 0; i < POINTS; i++) {
        double u = pm_rng_draw(&rng);
        double v = pm_rng_draw(&rng);
        pm_hit hit;
        pm_shape_point(&ball, u, v, &hit);
        const uint32_t *corner = ball.triangles[hit.primitive];
        uint32_t most = 0;
        double largest = 0.0;
        for (uint32_t j = 0; j < 3;
             j++) { // twice the area opposite a vertex is its barycentric
            pm_vec3 one = pm_vec_sub(ball.vertices[corner[(j + 1) % 3]], hit.position);
            pm_vec3 two = pm_vec_sub(ball.vertices[corner[(j + 2) % 3]], hit.position);
            double opposite = pm_vec_length(pm_vec_cross(one, two));
            most = opposite > largest ? j : most;
            largest = fmax(largest, opposite);
        }
        counts[3 * hit.primitive + most]++;
    }
    check_counts(counts, expected, MOST, PM_SHAPE_MESH);
    pm_shapes_free(&ball, 1);
}

static void boxes_are_tight(void)
{
    for (uint64_t seed = 0; seed < 20; seed++) {
        pm_shape shapes[PM_SHAPES_KINDS];
        pm_shapes_each(seed, shapes);
        for (int i = 0; i < PM_SHAPES_KINDS; i++) {
            pm_box box = pm_shape_box(&shapes[i], 0);
            pm_vec3 low = pm_vec(1e9, 1e9, 1e9);
            pm_vec3 high = pm_vec(-1e9, -1e9, -1e9);
            for (int j = 0; j < 201 * 201; j++) {
                pm_hit hit;
                double last = 1.0 - 0x1p-53;
                pm_shape_point(&shapes[i], fmin(last, j % 201 / 200.0),
                               fmin(last, j / 201 / 200.0), &hit);
                low = pm_vec_min(low, hit.position);
                high = pm_vec_max(high, hit.position);
            }
            CHECK_NEAR(pm_vec_reach(pm_vec_sub(low, box.low)), 0.0, 2e-3);
            CHECK_NEAR(pm_vec_reach(pm_vec_sub(high, box.high)), 0.0, 2e-3);
            for (int k = 0; k < 3; k++) {
                CHECK(pm_vec_axis(box.low, k) <= pm_vec_axis(low, k) + 1e-15);
                CHECK(pm_vec_axis(box.high, k) >= pm_vec_axis(high, k) - 1e-15);
            }
        }
        pm_shapes_free(shapes, PM_SHAPES_KINDS);
    }
}

PM_TESTS({"shape.1", "hits and points lie on their shape, normals flip with it",
          hits_lie_on_their_shape},
         {"shape.2", "the offset is 2^-19 of the largest coordinate of hit and primitive",
          offset_is_of_hit_and_primitive},
         {"shape.3",
          "inner keeps four offsets from the border, and moves no further than it must",
          inner_keeps_off_the_border},
         {"shape.4", "on a primitive too small for that, inner is its middle",
          inner_without_room_is_the_middle},
         {"shape.5", "points are uniform by area on every kind", points_are_uniform},
         {"shape.6", "points of a mesh are uniform over and within its triangles",
          mesh_points_are_uniform},
         {"shape.7", "a primitive's box holds it and no more", boxes_are_tight})

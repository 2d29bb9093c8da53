// Shapes and scenes made by hand, for tests of geometry: one-sided black things without a
// light, in coordinates that are already centred.
#ifndef PM_SHAPES_H
#define PM_SHAPES_H

#include "intersect.h"
#include "rng.h"
#include "scene.h"

#include <stddef.h>

/// Bases along the coordinate axes, and along none of them.
pm_frame pm_shapes_upright(void);
pm_frame pm_shapes_askew(void);

pm_shape pm_shapes_rectangle(pm_vec3 corner, pm_vec3 edge0, pm_vec3 edge1);
pm_shape pm_shapes_sphere(pm_vec3 center, double radius);
pm_shape pm_shapes_disk(pm_vec3 center, pm_vec3 axis, double radius);
pm_shape pm_shapes_cylinder(pm_vec3 center, pm_vec3 axis, double length, double radius);

/// Meshes with normals outward and area_below; pm_shapes_free() frees what they hold.
pm_shape pm_shapes_triangle(pm_vec3 a, pm_vec3 b, pm_vec3 c);
pm_shape pm_shapes_cube(const pm_frame *turned, pm_vec3 center, double half);
pm_shape pm_shapes_ball(pm_vec3 center, double radius, uint32_t rings, uint32_t sectors);
pm_shape pm_shapes_torus(pm_vec3 center, double ring, double tube, uint32_t around,
                         uint32_t across);
void pm_shapes_free(pm_shape *shapes, size_t count);

/// The six walls of a box as rectangles, normals inward. Each is computed on its own, so in a
/// turned box the edges that meet differ by rounding.
void pm_shapes_room(const pm_frame *turned, pm_vec3 center, double half, pm_shape walls[6]);

/// One shape of each type, of sizes and in coordinates of about 1, other ones for every seed.
/// The mesh is one triangle.
enum { PM_SHAPES_KINDS = 5 };
void pm_shapes_each(uint64_t seed, pm_shape shapes[PM_SHAPES_KINDS]);

/// A scene of these shapes; it borrows them.
pm_scene pm_shapes_scene(pm_shape *shapes, size_t count);

/// The same shape with all lengths times `factor`.
pm_shape pm_shapes_scaled(const pm_shape *shape, double factor);

/// The place to draw a test's numbers from.
pm_rng pm_shapes_rng(uint64_t index, uint32_t bounce);

/// Uniform unit vector; uniform point of the cube from -half to half.
pm_vec3 pm_shapes_direction(pm_rng *rng);
pm_vec3 pm_shapes_inside(pm_rng *rng, double half);

#endif

// Vectors: by hand where the answer is obvious, by their defining properties elsewhere.
#include "rng.h"
#include "test.h"
#include "vec.h"

#include <float.h>
#include <math.h>

static const pm_rng_source source = {.seed = 3, .stream = PM_STREAM_TEST};

static void check_same(const char *what, pm_vec3 got, pm_vec3 want, double tolerance)
{
    double off = pm_vec_reach(pm_vec_sub(got, want));
    CHECK_THAT(off <= tolerance, "%s: got (%.17g, %.17g, %.17g), want (%.17g, %.17g, %.17g)",
               what, got.x, got.y, got.z, want.x, want.y, want.z);
}

// Uniform on the unit sphere.
static pm_vec3 unit_vector(uint64_t index)
{
    pm_rng rng = pm_rng_at(&source, index, 0);
    double z = 2.0 * pm_rng_draw(&rng) - 1.0;
    double angle = 2.0 * PM_PI * pm_rng_draw(&rng);
    double radius = sqrt(fmax(0.0, 1.0 - z * z));
    return pm_vec(radius * cos(angle), radius * sin(angle), z);
}

static void compute_by_hand(void)
{
    pm_vec3 a = pm_vec(1.0, -2.0, 3.0);
    pm_vec3 b = pm_vec(4.0, 5.0, -6.0);
    check_same("a + b", pm_vec_add(a, b), pm_vec(5.0, 3.0, -3.0), 0.0);
    check_same("a - b", pm_vec_sub(a, b), pm_vec(-3.0, -7.0, 9.0), 0.0);
    check_same("2 a", pm_vec_scale(a, 2.0), pm_vec(2.0, -4.0, 6.0), 0.0);
    check_same("-a", pm_vec_negate(a), pm_vec(-1.0, 2.0, -3.0), 0.0);
    check_same("a + 2 b", pm_vec_along(a, b, 2.0), pm_vec(9.0, 8.0, -9.0), 0.0);
    check_same("min", pm_vec_min(a, b), pm_vec(1.0, -2.0, -6.0), 0.0);
    check_same("max", pm_vec_max(a, b), pm_vec(4.0, 5.0, 3.0), 0.0);
    CHECK_NEAR(pm_vec_dot(a, b), -24.0, 0.0);
    CHECK_NEAR(pm_vec_length(pm_vec(2.0, -3.0, 6.0)), 7.0, 0.0);
    CHECK_NEAR(pm_vec_reach(b), 6.0, 0.0);
}

static void pick_axes(void)
{
    pm_vec3 a = pm_vec(7.0, 8.0, 9.0);
    for (int axis = 0; axis < 3; ++axis) {
        CHECK_NEAR(pm_vec_axis(a, axis), 7.0 + axis, 0.0);
    }
}

static void turn_right_handed(void)
{
    pm_vec3 x = pm_vec(1.0, 0.0, 0.0);
    pm_vec3 y = pm_vec(0.0, 1.0, 0.0);
    pm_vec3 z = pm_vec(0.0, 0.0, 1.0);
    check_same("x cross y", pm_vec_cross(x, y), z, 0.0);
    check_same("y cross z", pm_vec_cross(y, z), x, 0.0);
    check_same("z cross x", pm_vec_cross(z, x), y, 0.0);
}

static void normalize_any_length(void)
{
    for (int exponent = -150; exponent <= 150; exponent += 50) {
        double scale = pow(10.0, exponent);
        pm_vec3 unit = pm_vec_normalize(pm_vec(2.0 * scale, -3.0 * scale, 6.0 * scale));
        check_same("normalized", unit, pm_vec(2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0),
                   4 * DBL_EPSILON);
    }
}

static void reflect_by_hand(void)
{
    pm_vec3 up = pm_vec(0.0, 0.0, 1.0);
    check_same("from above", pm_vec_reflect(pm_vec(0.6, 0.0, 0.8), up), pm_vec(-0.6, 0.0, 0.8),
               0.0);
    check_same("along the normal", pm_vec_reflect(up, up), up, 0.0);
}

// Same angle to the normal, and the sum of both directions lies along the normal.
static void reflect_in_one_plane(void)
{
    for (uint64_t i = 0; i < 1000; ++i) {
        pm_vec3 n = unit_vector(2 * i);
        pm_vec3 wi = unit_vector(2 * i + 1);
        pm_vec3 wo = pm_vec_reflect(wi, n);
        CHECK_NEAR(pm_vec_dot(wo, n), pm_vec_dot(wi, n), 8 * DBL_EPSILON);
        CHECK_NEAR(pm_vec_length(wo), 1.0, 8 * DBL_EPSILON);
        CHECK_NEAR(pm_vec_length(pm_vec_cross(pm_vec_add(wi, wo), n)), 0.0, 8 * DBL_EPSILON);
    }
}

static void check_frame(pm_vec3 n)
{
    pm_frame f = pm_frame_around(n);
    const double tolerance = 8 * DBL_EPSILON;
    check_same("n", f.n, n, 0.0);
    CHECK_NEAR(pm_vec_length(f.s), 1.0, tolerance);
    CHECK_NEAR(pm_vec_length(f.t), 1.0, tolerance);
    CHECK_NEAR(pm_vec_dot(f.s, f.t), 0.0, tolerance);
    CHECK_NEAR(pm_vec_dot(f.s, f.n), 0.0, tolerance);
    CHECK_NEAR(pm_vec_dot(f.t, f.n), 0.0, tolerance);
    check_same("s cross t", pm_vec_cross(f.s, f.t), n, tolerance);
}

static void frame_every_direction(void)
{
    for (uint64_t i = 0; i < 20000; ++i) {
        check_frame(unit_vector(i));
    }
}

// Where older constructions divide by almost nothing: around -z, and z = 0 of either sign.
static void frame_hard_directions(void)
{
    check_frame(pm_vec(0.0, 0.0, 1.0));
    check_frame(pm_vec(0.0, 0.0, -1.0));
    check_frame(pm_vec(1.0, 0.0, 0.0));
    check_frame(pm_vec(1.0, 0.0, -0.0));
    check_frame(pm_vec(0.0, -1.0, -0.0));
    for (int exponent = 1; exponent <= 16; ++exponent) {
        double aside = pow(10.0, -exponent);
        check_frame(pm_vec_normalize(pm_vec(aside, -aside, -1.0)));
        check_frame(pm_vec_normalize(pm_vec(aside, aside, 1.0)));
    }
}

static void carry_local_to_world(void)
{
    for (uint64_t i = 0; i < 1000; ++i) {
        pm_frame f = pm_frame_around(unit_vector(i));
        pm_vec3 local = unit_vector(i + 1000);
        pm_vec3 world = pm_frame_to_world(&f, local);
        CHECK_NEAR(pm_vec_dot(world, f.s), local.x, 8 * DBL_EPSILON);
        CHECK_NEAR(pm_vec_dot(world, f.t), local.y, 8 * DBL_EPSILON);
        CHECK_NEAR(pm_vec_dot(world, f.n), local.z, 8 * DBL_EPSILON);
    }
}

PM_TESTS(
    {"vec.1", "sums, products, lengths and bounds are as computed by hand", compute_by_hand},
    {"vec.2", "axis 0, 1, 2 is x, y, z", pick_axes},
    {"vec.3", "the cross product is right-handed", turn_right_handed},
    {"vec.4", "very short and very long vectors become unit vectors", normalize_any_length},
    {"vec.5", "a mirror turns a direction as drawn on paper", reflect_by_hand},
    {"vec.6", "mirror image and direction make one angle and one plane with the normal",
     reflect_in_one_plane},
    {"vec.7", "a frame is orthonormal and right-handed around any direction",
     frame_every_direction},
    {"vec.8", "a frame has no singular direction, not even near -z", frame_hard_directions},
    {"vec.9", "local coordinates are the products with the frame's axes", carry_local_to_world})

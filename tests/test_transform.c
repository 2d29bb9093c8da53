// Transforms, against matrices that Mitsuba 3.9 makes of the same elements.
#include "test.h"
#include "transform.h"

static void check_vector(pm_vec3 got, double x, double y, double z, double tolerance)
{
    CHECK_NEAR(got.x, x, tolerance);
    CHECK_NEAR(got.y, y, tolerance);
    CHECK_NEAR(got.z, z, tolerance);
}

static void quarter_turns(void)
{
    for (int turns = -9; turns <= 9; turns++) {
        pm_transform t = pm_transform_rotate(pm_vec(0.0, 0.0, 1.0), 90.0 * turns);
        double s = (double[4]){0.0, 1.0, 0.0, -1.0}[(turns + 12) % 4];
        double c = (double[4]){1.0, 0.0, -1.0, 0.0}[(turns + 12) % 4];
        check_vector(t.column[0], c, s, 0.0, 0.0);
        check_vector(t.column[1], -s, c, 0.0, 0.0);
        check_vector(t.column[2], 0.0, 0.0, 1.0, 0.0);
    }
}

static void any_turn(void)
{
    // About the cube's diagonal, 120 degrees send x to y, y to z, z to x.
    pm_transform t = pm_transform_rotate(pm_vec(1.0, 1.0, 1.0), 120.0);
    check_vector(t.column[0], 0.0, 1.0, 0.0, 1e-15);
    check_vector(t.column[1], 0.0, 0.0, 1.0, 1e-15);
    check_vector(t.column[2], 1.0, 0.0, 0.0, 1e-15);
    t = pm_transform_rotate(pm_vec(1e-200, 0.0, 0.0), 30.0);
    check_vector(t.column[1], 0.0, sqrt(0.75), 0.5, 1e-15);
}

static void look(void)
{
    pm_transform t = pm_transform_look_at(pm_vec(1.0, 2.0, 3.0), pm_vec(4.0, 6.0, 3.0),
                                          pm_vec(0.0, 0.0, 1.0));
    check_vector(t.column[0], -0.8, 0.6, 0.0, 1e-15);
    check_vector(t.column[1], 0.0, 0.0, 1.0, 1e-15);
    check_vector(t.column[2], 0.6, 0.8, 0.0, 1e-15);
    check_vector(t.origin, 1.0, 2.0, 3.0, 0.0);
}

static void look_without_up(void)
{
    pm_transform t = pm_transform_look_at(pm_vec(0.0, 0.0, 0.0), pm_vec(1.0, 2.0, 3.0),
                                          pm_vec(0.0, 0.0, 0.0));
    check_vector(t.column[0], 0.0792865, -0.841427, 0.534522, 1e-6);
    check_vector(t.column[1], 0.960357, -0.0792865, -0.267261, 1e-6);
}

static void order(void)
{
    pm_transform move = pm_transform_translate(pm_vec(1.0, 0.0, 0.0));
    pm_transform grow = pm_transform_scale(pm_vec(2.0, 3.0, 4.0));
    check_vector(pm_transform_then(&move, &grow).origin, 2.0, 0.0, 0.0, 0.0);
    check_vector(pm_transform_then(&grow, &move).origin, 1.0, 0.0, 0.0, 0.0);
    check_vector(pm_transform_vector(&grow, pm_vec(1.0, 1.0, 1.0)), 2.0, 3.0, 4.0, 0.0);
}

static void handedness(void)
{
    pm_transform t = pm_transform_scale(pm_vec(1e-150, 2.0, 1e150));
    CHECK_NEAR(pm_transform_handedness(&t), 1.0, 1e-15);
    t = pm_transform_scale(pm_vec(-1.0, 1.0, 1.0));
    CHECK_NEAR(pm_transform_handedness(&t), -1.0, 1e-15);
    t = pm_transform_scale(pm_vec(1.0, 0.0, 1.0));
    CHECK(pm_transform_handedness(&t) == 0.0);
    t.column[1] = pm_vec(0.1, 0.0, 0.7);
    CHECK(pm_transform_handedness(&t) == 0.0);
}

PM_TESTS({"transform.1", "a quarter turn is exact", quarter_turns},
         {"transform.2", "a turn about any axis is right-handed", any_turn},
         {"transform.3", "look-at has x to the left, y up, z forward", look},
         {"transform.4", "look-at without up chooses as Mitsuba does", look_without_up},
         {"transform.5", "the first transform in the file is applied first", order},
         {"transform.6", "a mirror and a flattening transform are told, whatever the size",
          handedness})

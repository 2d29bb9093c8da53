// Contracts are in the header. Mitsuba's conventions, checked against Mitsuba 3.9.
#include "transform.h"

pm_transform pm_transform_identity(void)
{
    return pm_transform_scale(pm_vec(1.0, 1.0, 1.0));
}

pm_transform pm_transform_translate(pm_vec3 by)
{
    pm_transform moved = pm_transform_identity();
    moved.origin = by;
    return moved;
}

pm_transform pm_transform_scale(pm_vec3 by)
{
    return (pm_transform){
        {pm_vec(by.x, 0.0, 0.0), pm_vec(0.0, by.y, 0.0), pm_vec(0.0, 0.0, by.z)},
        pm_vec(0.0, 0.0, 0.0)};
}

/// Sine of an angle in degrees, exact at multiples of 90.
static double sine(double degrees)
{
    double turn = fmod(degrees, 360.0);
    if (fmod(turn, 90.0) == 0.0) {
        static const double quarter[7] = {1.0, 0.0, -1.0, 0.0, 1.0, 0.0, -1.0};
        return quarter[(int)(turn / 90.0) + 3];
    }
    return sin(turn * (PM_PI / 180.0));
}

/// Turns `v` about the unit vector `n` (Rodrigues' formula).
static pm_vec3 turn(pm_vec3 v, pm_vec3 n, double s, double c)
{
    pm_vec3 kept = pm_vec_scale(n, pm_vec_dot(n, v) * (1.0 - c));
    return pm_vec_along(pm_vec_along(kept, v, c), pm_vec_cross(n, v), s);
}

pm_transform pm_transform_rotate(pm_vec3 axis, double degrees)
{
    // Divided by its reach first, so that a tiny or huge axis neither vanishes nor overflows.
    pm_vec3 n = pm_vec_normalize(pm_vec_scale(axis, 1.0 / pm_vec_reach(axis)));
    double s = sine(degrees);
    double c = fmod(degrees, 90.0) == 0.0 ? sine(fmod(degrees, 360.0) + 90.0)
                                          : cos(fmod(degrees, 360.0) * (PM_PI / 180.0));
    pm_transform turned = pm_transform_identity();
    for (int i = 0; i < 3; i++) {
        turned.column[i] = turn(turned.column[i], n, s, c);
    }
    return turned;
}

pm_transform pm_transform_look_at(pm_vec3 origin, pm_vec3 target, pm_vec3 up)
{
    pm_vec3 view = pm_vec_normalize(pm_vec_sub(target, origin));
    if (pm_vec_reach(up) == 0.0) {
        up = pm_frame_around(view).s;
    }
    pm_vec3 left = pm_vec_normalize(pm_vec_cross(up, view));
    return (pm_transform){{left, pm_vec_cross(view, left), view}, origin};
}

pm_transform pm_transform_then(const pm_transform *first, const pm_transform *second)
{
    pm_transform both;
    for (int i = 0; i < 3; i++) {
        both.column[i] = pm_transform_vector(second, first->column[i]);
    }
    both.origin = pm_vec_add(pm_transform_vector(second, first->origin), second->origin);
    return both;
}

pm_vec3 pm_transform_vector(const pm_transform *transform, pm_vec3 v)
{
    const pm_vec3 *column = transform->column;
    return pm_vec_along(pm_vec_along(pm_vec_scale(column[0], v.x), column[1], v.y), column[2],
                        v.z);
}

double pm_transform_handedness(const pm_transform *transform)
{
    pm_vec3 unit[3];
    for (int i = 0; i < 3; i++) {
        double reach = pm_vec_reach(transform->column[i]);
        if (reach == 0.0) {
            return 0.0;
        }
        unit[i] = pm_vec_normalize(pm_vec_scale(transform->column[i], 1.0 / reach));
    }
    double volume = pm_vec_dot(pm_vec_cross(unit[0], unit[1]), unit[2]);
    return fabs(volume) < 1e-12 ? 0.0 : volume;
}

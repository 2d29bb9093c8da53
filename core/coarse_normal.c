// The sphere is folded onto the square |x|, |y| <= 1 and that onto a 63 x 63 lattice, whose
// middle and rims are lattice lines, so that the axes are exact.
// @source Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
//         JCGT 3(2), 2014
#include "coarse_normal.h"

#include <stdlib.h>

#define LATTICE 31      // lattice coordinates run from -31 to 31
#define NO_NORMAL 4095u // the lattice ends at 62 * 64 + 62

/// The direction, not of unit length, of a lattice point; the lower half of the sphere lies in
/// the square's corners, outside |x| + |y| = 31.
static pm_vec3 unfold(int x, int y)
{
    int z = LATTICE - abs(x) - abs(y);
    if (z >= 0) {
        return pm_vec(x, y, z);
    }
    int folded_x = (LATTICE - abs(y)) * (x < 0 ? -1 : 1);
    int folded_y = (LATTICE - abs(x)) * (y < 0 ? -1 : 1);
    return pm_vec(folded_x, folded_y, z);
}

/// Where `normal` lies in the square, in lattice steps.
static void fold(pm_vec3 normal, double *x, double *y)
{
    double sum = fabs(normal.x) + fabs(normal.y) + fabs(normal.z);
    double upper_x = normal.x / sum;
    double upper_y = normal.y / sum;
    bool lower = normal.z < 0.0;
    *x = LATTICE * (lower ? copysign(1.0 - fabs(upper_y), upper_x) : upper_x);
    *y = LATTICE * (lower ? copysign(1.0 - fabs(upper_x), upper_y) : upper_y);
}

uint16_t pm_normal_encode(pm_vec3 normal)
{
    if (normal.x == 0.0 && normal.y == 0.0 && normal.z == 0.0) {
        return NO_NORMAL;
    }
    double x;
    double y;
    fold(normal, &x, &y);

    // Rounding each coordinate is not nearest on the sphere: try the cell's four corners.
    int best_x = 0;
    int best_y = 0;
    double best = -2.0;
    for (int corner = 0; corner < 4; corner++) {
        int corner_x = (int)fmin(floor(x) + (corner & 1), LATTICE);
        int corner_y = (int)fmin(floor(y) + (corner >> 1), LATTICE);
        double cosine = pm_vec_dot(pm_vec_normalize(unfold(corner_x, corner_y)), normal);
        if (cosine > best) {
            best = cosine;
            best_x = corner_x;
            best_y = corner_y;
        }
    }
    return (uint16_t)((best_x + LATTICE) * 64 + best_y + LATTICE);
}

pm_vec3 pm_normal_decode(uint16_t code)
{
    if (code == NO_NORMAL) {
        return pm_vec(0.0, 0.0, 0.0);
    }
    return pm_vec_normalize(unfold(code / 64 - LATTICE, code % 64 - LATTICE));
}

bool pm_normal_within(uint16_t code, pm_vec3 direction, double least)
{
    if (code == NO_NORMAL) {
        return true;
    }
    pm_vec3 unscaled = unfold(code / 64 - LATTICE, code % 64 - LATTICE);
    double along = pm_vec_dot(unscaled, direction);
    // Most are clear without the root: lattice points are 31 / sqrt(3) to 31 long.
    bool clear = along >= 0.0 && least <= 0.0;
    return clear || along >= least * pm_vec_length(unscaled);
}

// Evenly spread points of the unit square, for any number of them: a lattice with a random
// shift. Each single point is uniform, so means over them are unbiased; together they leave no
// gaps.
#ifndef PM_LATTICE_H
#define PM_LATTICE_H

#include <math.h>
#include <stdint.h>

/// Point `i` of `count`, in [0,1)^2. `shift` in [0,1)^2 is shared by all points of a set.
/// The second coordinate steps by the golden ratio.
static inline void pm_lattice_point(const double shift[2], uint32_t i, uint32_t count,
                                    double u[2])
{
    double step = 0.61803398874989485 * i + shift[1];
    double across = (double)i / count + shift[0];
    u[0] = across - floor(across);
    u[1] = step - floor(step);
}

/// Greatest common divisor.
static inline uint32_t pm_lattice_common(uint32_t a, uint32_t b)
{
    while (b != 0) {
        uint32_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

/// A third coordinate: the `count` points lie at equal distances of [0,1), begun at `shift`, in
/// an order that goes with neither of the other two.
static inline double pm_lattice_apart(double shift, uint32_t i, uint32_t count)
{
    uint32_t step = count / 4;
    while (pm_lattice_common(step, count) != 1) {
        step++;
    }
    double place = (double)((uint64_t)i * step % count) / count + shift;
    return place - floor(place);
}

#endif

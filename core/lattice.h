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

#endif

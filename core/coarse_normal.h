// Surface normals in the 12 bits that a stored photon has left for them.
#ifndef PM_COARSE_NORMAL_H
#define PM_COARSE_NORMAL_H

#include "vec.h"

#include <stdbool.h>
#include <stdint.h>

/// A unit normal in 12 bits (octahedral, 6 + 6; axes are exact, others to 2.7 degrees) and
/// back. Code 4095 stands for no normal, the zero vector.
uint16_t pm_normal_encode(pm_vec3 normal);
pm_vec3 pm_normal_decode(uint16_t code);

/// Whether the cosine between a coded normal and the unit `direction` is at least `least`; no
/// normal always is. Cheaper than decoding.
bool pm_normal_within(uint16_t code, pm_vec3 direction, double least);

#endif

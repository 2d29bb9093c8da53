// Rays counted in closed surfaces by what went wrong with them, for the tests of the offset
// rule.
#ifndef PM_LEAKS_H
#define PM_LEAKS_H

#include "rng.h"
#include "vec.h"

/// Under the sanitizers, which slow a ray about tenfold, tests shoot one ray of so many.
#if defined(__SANITIZE_ADDRESS__)
#define PM_LEAKS_THINNED 20
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PM_LEAKS_THINNED 20
#endif
#endif
#ifndef PM_LEAKS_THINNED
#define PM_LEAKS_THINNED 1
#endif

/// The sizes of scenes to try [m].
extern const double pm_leaks_sizes[3];

/// What went wrong, and in how many rays.
typedef struct {
    long rays;
    long leaks; // nothing met inside a closed surface
    long again; // the flat primitive, or the sphere from outside, that the ray has just left
    long wrong; // a surface met from a side where the ray cannot be, or out of turn
} pm_leaks;

/// Fails the test if any ray went wrong, or if there were fewer than `rays`.
void pm_leaks_check(const pm_leaks *sum, double size, long rays);

/// A unit vector on the side of `normal`: a fifth of them grazing, with cosines from 1e-9 to 1.
pm_vec3 pm_leaks_leaving(pm_vec3 normal, pm_rng *rng);

#endif

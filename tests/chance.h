// Bounds for tests that draw random numbers: 5 standard deviations of a known variance. Seeds
// are fixed, so a test that passes goes on passing.
#ifndef PM_CHANCE_H
#define PM_CHANCE_H

#include <stddef.h>
#include <stdint.h>

/// How far the mean of `count` numbers of this variance may lie from its expectation.
double pm_chance_bound(double variance, double count);

/// Ends the test as failed when `counts` do not fit `expected` by chi-square: too far off, or
/// too close to be random, each less likely than 5 standard deviations of a normal variable.
/// A cell that expects 0 must hold 0.
void pm_chance_fit(const char *file, int line, const char *what, const uint64_t *counts,
                   const double *expected, size_t cells);

/// The same with every cell equally likely.
void pm_chance_even(const char *file, int line, const char *what, const uint64_t *counts,
                    size_t cells);

#define CHECK_FIT(counts, expected, cells)                                                     \
    pm_chance_fit(__FILE__, __LINE__, #counts, (counts), (expected), (cells))
#define CHECK_EVEN(counts, cells) pm_chance_even(__FILE__, __LINE__, #counts, (counts), (cells))

#endif

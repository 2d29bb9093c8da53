// Wall-clock time, for reports.
#ifndef PM_CLOCK_H
#define PM_CLOCK_H

#include <time.h>

/// Seconds since some fixed moment; never goes back.
static inline double pm_seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif

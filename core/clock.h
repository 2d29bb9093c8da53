// Wall-clock and CPU time, for reports.
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

/// CPU seconds of all threads of this process so far.
static inline double pm_cpu_seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif

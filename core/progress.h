// A progress bar on standard error, when that is a terminal; nothing otherwise.
#ifndef PM_PROGRESS_H
#define PM_PROGRESS_H

#include <stdint.h>

typedef struct {
    const char *what; // "tracing"; NULL: no terminal, show nothing
    uint64_t total;
    uint64_t done;
    int shown; // per cent on the screen
} pm_progress;

/// Starts a bar for `total` steps. `what` must outlive it.
pm_progress pm_progress_begin(const char *what, uint64_t total);

/// Counts `steps` more as done. One thread at a time.
void pm_progress_add(pm_progress *progress, uint64_t steps);

/// Wipes the bar.
void pm_progress_end(pm_progress *progress);

#endif

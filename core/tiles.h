// A picture done tile by tile on all threads. A pixel may depend on its place and on read-only
// data alone, so the picture does not depend on which thread did which tile.
#ifndef PM_TILES_H
#define PM_TILES_H

#include "status.h"

/// What is done. `context` is shared and read only while tiles are done; each thread has a
/// worker.
typedef struct {
    const char *what; // for the progress bar
    int width, height;
    void *context;
    /// Makes a thread's worker. @param worker [out]; released by `end` also when this fails
    pm_status (*begin)(const void *context, void **worker);
    pm_status (*pixel)(const void *context, void *worker, int x, int y);
    /// Takes a worker's counts and frees it. One thread at a time, in no fixed order.
    void (*end)(void *context, void *worker);
} pm_tiles;

/// Does every pixel once.
/// @return the first failure of begin or pixel; PM_ESTOPPED on SIGINT
pm_status pm_tiles_run(const pm_tiles *tiles);

#endif

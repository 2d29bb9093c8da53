// Numbered things, such as photons, done on all threads and handed over in order: whoever takes
// a chunk has taken all chunks before it, so what comes of it does not depend on how many
// threads there are.
#ifndef PM_CHUNKS_H
#define PM_CHUNKS_H

#include "progress.h"
#include "status.h"

#define PM_CHUNK 1024u // things in a chunk; the last one may have fewer

/// What is done. `context` is shared; each thread has a worker.
typedef struct {
    uint64_t count;        // of things
    pm_progress *progress; // counts them
    void *context;
    /// Makes a thread's worker. @param worker [out]; released by `end` also when this fails
    pm_status (*begin)(const void *context, void **worker);
    /// Does the things `first` .. `first + count - 1`, at most PM_CHUNK. The worker keeps what
    /// comes of it until it is taken.
    pm_status (*work)(const void *context, void *worker, uint64_t first, uint32_t count);
    /// Takes what the worker has. One thread at a time, chunk after chunk.
    pm_status (*take)(void *context, const void *worker);
    /// Frees a worker.
    void (*end)(void *worker);
} pm_chunks;

/// Does everything once. After a failure nothing more is taken.
/// @return the first failure, in the order of the chunks; PM_ESTOPPED on SIGINT
pm_status pm_chunks_run(const pm_chunks *chunks);

#endif

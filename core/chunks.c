// Chunks are dealt out one by one, as threads ask; after a failure the rest is passed over.
#include "chunks.h"

#include "interrupt.h"

#include <string.h>

/// How it stands; written by one thread at a time, while it has its turn.
typedef struct {
    pm_status status;
    char message[1024];
} pm_chunks_state;

static void take_chunk(const pm_chunks *chunks, const void *worker, uint32_t count,
                       pm_status status, pm_chunks_state *state)
{
    if (state->status != PM_OK) {
        return;
    }
    if (status == PM_OK) {
        status = chunks->take(chunks->context, worker);
    }
    if (status != PM_OK) {
        strncpy(state->message, pm_status_message(), sizeof state->message - 1);
#pragma omp atomic write
        state->status = status;
    }
    pm_progress_add(chunks->progress, count);
}

static pm_status do_chunk(const pm_chunks *chunks, void *worker, uint64_t first, uint32_t count)
{
    PM_TRY(pm_interrupt_check());
    return chunks->work(chunks->context, worker, first, count);
}

/// @param begun  how the making of the worker went
static void run_chunk(const pm_chunks *chunks, uint64_t first, void *worker, pm_status begun,
                      pm_chunks_state *state)
{
    uint64_t left = chunks->count - first;
    uint32_t count = left < PM_CHUNK ? (uint32_t)left : PM_CHUNK;
    pm_status status;
#pragma omp atomic read
    status = state->status;
    if (status == PM_OK) {
        status = begun == PM_OK ? do_chunk(chunks, worker, first, count) : begun;
    }
#pragma omp ordered
    take_chunk(chunks, worker, count, status, state);
}

pm_status pm_chunks_run(const pm_chunks *chunks)
{
    int64_t all = (int64_t)((chunks->count + PM_CHUNK - 1) / PM_CHUNK);
    pm_chunks_state state = {0};
#pragma omp parallel
    {
        pm_status_clear();
        void *worker = NULL;
        pm_status begun = chunks->begin(chunks->context, &worker);
#pragma omp for ordered schedule(dynamic, 1)
        for (int64_t chunk = 0; chunk < all; chunk++) {
            run_chunk(chunks, (uint64_t)chunk * PM_CHUNK, worker, begun, &state);
        }
        chunks->end(worker);
        pm_status_clear(); // the state has the message
    }
    return state.status == PM_OK ? PM_OK : pm_status_fail(state.status, "%s", state.message);
}

// Chunks come back in order, each once, whatever the threads do; the first failure is told.
#include "chunks.h"

#include "test.h"

#include <omp.h>
#include <stdbool.h>
#include <stdlib.h>

/// What comes of it: the sum of all things, and whether they came in order.
typedef struct {
    uint64_t fails_at; // the thing that cannot be done
    uint64_t next, sum, chunks;
    bool in_order;
} record;

typedef struct {
    uint64_t first, sum;
    uint32_t count;
} worker;

static pm_status begin(const void *context, void **made)
{
    (void)context;
    *made = calloc(1, sizeof(worker));
    return *made != NULL ? PM_OK : PM_FAIL(PM_ENOMEM, "no memory for a worker");
}

static pm_status refuse(const void *context, void **made)
{
    (void)context;
    *made = NULL;
    return PM_FAIL(PM_ENOMEM, "no memory for a worker");
}

static pm_status work(const void *context, void *on, uint64_t first, uint32_t count)
{
    const record *all = context;
    *(worker *)on = (worker){.first = first, .count = count};
    for (uint64_t i = first; i < first + count; i++) {
        if (i >= all->fails_at) {
            return PM_FAIL(PM_EINPUT, "thing %llu", (unsigned long long)i);
        }
        ((worker *)on)->sum += i;
    }
    return PM_OK;
}

static pm_status take(void *context, const void *from)
{
    record *all = context;
    const worker *done = from;
    all->in_order = all->in_order && done->first == all->next;
    all->next = done->first + done->count;
    all->sum += done->sum;
    all->chunks++;
    return PM_OK;
}

static pm_status run(uint64_t count, uint64_t fails_at, record *all)
{
    pm_progress progress = pm_progress_begin("test", count);
    *all = (record){.fails_at = fails_at, .in_order = true};
    pm_chunks chunks = {count, &progress, all, begin, work, take, free};
    pm_status status = pm_chunks_run(&chunks);
    pm_progress_end(&progress);
    return status;
}

static void all_are_taken_in_order(void)
{
    const uint64_t counts[] = {0, 1, PM_CHUNK, PM_CHUNK + 1, 40 * PM_CHUNK - 1};
    int threads = omp_get_max_threads();
    for (int i = 0; i < 5; i++) {
        for (int t = 1; t <= 7; t += 3) {
            record all;
            omp_set_num_threads(t);
            CHECK_OK(run(counts[i], UINT64_MAX, &all));
            CHECK(all.in_order && all.next == counts[i]);
            CHECK(all.sum == counts[i] * (counts[i] - (counts[i] > 0)) / 2);
            CHECK(all.chunks == (counts[i] + PM_CHUNK - 1) / PM_CHUNK);
        }
    }
    omp_set_num_threads(threads);
}

// Later chunks fail too, and perhaps sooner.
static void the_first_failure_is_told(void)
{
    int threads = omp_get_max_threads();
    for (int t = 1; t <= 7; t += 3) {
        record all;
        omp_set_num_threads(t);
        CHECK_FAILS(run(40 * PM_CHUNK, 5 * PM_CHUNK + 7, &all), PM_EINPUT, "thing 5127");
        CHECK(all.in_order && all.chunks == 5);
    }
    omp_set_num_threads(threads);
}

static void a_worker_that_cannot_be_made_is_told(void)
{
    record all = {.fails_at = UINT64_MAX};
    pm_progress progress = pm_progress_begin("test", 2 * PM_CHUNK);
    pm_chunks chunks = {2 * PM_CHUNK, &progress, &all, refuse, work, take, free};
    CHECK_FAILS(pm_chunks_run(&chunks), PM_ENOMEM, "no memory for a worker");
    pm_progress_end(&progress);
    CHECK(all.chunks == 0);
}

PM_TESTS({"chunks.1", "everything is done once and taken in order by any number of threads",
          all_are_taken_in_order},
         {"chunks.2", "the first failure in the order of the chunks is the one that is told",
          the_first_failure_is_told},
         {"chunks.3", "a thread that finds no memory ends the work",
          a_worker_that_cannot_be_made_is_told})

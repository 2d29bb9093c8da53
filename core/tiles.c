// Tiles are dealt out one by one, as threads ask; after a failure the rest is passed over.
#include "tiles.h"

#include "interrupt.h"
#include "progress.h"

#include <stddef.h>
#include <string.h>

#define TILE 16

/// How it stands; written by one thread at a time.
typedef struct {
    pm_progress progress;
    pm_status status;
    char message[1024];
} pm_tiles_state;

static pm_status do_tile(const pm_tiles *tiles, void *worker, int tile)
{
    int across = (tiles->width + TILE - 1) / TILE;
    int left = tile % across * TILE;
    int top = tile / across * TILE;
    for (int y = top; y < top + TILE && y < tiles->height; y++) {
        for (int x = left; x < left + TILE && x < tiles->width; x++) {
            PM_TRY(tiles->pixel(tiles->context, worker, x, y));
        }
    }
    return pm_interrupt_check();
}

static void tile_done(pm_tiles_state *state, pm_status status)
{
    pm_progress_add(&state->progress, 1);
    if (status != PM_OK && state->status == PM_OK) {
        state->status = status;
        strncpy(state->message, pm_status_message(), sizeof state->message - 1);
    }
}

static void do_all(const pm_tiles *tiles, int count, pm_tiles_state *state)
{
#pragma omp parallel
    {
        pm_status_clear();
        void *worker = NULL;
        pm_status begun = tiles->begin(tiles->context, &worker);
#pragma omp for schedule(dynamic, 1)
        for (int tile = 0; tile < count; tile++) {
            pm_status seen;
#pragma omp atomic read
            seen = state->status;
            if (seen == PM_OK) {
                pm_status status = begun == PM_OK ? do_tile(tiles, worker, tile) : begun;
#pragma omp critical
                tile_done(state, status);
            }
        }
#pragma omp critical
        tiles->end(tiles->context, worker);
    }
}

pm_status pm_tiles_run(const pm_tiles *tiles)
{
    int across = (tiles->width + TILE - 1) / TILE;
    int down = (tiles->height + TILE - 1) / TILE;
    pm_tiles_state state = {0};
    state.progress = pm_progress_begin(tiles->what, (uint64_t)across * (uint64_t)down);
    do_all(tiles, across * down, &state);
    pm_progress_end(&state.progress);
    if (state.status != PM_OK) {
        pm_status_clear();
        return pm_status_fail(state.status, "%s", state.message);
    }
    return PM_OK;
}

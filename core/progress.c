// Redrawn only when the percentage changes, on one line that is wiped at the end.
#include "progress.h"

#include <stdio.h>
#include <unistd.h>

#define WIDTH 40

static void draw(const pm_progress *progress)
{
    int full = progress->shown * WIDTH / 100;
    fprintf(stderr, "\r%-10s [%.*s%*s] %3d %%", progress->what, full,
            "########################################", WIDTH - full, "", progress->shown);
    fflush(stderr);
}

pm_progress pm_progress_begin(const char *what, uint64_t total)
{
    pm_progress progress = {.total = total};
    if (total > 0 && isatty(STDERR_FILENO)) {
        progress.what = what;
        draw(&progress);
    }
    return progress;
}

void pm_progress_add(pm_progress *progress, uint64_t steps)
{
    progress->done += steps;
    if (progress->what == NULL) {
        return;
    }
    int percent = (int)(100.0 * (double)progress->done / (double)progress->total);
    percent = percent > 100 ? 100 : percent;
    if (percent != progress->shown) {
        progress->shown = percent;
        draw(progress);
    }
}

void pm_progress_end(pm_progress *progress)
{
    if (progress->what != NULL) {
        fprintf(stderr, "\r%*s\r", WIDTH + 20, "");
        progress->what = NULL;
    }
}

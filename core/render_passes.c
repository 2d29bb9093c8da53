// Only whole passes are ever saved: a pass that is interrupted or fails leaves the sums as they
// were. Whatever ends the work, the passes that are done are saved where they can be.
#include "render_passes.h"

#include "checkpoint.h"
#include "clock.h"
#include "exr.h"
#include "png.h"

#include <inttypes.h>

#define PAUSE 1.0  // [s] between two savings, at least
#define SHARE 20.0 // and this many times what saving takes

/// When something was saved last, and what that took.
typedef struct {
    double last, took; // [s]
} rhythm;

typedef struct {
    const pm_intersector *world;
    const pm_options *options;
    const pm_render_settings *settings;
    pm_progressive *progressive;
    pm_image *image;
    pm_eye_report *report;
    rhythm checkpoint, picture;
} job;

// --- saving ----------------------------------------------------------------------------------

static bool is_due(const rhythm *of)
{
    return pm_seconds_now() - of->last >= pm_most(PAUSE, SHARE * of->took);
}

static void note_saved(double start, rhythm *of)
{
    of->last = pm_seconds_now();
    of->took = of->last - start;
}

static pm_status save_checkpoint(job *j)
{
    double start = pm_seconds_now();
    if (j->options->checkpoint != NULL) {
        PM_TRY(pm_checkpoint_write(j->options->checkpoint, j->world->scene, j->settings,
                                   j->progressive));
    }
    note_saved(start, &j->checkpoint);
    return PM_OK;
}

static pm_status save_picture(job *j)
{
    double start = pm_seconds_now();
    pm_image_free(j->image);
    PM_TRY(pm_progressive_image(j->progressive, j->image, j->report));
    if (j->options->output != NULL) {
        PM_TRY(pm_exr_write(j->options->output, j->image));
    }
    if (j->options->png != NULL) {
        PM_TRY(pm_png_write(j->options->png, j->image, j->options->exposure));
    }
    note_saved(start, &j->picture);
    return PM_OK;
}

/// Checkpoint and picture; where one cannot be written, the other is there all the same.
static pm_status save_all(job *j)
{
    pm_status checkpoint = save_checkpoint(j);
    pm_status picture = save_picture(j);
    return checkpoint != PM_OK ? checkpoint : picture;
}

static pm_status save_what_is_due(job *j)
{
    if (is_due(&j->checkpoint)) {
        PM_TRY(save_checkpoint(j));
    }
    return is_due(&j->picture) ? save_picture(j) : PM_OK;
}

// --- passes ----------------------------------------------------------------------------------

static pm_status resume(job *j)
{
    const pm_options *options = j->options;
    if (!options->resume) {
        return PM_OK;
    }
    PM_TRY(
        pm_checkpoint_read(options->checkpoint, j->world->scene, j->settings, j->progressive));
    if (j->progressive->passes > options->passes) {
        return pm_status_fail(PM_EINPUT,
                              "%s: holds %" PRIu32 " passes, more than --passes %" PRIu32
                              ": ask for %" PRIu32 " or more",
                              options->checkpoint, j->progressive->passes, options->passes,
                              j->progressive->passes);
    }
    return PM_OK;
}

static pm_status do_passes(job *j, pm_render_maps *maps)
{
    j->checkpoint.last = j->picture.last = pm_seconds_now();
    while (j->progressive->passes < j->options->passes) {
        PM_TRY(pm_progressive_pass(j->world, j->settings, j->progressive, maps));
        if (j->progressive->passes < j->options->passes) {
            PM_TRY(save_what_is_due(j));
        }
    }
    return PM_OK;
}

/// After SIGINT: what there is, and how many passes that is.
static pm_status stop(job *j)
{
    uint32_t done = j->progressive->passes;
    pm_status_clear(); // it says that nothing was written
    if (done == 0) {
        return pm_status_fail(PM_ESTOPPED,
                              "stopped in the first of %" PRIu32
                              " passes: there is no picture yet; nothing was written",
                              j->options->passes);
    }
    PM_TRY(save_all(j));
    return pm_status_fail(PM_ESTOPPED,
                          "stopped after %" PRIu32 " of %" PRIu32
                          " passes: the picture is of %s %" PRIu32,
                          done, j->options->passes, done == 1 ? "this" : "these", done);
}

pm_status pm_render_passes(const pm_intersector *world, const pm_options *options,
                           const pm_render_settings *settings, pm_progressive *progressive,
                           pm_image *image, pm_eye_report *report)
{
    job j = {
        .world = world,
        .options = options,
        .settings = settings,
        .progressive = progressive,
        .image = image,
        .report = report,
    };
    PM_TRY(resume(&j));
    pm_render_maps maps = {0};
    pm_status status = do_passes(&j, &maps);
    pm_render_maps_free(&maps);
    if (status == PM_ESTOPPED) {
        return stop(&j);
    }
    pm_status saved = progressive->passes > 0 ? save_all(&j) : PM_OK;
    return status != PM_OK ? status : saved; // of two faults, the message is the first one's
}

// A progressive picture as a program makes it: pass after pass, saved on the way, stopped at
// any time.
#ifndef PM_RENDER_PASSES_H
#define PM_RENDER_PASSES_H

#include "options.h"
#include "progressive.h"

/// Does passes until there are options->passes of them, or SIGINT; with --resume from where the
/// checkpoint is. Checkpoint (--checkpoint) and pictures (-o, --png) are written whole, on the
/// way and at the end, so that each is always that of some number of whole passes: on the way
/// after a pass that ends 1 s or more after the last writing, and, so that writing takes a
/// twentieth of the time at most, 20 times as long after it as writing took.
///
/// @param progressive  [in, out] zero-initialised; free with pm_progressive_free() in any case
/// @param image        [out] the last picture; free with pm_image_free() in any case
/// @param report       [out] of all passes
/// @return PM_ESTOPPED on SIGINT, with a line that says how many passes the picture is of: they
///         are in the outputs, unless there are none; else what failed
pm_status pm_render_passes(const pm_intersector *world, const pm_options *options,
                           const pm_render_settings *settings, pm_progressive *progressive,
                           pm_image *image, pm_eye_report *report);

#endif

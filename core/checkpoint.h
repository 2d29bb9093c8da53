// The sums of a progressive picture on disk, so that work that was stopped, in whatever way,
// goes on where it was.
//
// Invariant: a file is either a whole checkpoint or not there: it is written beside and
// renamed. It names its version, the scene and every setting that the picture depends on, and
// ends with a checksum; one that was altered, cut, or belongs to other work is refused with a
// line that says which.
#ifndef PM_CHECKPOINT_H
#define PM_CHECKPOINT_H

#include "progressive.h"

/// Writes it. Every machine writes the same bytes: least significant first.
/// @param progressive  begun
/// @return PM_EIO
pm_status pm_checkpoint_write(const char *path, const pm_scene *scene,
                              const pm_render_settings *settings,
                              const pm_progressive *progressive);

/// Reads it.
/// @param progressive  [out] untouched unless PM_OK; free with pm_progressive_free()
/// @return PM_EIO; PM_EINPUT with a line for each setting that differs, or one that says what
///         is wrong with the file; PM_ENOMEM
pm_status pm_checkpoint_read(const char *path, const pm_scene *scene,
                             const pm_render_settings *settings, pm_progressive *progressive);

#endif

// What a checkpoint is of, as text: a line for the scene, the camera and each setting that the
// bytes of a picture depend on.
#ifndef PM_CHECKPOINT_TEXT_H
#define PM_CHECKPOINT_TEXT_H

#include "render.h"

#include <stddef.h>

#define PM_CHECKPOINT_TEXT_ROOM 2048

/// Prints it, zero-terminated: lines "NAME VALUE", NAME being the option's word where there is
/// one. One content has one text; numbers lose no bit.
/// @param text  [out] room for PM_CHECKPOINT_TEXT_ROOM
/// @return its length
size_t pm_checkpoint_text_print(const pm_scene *scene, const pm_render_settings *settings,
                                char *text);

/// Compares the text of a file with the one wanted.
/// @return PM_EINPUT with a line for each value that differs, both values in it; or with one
///         for the first name that is missing or too many
pm_status pm_checkpoint_text_compare(const char *path, const char *found, const char *wanted);

#endif

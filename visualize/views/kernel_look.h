// Kernels in pictures: the same word and colour in all of them.
#ifndef PM_KERNEL_LOOK_H
#define PM_KERNEL_LOOK_H

#include "colours.h"

#include <stdbool.h>

typedef struct {
    const char *name;  // in files; with the lecture's constants "-lecture" follows
    const char *words; // in pictures
    pm_colour colour;
} pm_kernel_look;

/// The look of a kernel, whichever its constants are; white and its own name for one that is
/// not known.
/// @param name  outlives the look
pm_kernel_look pm_kernel_look_of(const char *name);

/// Whether a name is that of a kernel with the lecture's constants.
bool pm_kernel_look_is_lecture(const char *name);

#endif

// Whole files or none: output is written beside its target and renamed when complete.
#ifndef PM_FILE_H
#define PM_FILE_H

#include "status.h"

#include <stdint.h>
#include <stdio.h>

typedef struct {
    FILE *stream;
    char *path;      // the target
    char *temporary; // what is written
} pm_file;

/// Opens a temporary file in the folder of `path`.
/// @return PM_EIO with a line naming `path`
pm_status pm_file_begin(const char *path, pm_file *file);

/// Flushes, closes and renames; on any failure (no room, too) the temporary file is gone.
pm_status pm_file_commit(pm_file *file);

/// Closes and removes what was written. Fine after a commit.
void pm_file_abandon(pm_file *file);

/// Removes the temporary files that are open in this process; for signal handlers and failing
/// exits (async-signal-safe).
void pm_file_abandon_all(void);

/// Size of a file that is to be read.
/// @param bytes  [out]
/// @return PM_EIO with a line when it is missing, a directory or no regular file
pm_status pm_file_size(const char *path, uint64_t *bytes);

#endif

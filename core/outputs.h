// The files a program is about to write, looked at before it works: minutes of tracing must not
// end at a folder that does not exist, nor in the scene that was read.
#ifndef PM_OUTPUTS_H
#define PM_OUTPUTS_H

#include "options.h"

/// Checks that every output named in `options` can be written, that no two are the same file,
/// and that none is a file that is read. Leaves nothing behind.
/// @return PM_EIO or PM_EINPUT with a line per fault
pm_status pm_outputs_check(const pm_options *options, const char *program);

#endif

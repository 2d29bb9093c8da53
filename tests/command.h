// Programs run by a line of text, with what such a run may leave behind.
#ifndef PM_COMMAND_H
#define PM_COMMAND_H

#include "test.h"

#include <sys/types.h>

/// Runs a program of this build: "render {S} -k 5 -o {O}". Words are separated by blanks; in
/// them {S} stands for `scene`, {O} for `output`.
pm_test_ran pm_command_run(const char *line, const char *scene, const char *output);

/// Starts such a run in the test's folder and does not wait for it; what it says goes into
/// these files.
pid_t pm_command_start(const char *line, const char *scene, const char *output, const char *out,
                       const char *err);

/// As pm_command_run(), with SIGINT sent after `seconds`.
pm_test_ran pm_command_interrupt(const char *line, const char *scene, const char *output,
                                 double seconds);

/// A path in the test's folder; valid until the test ends.
const char *pm_command_path(const char *name);

/// Writes a text file into the test's folder and returns its path.
const char *pm_command_write(const char *name, const char *text);

/// Number of files in the test's folder.
int pm_command_count_files(void);

/// The run refused its input: exit code 2, nothing on standard output, on standard error lines
/// of which one contains `words`.
void pm_command_check_refusal(const char *line, const pm_test_ran *ran, const char *words);

#endif

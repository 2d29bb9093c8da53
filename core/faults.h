// The faults of one input file, gathered so that a user sees them in one go: at most
// PM_FAULTS_MAX lines, each `file:line: what is wrong, what to do`.
#ifndef PM_FAULTS_H
#define PM_FAULTS_H

#include "status.h"

#include <stdbool.h>

#define PM_FAULTS_MAX 20
#define PM_FAULTS_LINE 400 // bytes; a longer line is cut and ends in "..."

/// Zero-initialised it is valid and empty.
typedef struct {
    char lines[PM_FAULTS_MAX][PM_FAULTS_LINE];
    int count;
    pm_status worst; // PM_EINPUT, or what else pm_faults_fail() was told
} pm_faults;

/// Adds a line, unless there are PM_FAULTS_MAX already. `line` 0 leaves the number out.
/// Control characters are shown as '?', so that one fault stays one line.
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void
pm_faults_add(pm_faults *faults, const char *file, int line, const char *format, ...);

/// Records that the reason lies outside the input: PM_EIO or PM_ENOMEM.
void pm_faults_fail(pm_faults *faults, pm_status code);

/// No fault of any kind so far.
bool pm_faults_none(const pm_faults *faults);

/// Makes all lines one status message. PM_OK when there are none.
pm_status pm_faults_report(const pm_faults *faults);

#endif

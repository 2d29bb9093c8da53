// What the runner's parts share: the result of one test, and the process it runs in.
//
// A verdict counts only when it arrives through the test's pipe behind the right token: an
// early exit, a crash or text on standard output can never look like a pass. The runner trusts
// the code it tests not to be hostile; points are awarded elsewhere.
#ifndef PM_RUNNER_H
#define PM_RUNNER_H

#include "test.h"

#include <stdbool.h>
#include <stdio.h>
#include <sys/types.h>

typedef enum {
    PM_VERDICT_NONE,
    PM_VERDICT_PASSED,
    PM_VERDICT_FAILED,
    PM_VERDICT_SKIPPED,
    PM_VERDICT_TODO,
} pm_verdict;

typedef struct {
    const pm_test *test;
    const char *file;
    pm_verdict verdict;
    double seconds;
    char message[1024];
    char package[64];  // that a skipped test is missing
    char output[2048]; // the end of what a failed test printed
} pm_test_result;

/// A running test. Zero-initialised: free to be started.
typedef struct {
    pid_t pid; // also its process group; 0: not running
    int pipe;
    unsigned char token[8];
    double started, limit; // [s]
    bool timed_out;
    char folder[512]; // holds its files; made when the test asks for it
    char output[512]; // file that takes its standard output and error
    pm_test_result *result;
} pm_test_process;

/// Seconds of the monotonic clock.
double pm_process_now(void);

/// Forks `result->test`. `root` is an existing folder of this run, `number` differs for every
/// test, `limit` is in seconds. Returns false, with errno, when there is no process to be had.
bool pm_process_start(pm_test_process *process, pm_test_result *result, const char *root,
                      size_t number, double limit);

/// Takes new messages from the test and kills its group when its time is over. `scale`
/// multiplies limits that the test asks for itself.
void pm_process_watch(pm_test_process *process, double scale);

/// The test's process has ended with `status` (as waitpid() gives it): kills what is left of
/// its group, removes its files and settles the result. The process is free again.
void pm_process_finish(pm_test_process *process, int status, double scale);

/// In the child: runs the test and never returns.
#if defined(__GNUC__)
__attribute__((noreturn))
#endif
void pm_test_enter(const pm_test *test, int pipe, const unsigned char token[8],
                   const char *folder);

/// What travels through the pipe, in one write.
typedef struct {
    unsigned char token[8];
    pm_verdict verdict; // NONE: `limit` is a new time limit
    double limit;       // [s]
    char text[900];
    char package[64];
} pm_test_word;

/// Removes a folder and everything in it.
void pm_folder_remove(const char *path);

/// One result as a line (and its message, when there is something to say), or as TAP.
void pm_report_line(FILE *out, const pm_test_result *result);
void pm_report_tap(FILE *out, const pm_test_result *result, size_t number);

/// The skipped tests with the packages they miss, then `N passed, N failed`.
void pm_report_closing(FILE *out, const pm_test_result *results, size_t count, bool tap);

/// Everything as JSON. Returns false when the file cannot be written.
bool pm_report_json(const char *path, const pm_test_result *results, size_t count);

#endif

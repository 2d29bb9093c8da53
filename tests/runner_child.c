// Inside a test's process: running the test, and the checks that end it.
//
// Every way out writes one word through the pipe; a process that ends without a word has ended
// too early, whatever its exit status says.
#include "runner.h"

#include <limits.h>
#include <math.h>
#include <omp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

_Static_assert(sizeof(pm_test_word) <= PIPE_BUF, "a word must be written in one piece");

static struct {
    int pipe;
    unsigned char token[8];
    const char *folder;
} here;

static void say(pm_verdict verdict, const char *text, const char *package, double limit)
{
    pm_test_word word = {.verdict = verdict, .limit = limit};
    memcpy(word.token, here.token, sizeof word.token);
    snprintf(word.text, sizeof word.text, "%s", text);
    snprintf(word.package, sizeof word.package, "%s", package);
    ssize_t written = write(here.pipe, &word, sizeof word);
    if (written != (ssize_t)sizeof word) {
        _exit(3);
    }
}

void pm_test_enter(const pm_test *test, int pipe, const unsigned char token[8],
                   const char *folder)
{
    here.pipe = pipe;
    here.folder = folder;
    memcpy(here.token, token, sizeof here.token);
    omp_set_num_threads(1); // there is a test on every core already
    test->run();
    say(PM_VERDICT_PASSED, "", "", 0.0);
    exit(EXIT_SUCCESS); // not _exit(): the leak check of SAN=1 runs in an exit handler
}

// The runner reads the verdict from the pipe; exit handlers have nothing to add to it.
__attribute__((noreturn)) static void leave(pm_verdict verdict, const char *text,
                                            const char *package)
{
    say(verdict, text, package, 0.0);
    fflush(NULL);
    _exit(EXIT_FAILURE);
}

void pm_test_fail(const char *file, int line, const char *format, ...)
{
    char text[sizeof((pm_test_word *)0)->text];
    int used = snprintf(text, sizeof text, "%s:%d: ", file, line);
    size_t start = used < 0 ? 0 : (size_t)used;
    if (start < sizeof text) {
        va_list arguments;
        va_start(arguments, format);
        vsnprintf(text + start, sizeof text - start, format, arguments);
        va_end(arguments);
    }
    leave(PM_VERDICT_FAILED, text, "");
}

void pm_test_skip(const char *reason, const char *package)
{
    leave(PM_VERDICT_SKIPPED, reason, package);
}

void pm_test_limit(double seconds)
{
    say(PM_VERDICT_NONE, "", "", seconds);
}

void pm_test_near(const char *file, int line, const char *what, double got, double want,
                  double tolerance)
{
    if (!(fabs(got - want) <= tolerance)) {
        pm_test_fail(file, line, "%s: got %.17g, want %.17g, tolerance %.3g", what, got, want,
                     tolerance);
    }
}

static const char *name_status(pm_status status)
{
    static const char *const names[] = {"PM_OK",    "PM_EINPUT", "PM_ENOMEM",  "PM_EIO",
                                        "PM_ETODO", "PM_ELIMIT", "PM_ESTOPPED"};
    size_t index = (size_t)status;
    return index < sizeof names / sizeof names[0] ? names[index] : "an unknown status";
}

void pm_test_status(const char *file, int line, const char *what, pm_status got, pm_status want,
                    const char *message_part)
{
    const char *message = pm_status_message();
    if (got == PM_ETODO && want != PM_ETODO) {
        leave(PM_VERDICT_TODO, message, "");
    }
    if (got != want) {
        pm_test_fail(file, line, "%s: got %s, want %s; its message: %s", what, name_status(got),
                     name_status(want), message[0] ? message : "none");
    }
    if (want == PM_OK) {
        return;
    }
    if (message_part) {
        pm_test_text(file, line, "its message", message, message_part);
    }
    pm_status_clear();
}

void pm_test_text(const char *file, int line, const char *what, const char *got,
                  const char *part)
{
    if (!got || !strstr(got, part)) {
        pm_test_fail(file, line, "%s: \"%s\" is not in it; it reads: %s", what, part,
                     got ? got : "NULL");
    }
}

const char *pm_test_folder(void)
{
    struct stat there;
    if (stat(here.folder, &there) != 0 && mkdir(here.folder, 0700) != 0) {
        pm_test_fail(__FILE__, __LINE__, "cannot make the folder %s", here.folder);
    }
    return here.folder;
}

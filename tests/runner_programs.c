// Running programs from tests: their output drained while they run, killed at a time limit.
#include "runner.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#ifndef PM_TEST_BIN
#define PM_TEST_BIN "build/bin"
#endif
#ifndef PM_TEST_WITHOUT // programs this build leaves out, each between spaces
#define PM_TEST_WITHOUT ""
#endif

typedef struct {
    int end;
    char *text;
    size_t length, room;
} stream;

__attribute__((noreturn)) static void become_program(const char *const *argv, int out, int err)
{
    int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    execv(argv[0], (char *const *)(uintptr_t)argv);
    dprintf(STDERR_FILENO, "%s: %s\n", argv[0], strerror(errno));
    _exit(127);
}

static pid_t launch(const char *const *argv, stream *out, stream *err)
{
    int out_ends[2];
    int err_ends[2];
    if (pipe(out_ends) != 0 || pipe(err_ends) != 0) {
        pm_test_fail(__FILE__, __LINE__, "no pipe: %s", strerror(errno));
    }
    fcntl(out_ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(err_ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(out_ends[1], F_SETFD, FD_CLOEXEC);
    fcntl(err_ends[1], F_SETFD, FD_CLOEXEC);
    pid_t pid = fork();
    if (pid == 0) {
        become_program(argv, out_ends[1], err_ends[1]);
    }
    close(out_ends[1]);
    close(err_ends[1]);
    if (pid < 0) {
        pm_test_fail(__FILE__, __LINE__, "no process: %s", strerror(errno));
    }
    out->end = out_ends[0];
    err->end = err_ends[0];
    return pid;
}

// Takes what is there. At the end of the stream, `end` becomes -1, which poll() passes over.
static void drain(stream *from)
{
    if (from->length + 4096 > from->room) {
        from->room = 2 * from->room + 8192;
        char *larger = realloc(from->text, from->room);
        if (!larger) {
            pm_test_fail(__FILE__, __LINE__, "no memory for a program's output");
        }
        from->text = larger;
    }
    ssize_t got = read(from->end, from->text + from->length, 4095);
    if (got <= 0) {
        close(from->end);
        from->end = -1;
        got = 0;
    }
    from->length += (size_t)got;
    from->text[from->length] = '\0';
}

// Reads both streams to their ends; kills the program when the time is over.
static void follow(pid_t pid, stream *out, stream *err, double deadline)
{
    while (out->end >= 0 || err->end >= 0) {
        double left = deadline - pm_process_now();
        struct pollfd ends[] = {{.fd = out->end, .events = POLLIN},
                                {.fd = err->end, .events = POLLIN}};
        int ready = left > 0.0 ? poll(ends, 2, (int)(left * 1000.0) + 1) : 0;
        if (ready == 0) {
            kill(pid, SIGKILL);
            return;
        }
        if (ends[0].revents) {
            drain(out);
        }
        if (ends[1].revents) {
            drain(err);
        }
    }
}

static int wait_for(pid_t pid)
{
    int status = 0;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

pm_test_ran pm_test_run(const char *const *argv, double seconds)
{
    stream out = {.end = -1, .text = calloc(1, 1)};
    stream err = {.end = -1, .text = calloc(1, 1)};
    pid_t pid = launch(argv, &out, &err);
    follow(pid, &out, &err, pm_process_now() + seconds);
    int exit_code = wait_for(pid);
    for (int i = 0; i < 2; ++i) {
        int end = i ? err.end : out.end;
        if (end >= 0) {
            close(end);
        }
    }
    return (pm_test_ran){.exit_code = exit_code, .out = out.text, .err = err.text};
}

void pm_test_ran_free(pm_test_ran *ran)
{
    free(ran->out);
    free(ran->err);
    *ran = (pm_test_ran){0};
}

const char *pm_test_program(const char *name)
{
    static char path[1024];
    char word[80];
    snprintf(word, sizeof word, " %s ", name);
    if (strstr(PM_TEST_WITHOUT, word)) {
        pm_test_skip("this build leaves the program out, because VTK is missing",
                     "libvtk9-dev");
    }
    snprintf(path, sizeof path, "%s/%s", PM_TEST_BIN, name);
    if (access(path, X_OK) != 0) {
        pm_test_fail(__FILE__, __LINE__, "%s is not built; `make all` builds it", path);
    }
    return path;
}

// One test's process, seen from the runner: fork, words through the pipe, time limit, verdict.
//
// A test's process leads a group of its own, and the whole group gets SIGKILL, which cannot be
// caught, when the time is over and again when the test has ended. Its end is learned from
// waitpid(), never from the end of the pipe, which a process left behind may hold open.
#include "runner.h"

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

double pm_process_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void redirect(int descriptor, const char *path, int flags)
{
    int opened = open(path, flags, 0600);
    if (opened < 0 || dup2(opened, descriptor) < 0) {
        _exit(3);
    }
    close(opened);
}

__attribute__((noreturn)) static void become_test(const pm_test_process *process, int pipe_end)
{
    setpgid(0, 0);
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    redirect(STDIN_FILENO, "/dev/null", O_RDONLY);
    redirect(STDOUT_FILENO, process->output, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND);
    dup2(STDOUT_FILENO, STDERR_FILENO);
    pm_test_enter(process->result->test, pipe_end, process->token, process->folder);
}

bool pm_process_start(pm_test_process *process, pm_test_result *result, const char *root,
                      size_t number, double limit)
{
    int ends[2];
    *process = (pm_test_process){.result = result, .limit = limit};
    snprintf(process->folder, sizeof process->folder, "%s/%zu", root, number);
    snprintf(process->output, sizeof process->output, "%s/%zu.out", root, number);
    if (getrandom(process->token, sizeof process->token, 0) < 0 || pipe(ends) != 0) {
        return false;
    }
    fcntl(ends[0], F_SETFD, FD_CLOEXEC);
    fcntl(ends[1], F_SETFD, FD_CLOEXEC);
    fcntl(ends[0], F_SETFL, O_NONBLOCK);
    fflush(NULL);
    process->started = pm_process_now();
    pid_t pid = fork();
    if (pid == 0) {
        become_test(process, ends[1]);
    }
    close(ends[1]);
    if (pid < 0) {
        close(ends[0]);
        return false;
    }
    setpgid(pid, pid); // here as well: whoever comes first
    process->pid = pid;
    process->pipe = ends[0];
    return true;
}

static void hear(pm_test_process *process, const pm_test_word *word, double scale)
{
    pm_test_result *result = process->result;
    if (memcmp(word->token, process->token, sizeof word->token) != 0) {
        return;
    }
    if (word->verdict == PM_VERDICT_NONE) {
        process->limit = word->limit * scale;
        return;
    }
    if (result->verdict == PM_VERDICT_FAILED) {
        return; // a child of the test has failed; what its parent says cannot mend that
    }
    result->verdict = word->verdict;
    snprintf(result->message, sizeof result->message, "%s", word->text);
    snprintf(result->package, sizeof result->package, "%s", word->package);
}

static void listen(pm_test_process *process, double scale)
{
    pm_test_word word;
    while (read(process->pipe, &word, sizeof word) == (ssize_t)sizeof word) {
        hear(process, &word, scale);
    }
}

void pm_process_watch(pm_test_process *process, double scale)
{
    listen(process, scale);
    if (!process->timed_out && pm_process_now() - process->started > process->limit) {
        process->timed_out = true;
        kill(-process->pid, SIGKILL);
    }
}

static void fail(pm_test_result *result, const char *before, double number, const char *after)
{
    result->verdict = PM_VERDICT_FAILED;
    snprintf(result->message, sizeof result->message, "%s %.4g%s", before, number, after);
}

static void judge(const pm_test_process *process, int status)
{
    pm_test_result *result = process->result;
    char name[80] = "";
    if (process->timed_out) {
        fail(result, "did not finish in", process->limit, " s");
    } else if (WIFSIGNALED(status)) {
        snprintf(name, sizeof name, " (%s)", strsignal(WTERMSIG(status)));
        fail(result, "crashed by signal", WTERMSIG(status), name);
    } else if (result->verdict == PM_VERDICT_NONE) {
        fail(result, "ended the program before the test finished, with exit status",
             WEXITSTATUS(status), "");
    } else if (result->verdict == PM_VERDICT_PASSED && WEXITSTATUS(status) != 0) {
        fail(result, "finished, but its process then ended with exit status",
             WEXITSTATUS(status), " (a sanitizer's report, or an exit handler)");
    }
}

// The end of what the test printed, for the report of a failure.
static void keep_output(const pm_test_process *process)
{
    pm_test_result *result = process->result;
    FILE *file = fopen(process->output, "rb");
    if (!file) {
        return;
    }
    long keep = (long)sizeof result->output - 1;
    if (fseek(file, -keep, SEEK_END) != 0) {
        rewind(file);
    }
    size_t length = fread(result->output, 1, (size_t)keep, file);
    result->output[length] = '\0';
    fclose(file);
}

void pm_process_finish(pm_test_process *process, int status, double scale)
{
    kill(-process->pid, SIGKILL);
    listen(process, scale);
    process->result->seconds = pm_process_now() - process->started;
    judge(process, status);
    if (process->result->verdict == PM_VERDICT_FAILED) {
        keep_output(process);
    }
    close(process->pipe);
    unlink(process->output);
    pm_folder_remove(process->folder);
    process->pid = 0;
}

static int remove_entry(const char *path, const struct stat *about, int kind, struct FTW *place)
{
    (void)about;
    (void)kind;
    (void)place;
    return remove(path);
}

void pm_folder_remove(const char *path)
{
    nftw(path, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
}

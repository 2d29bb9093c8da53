// What surrounds every main: help, faults, exit codes, SIGINT, and a bar that stays off pipes.
#include "file.h"
#include "interrupt.h"
#include "program.h"
#include "progress.h"
#include "test.h"

#include <omp.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static const pm_options_program program = {
    .name = "demo",
    .does = "Shows.",
    .positional = "SCENE",
    .positional_least = 1,
    .positional_most = 1,
    .options = "n",
};

static const char *path_of(const char *name)
{
    static char path[4096];
    snprintf(path, sizeof path, "%s/%s", pm_test_folder(), name);
    return path;
}

// Standard output or error of this test's process, from now on in a file.
static void redirect(FILE *stream, const char *name)
{
    CHECK(freopen(path_of(name), "w", stream) != NULL);
}

static void check_file(FILE *stream, const char *name, const char *part)
{
    char text[8192] = "";
    fflush(stream);
    FILE *file = fopen(path_of(name), "r");
    CHECK(file != NULL);
    size_t length = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[length] = '\0';
    CHECK_CONTAINS(text, part);
}

static bool start(const char *word, pm_options *options, int *code)
{
    static char name[] = "demo";
    static char text[64];
    static char more[] = "scene.xml";
    static char *argv[] = {name, text, more, NULL};
    snprintf(text, sizeof text, "%s", word);
    return pm_program_start(3, argv, &program, options, code);
}

static void good_lines_start_and_bad_ones_end(void)
{
    pm_options options;
    int code = -1;
    CHECK(start("--threads=3", &options, &code));
    CHECK(omp_get_max_threads() == 3 && code == -1);
    redirect(stderr, "err");
    CHECK(!start("--bogus", &options, &code));
    CHECK(code == 2);
    check_file(stderr, "err", "demo: unknown option --bogus");
}

static void help_goes_to_standard_output(void)
{
    pm_options options;
    int code = -1;
    redirect(stdout, "out");
    CHECK(!start("--help", &options, &code));
    CHECK(code == 0);
    check_file(stdout, "out", "usage: demo SCENE [options]");
}

static void the_end_prints_the_message_and_tidies(void)
{
    redirect(stderr, "err");
    pm_file file;
    CHECK_OK(pm_file_begin(path_of("half"), &file));
    char temporary[4096];
    snprintf(temporary, sizeof temporary, "%s", file.temporary);
    CHECK(pm_program_end(pm_status_fail(PM_EINPUT, "a.xml:3: wrong")) == 2);
    check_file(stderr, "err", "a.xml:3: wrong\n");
    CHECK(access(temporary, F_OK) != 0);
    pm_file_abandon(&file);
    CHECK(pm_program_end(PM_ESTOPPED) == 130);
    CHECK(pm_program_end(PM_OK) == 0);
}

static void lost_output_is_a_failure(void)
{
    redirect(stderr, "err");
    CHECK(freopen("/dev/full", "w", stdout) != NULL);
    printf("something");
    CHECK(pm_program_end(PM_OK) == 2);
    check_file(stderr, "err", "standard output: cannot be written");
}

static void an_interrupt_is_a_question(void)
{
    pm_interrupt_catch();
    CHECK(!pm_interrupted());
    CHECK_OK(pm_interrupt_check());
    raise(SIGINT);
    CHECK(pm_interrupted());
    CHECK_FAILS(pm_interrupt_check(), PM_ESTOPPED, "stopped");
}

static void a_second_interrupt_does_not_wait(void)
{
    pm_test_folder(); // made before the fork, so that both know it
    pid_t child = fork();
    CHECK(child >= 0);
    if (child == 0) {
        pm_file file;
        pm_interrupt_catch();
        if (pm_file_begin(path_of("half"), &file) != PM_OK) {
            _exit(3);
        }
        raise(SIGINT);
        raise(SIGINT);
        _exit(4);
    }
    int status;
    CHECK(waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 130);
    CHECK_THAT(rmdir(pm_test_folder()) == 0, "the unfinished file was left behind");
}

static void no_bar_in_a_pipe(void)
{
    redirect(stderr, "err");
    pm_progress bar = pm_progress_begin("tracing", 10);
    CHECK(bar.what == NULL);
    for (int i = 0; i < 10; i++) {
        pm_progress_add(&bar, 1);
    }
    pm_progress_end(&bar);
    CHECK(bar.done == 10);
    fflush(stderr);
    CHECK(ftell(stderr) == 0);
}

PM_TESTS({"program.1", "a good command line starts the work, a bad one ends with 2",
          good_lines_start_and_bad_ones_end},
         {"program.2", "--help goes to standard output and ends with 0",
          help_goes_to_standard_output},
         {"program.3", "the end prints the message, removes unfinished files, gives the code",
          the_end_prints_the_message_and_tidies},
         {"program.4", "output that nobody could take is a failure", lost_output_is_a_failure},
         {"interrupt.1", "SIGINT sets a flag that loops ask for", an_interrupt_is_a_question},
         {"interrupt.2", "a second SIGINT ends at once and leaves no half-written file",
          a_second_interrupt_does_not_wait},
         {"progress.1", "a pipe sees no progress bar", no_bar_in_a_pipe})

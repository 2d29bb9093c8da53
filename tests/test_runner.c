// The runner, tested from outside with the accidents of runner/attacks.c: every one must leave
// a report that says what happened, and none but the passing tests may count as passed.
#include "test.h"

#include <fcntl.h>
#include <jansson.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>

#ifndef PM_TEST_ATTACKS
#define PM_TEST_ATTACKS "build/ref/tests/attacks"
#endif

// Sanitizers leave signals alone here, so that a crash looks the same in every build.
static pm_test_ran attack(const char *const *arguments)
{
    const char *argv[12] = {PM_TEST_ATTACKS, "--limit", "0.5"};
    size_t used = 3;
    for (size_t i = 0; arguments[i] && used < 11; ++i) {
        argv[used++] = arguments[i];
    }
    setenv("ASAN_OPTIONS", "handle_segv=0:handle_abort=0:detect_leaks=0", 1);
    unsetenv("STRICT");
    return pm_test_run(argv, 30.0);
}

typedef struct {
    const char *filter, *said, *closing;
    int exit_code;
} accident;

static const accident accidents[] = {
    {"wrong.1", "got 1, want 2, tolerance 0.25", "0 passed, 1 failed\n", 1},
    {"wrong.2", "want 0", "0 passed, 1 failed\n", 1},
    {"crash.1", "crashed by signal 11 (Segmentation fault)", "0 passed, 1 failed\n", 1},
    {"crash.2", "crashed by signal 6 (Aborted)", "0 passed, 1 failed\n", 1},
    {"crash.3", "crashed by signal 11 (Segmentation fault)", "0 passed, 1 failed\n", 1},
    {"loop.1", "did not finish in 0.5 s", "0 passed, 1 failed\n", 1},
    {"loop.2", "did not finish in 0.5 s", "0 passed, 1 failed\n", 1},
    {"exit.1", "ended the program before the test finished, with exit status 0",
     "0 passed, 1 failed\n", 1},
    {"exit.2", "ended the program before the test finished, with exit status 0",
     "0 passed, 1 failed\n", 1},
    {"exit.3", "then ended with exit status 7", "0 passed, 1 failed\n", 1},
    {"exit.4", "ok   exit.4", "1 passed, 0 failed\n", 0},
    {"print.1", "ok   print.1", "1 passed, 0 failed\n", 0},
    {"print.2", "ended the program before the test finished", "0 passed, 1 failed\n", 1},
    {"print.3", "| 99 passed, 0 failed", "0 passed, 1 failed\n", 1},
    {"child.1", "the child is not content", "0 passed, 1 failed\n", 1},
    {"skip.1", "install crystal-ball-dev", "0 passed, 0 failed, 1 skipped\n", 0},
    {"todo.1", "lab 3b: not implemented yet", "0 passed, 0 failed, 1 todo\n", 1},
    {"limit.1", "ok   limit.1", "1 passed, 0 failed\n", 0},
    {"refuse.1", "got PM_OK, want PM_EINPUT", "0 passed, 1 failed\n", 1},
    {"refuse.2", "\"albedo\" is not in it; it reads: a.xml:1: radius", "0 passed, 1 failed\n",
     1},
    {"refuse.3", "ok   refuse.3", "1 passed, 0 failed\n", 0},
};

static void check_ending(const pm_test_ran *ran, const char *who, const char *closing)
{
    size_t length = strlen(ran->out);
    size_t want = strlen(closing);
    CHECK_THAT(length >= want && strcmp(ran->out + length - want, closing) == 0,
               "%s: the last line is not \"%s\": %s", who, closing, ran->out);
}

static void name_every_accident(void)
{
    for (size_t i = 0; i < sizeof accidents / sizeof accidents[0]; ++i) {
        const accident *a = &accidents[i];
        pm_test_ran ran = attack((const char *const[]){a->filter, NULL});
        CHECK_THAT(strstr(ran.out, a->said) != NULL, "%s: \"%s\" is not in: %s", a->filter,
                   a->said, ran.out);
        check_ending(&ran, a->filter, a->closing);
        CHECK_THAT(ran.exit_code == a->exit_code, "%s: exit status %d, want %d", a->filter,
                   ran.exit_code, a->exit_code);
        pm_test_ran_free(&ran);
    }
}

static void end_daemons(void)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/lock", pm_test_folder());
    int file = open(path, O_RDWR | O_CREAT, 0600);
    CHECK(file >= 0);
    setenv("ATTACK_LOCK", path, 1);
    pm_test_ran ran = attack((const char *const[]){"child.2", NULL});
    check_ending(&ran, "child.2", "1 passed, 0 failed\n");
    pm_test_ran_free(&ran);
    int locked = -1;
    for (int i = 0; i < 100 && locked != 0; ++i) {
        locked = flock(file, LOCK_EX | LOCK_NB);
        nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
    }
    CHECK_THAT(locked == 0, "the process left behind still lives after 2 s");
    close(file);
}

// No runner in the same system can survive these two; the missing closing line tells.
static void lose_closing_line_when_killed(void)
{
    pm_test_ran killed = attack((const char *const[]){"kill.1", NULL});
    CHECK(killed.exit_code == 128 + SIGKILL);
    CHECK(strstr(killed.out, "passed") == NULL);
    pm_test_ran_free(&killed);
    setenv("ATTACK_CONSTRUCTOR", "1", 1);
    pm_test_ran absent = attack((const char *const[]){"pass.1", NULL});
    CHECK(strcmp(absent.out, "") == 0);
    pm_test_ran_free(&absent);
}

static void filter_by_tag_and_title(void)
{
    pm_test_ran by_tag = attack((const char *const[]){"pass.", NULL});
    check_ending(&by_tag, "pass.", "2 passed, 0 failed\n");
    pm_test_ran_free(&by_tag);
    pm_test_ran by_title = attack((const char *const[]){"are two", "are they", NULL});
    check_ending(&by_title, "are two, are they", "2 passed, 0 failed\n");
    pm_test_ran_free(&by_title);
    pm_test_ran nothing = attack((const char *const[]){"no such test", NULL});
    CHECK(nothing.exit_code == 2);
    CHECK_CONTAINS(nothing.err, "no test has such a tag or title");
    pm_test_ran_free(&nothing);
}

static void keep_table_order(void)
{
    pm_test_ran ran =
        attack((const char *const[]){"--jobs", "4", "loop.1", "pass.", "exit.1", NULL});
    const char *first = strstr(ran.out, "ok   pass.1");
    const char *middle = first ? strstr(first, "FAIL loop.1") : NULL;
    CHECK_THAT(middle && strstr(middle, "FAIL exit.1"), "not in table order: %s", ran.out);
    check_ending(&ran, "all four", "2 passed, 2 failed\n");
    pm_test_ran_free(&ran);
}

static void be_strict_about_skips(void)
{
    setenv("STRICT", "1", 1);
    const char *const argv[] = {PM_TEST_ATTACKS, "skip.1", NULL};
    pm_test_ran ran = pm_test_run(argv, 30.0);
    CHECK(ran.exit_code == 1);
    CHECK_CONTAINS(ran.out, "install crystal-ball-dev");
    check_ending(&ran, "skip.1", "0 passed, 1 failed\n");
    pm_test_ran_free(&ran);
}

static void write_tap(void)
{
    const char *const arguments[] = {"--tap", "pass.1", "wrong.1", "skip.1", NULL};
    pm_test_ran ran = attack(arguments);
    CHECK_CONTAINS(ran.out, "TAP version 13\n1..3\nok 1 - pass.1 one and one are two\n");
    CHECK_CONTAINS(ran.out, "\nnot ok 2 - wrong.1 a wrong value\n# ");
    CHECK_CONTAINS(ran.out,
                   "\nok 3 - skip.1 a part is missing # skip there is no crystal ball");
    check_ending(&ran, "--tap", "# 1 passed, 1 failed, 1 skipped\n");
    pm_test_ran_free(&ran);
}

static void write_json(void)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/results.json", pm_test_folder());
    pm_test_ran ran = attack((const char *const[]){"--json", path, "pass.1", "crash.2", NULL});
    pm_test_ran_free(&ran);
    json_t *all = json_load_file(path, 0, NULL);
    CHECK(all != NULL);
    CHECK(json_integer_value(json_object_get(all, "passed")) == 1);
    CHECK(json_integer_value(json_object_get(all, "failed")) == 1);
    json_t *crash = json_array_get(json_object_get(all, "tests"), 1);
    CHECK_CONTAINS(json_string_value(json_object_get(crash, "tag")), "crash.2");
    CHECK_CONTAINS(json_string_value(json_object_get(crash, "message")), "Aborted");
    json_decref(all);
}

static void refuse_bad_options(void)
{
    const char *const bad[] = {"--limit=0", "--limit=5x", "--limit=nan", "--jobs=-1", "--foo"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        const char *const argv[] = {PM_TEST_ATTACKS, bad[i], NULL};
        pm_test_ran ran = pm_test_run(argv, 30.0);
        CHECK_THAT(ran.exit_code == 2 && ran.err[0] && !ran.out[0], "%s: exit status %d",
                   bad[i], ran.exit_code);
        pm_test_ran_free(&ran);
    }
}

static void drain_both_streams(void)
{
    const char *script = "head -c 300000 /dev/zero | tr '\\0' e >&2; "
                         "head -c 300000 /dev/zero | tr '\\0' o; exit 3";
    const char *const argv[] = {"/bin/sh", "-c", script, NULL};
    pm_test_ran ran = pm_test_run(argv, 30.0);
    CHECK(ran.exit_code == 3);
    CHECK(strlen(ran.out) == 300000 && strlen(ran.err) == 300000);
    CHECK(ran.out[299999] == 'o' && ran.err[0] == 'e');
    pm_test_ran_free(&ran);
}

static void stop_slow_program(void)
{
    const char *const argv[] = {"/bin/sh", "-c", "echo begun; exec sleep 30", NULL};
    pm_test_ran ran = pm_test_run(argv, 0.3);
    CHECK(ran.exit_code == 128 + SIGKILL);
    CHECK_CONTAINS(ran.out, "begun");
    pm_test_ran_free(&ran);
}

static void name_missing_program(void)
{
    const char *const argv[] = {"/no/such/program", NULL};
    pm_test_ran ran = pm_test_run(argv, 30.0);
    CHECK(ran.exit_code == 127);
    CHECK_CONTAINS(ran.err, "/no/such/program");
    pm_test_ran_free(&ran);
}

PM_TESTS(
    {"runner.1", "every accident is named and none counts as passed", name_every_accident},
    {"runner.2", "a process left behind neither blocks the runner nor lives on", end_daemons},
    {"runner.3", "a killed runner and one that never began print no closing line",
     lose_closing_line_when_killed},
    {"runner.4", "a filter is the beginning of a tag or a part of a title",
     filter_by_tag_and_title},
    {"runner.5", "results are told in table order, however long each takes", keep_table_order},
    {"runner.6", "STRICT=1 makes a skipped test a failure that names the package",
     be_strict_about_skips},
    {"runner.7", "--tap writes a plan, numbered results and reasons", write_tap},
    {"runner.8", "--json writes counts and one object per test", write_json},
    {"runner.9", "options that make no sense end with status 2", refuse_bad_options},
    {"runner.10", "a program's full output is taken from both streams", drain_both_streams},
    {"runner.11", "a program that takes too long is killed", stop_slow_program},
    {"runner.12", "a program that does not exist ends with status 127 and its name",
     name_missing_program})

// What may happen to a test, as a test program of its own: test_runner.c starts it and reads
// what the runner makes of each accident. Never run as a whole: some tests end the runner.
#include "../test.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <time.h>
#include <unistd.h>

static void pause_for(double seconds)
{
    const struct timespec time = {.tv_nsec = (long)(seconds * 1e9)};
    nanosleep(&time, NULL);
}

static void pass(void)
{
    CHECK(1 + 1 == 2);
}

static void get_wrong_value(void)
{
    CHECK_NEAR(1.0, 2.0, 0.25);
}

static void get_nan(void)
{
    volatile double zero = 0.0;
    CHECK_NEAR(zero / zero, 0.0, 1e300);
}

static void touch_forbidden_page(void)
{
    int zero = open("/dev/zero", O_RDONLY);
    volatile char *page = mmap(NULL, 4096, PROT_NONE, MAP_PRIVATE, zero, 0);
    page[0] = 1;
}

static int go_deeper(volatile int *depth)
{
    volatile char room[4096];
    room[0] = 1;
    ++*depth;
    return *depth > 0 ? go_deeper(depth) + room[0] : 0;
}

static void overflow_stack(void)
{
    volatile int depth = 0;
    CHECK(go_deeper(&depth) == 0);
}

static void loop(void)
{
    for (volatile int i = 0;; i = !i) {
    }
}

static void loop_deaf(void)
{
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, NULL);
    signal(SIGTERM, SIG_IGN);
    loop();
}

static void leave_by_exit(void)
{
    exit(0);
}

static void leave_at_once(void)
{
    _exit(0);
}

static void print_pass(void)
{
    puts("ok   print.1      everything is fine\n99 passed, 0 failed");
    fflush(stdout);
}

static void print_pass_and_leave(void)
{
    print_pass();
    _exit(0);
}

static void print_pass_and_fail(void)
{
    print_pass();
    CHECK_CONTAINS("abc", "x");
}

static void fail_in_child(void)
{
    if (fork() == 0) {
        CHECK_THAT(getppid() == 0, "the child is not content");
    }
    pause_for(0.2);
}

// The child keeps the test's pipe open and a lock, by which test_runner.c sees it live.
static void leave_daemon(void)
{
    const char *path = getenv("ATTACK_LOCK");
    int file = open(path ? path : "/dev/null", O_RDWR);
    CHECK(flock(file, LOCK_EX) == 0);
    if (fork() == 0) {
        for (;;) {
            pause();
        }
    }
}

static void kill_parent(void)
{
    kill(getppid(), SIGKILL);
}

static void skip(void)
{
    pm_test_skip("there is no crystal ball", "crystal-ball-dev");
}

static void meet_stub(void)
{
    CHECK_OK(PM_TODO("3b"));
}

static void ask_for_time(void)
{
    pm_test_limit(180.0);
    pause_for(0.8);
}

static void succeed_unexpectedly(void)
{
    CHECK_FAILS(PM_OK, PM_EINPUT, "");
}

static void refuse_with_other_words(void)
{
    CHECK_FAILS(pm_status_fail(PM_EINPUT, "a.xml:1: radius"), PM_EINPUT, "albedo");
}

static void refuse_as_expected(void)
{
    CHECK_FAILS(pm_status_fail(PM_EINPUT, "a.xml:1: radius"), PM_EINPUT, "radius");
    CHECK(pm_status_message()[0] == '\0');
}

static void exit_badly_after_test(void)
{
    CHECK(atexit(leave_at_once) == 0);
}

static void end_with_status_7(void)
{
    _exit(7);
}

static void finish_then_fail(void)
{
    CHECK(atexit(end_with_status_7) == 0);
}

PM_TESTS({"pass.1", "one and one are two", pass}, {"pass.2", "so are they here", pass},
         {"wrong.1", "a wrong value", get_wrong_value},
         {"wrong.2", "a value that is NaN", get_nan},
         {"crash.1", "a segmentation fault", touch_forbidden_page},
         {"crash.2", "an abort", abort}, {"crash.3", "a stack overflow", overflow_stack},
         {"loop.1", "an endless loop", loop},
         {"loop.2", "an endless loop with signals blocked", loop_deaf},
         {"exit.1", "exit(0)", leave_by_exit}, {"exit.2", "_exit(0)", leave_at_once},
         {"exit.3", "a good end and then status 7", finish_then_fail},
         {"exit.4", "a good end with an early exit handler", exit_badly_after_test},
         {"print.1", "a printed pass", print_pass},
         {"print.2", "a printed pass, then _exit(0)", print_pass_and_leave},
         {"print.3", "a printed pass, then a failure", print_pass_and_fail},
         {"child.1", "a child fails, its parent does not", fail_in_child},
         {"child.2", "a daemon is left behind", leave_daemon},
         {"kill.1", "the runner is killed", kill_parent}, {"skip.1", "a part is missing", skip},
         {"todo.1", "a stub", meet_stub},
         {"limit.1", "a test asks for more time", ask_for_time},
         {"refuse.1", "a call succeeds unexpectedly", succeed_unexpectedly},
         {"refuse.2", "a call fails with other words", refuse_with_other_words},
         {"refuse.3", "a call fails as expected", refuse_as_expected})

__attribute__((constructor)) static void leave_before_main(void)
{
    if (getenv("ATTACK_CONSTRUCTOR")) {
        _exit(0);
    }
}

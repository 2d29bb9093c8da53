// How failure is told: the first message of a thread stays, and exit codes follow the contract.
#include "status.h"
#include "test.h"

#include <stdio.h>
#include <string.h>

static void keep_first_message(void)
{
    CHECK(pm_status_message()[0] == '\0');
    CHECK(pm_status_fail(PM_EINPUT, "a.xml:%d: first", 3) == PM_EINPUT);
    CHECK(pm_status_fail(PM_EIO, "second") == PM_EIO);
    CHECK(strcmp(pm_status_message(), "a.xml:3: first") == 0);
}

static void forget_when_cleared(void)
{
    pm_status_fail(PM_EINPUT, "old");
    pm_status_clear();
    CHECK(pm_status_message()[0] == '\0');
    pm_status_fail(PM_EINPUT, "new");
    CHECK(strcmp(pm_status_message(), "new") == 0);
}

static void keep_threads_apart(void)
{
    int mixed = 0;
    int number = 0;
#pragma omp parallel num_threads(4) reduction(+ : mixed)
    {
        char want[32];
        int mine;
#pragma omp atomic capture
        mine = number++;
        snprintf(want, sizeof want, "thread %d", mine);
        pm_status_fail(PM_EINPUT, "%s", want);
#pragma omp barrier
        mixed += strcmp(pm_status_message(), want) != 0;
    }
    CHECK(number == 4);
    CHECK(mixed == 0);
}

static void name_source_line(void)
{
    pm_status status = PM_FAIL(PM_ELIMIT, "%d photons", 5);
    int line = __LINE__ - 1;
    char want[256];
    snprintf(want, sizeof want, "%s:%d: 5 photons", __FILE__, line);
    CHECK(status == PM_ELIMIT);
    CHECK(strcmp(pm_status_message(), want) == 0);
}

static pm_status try_twice(pm_status first, int *reached)
{
    PM_TRY(first);
    *reached = 1;
    return PM_OK;
}

static void return_at_first_failure(void)
{
    int reached = 0;
    CHECK(try_twice(PM_EIO, &reached) == PM_EIO);
    CHECK(reached == 0);
    CHECK(try_twice(PM_OK, &reached) == PM_OK);
    CHECK(reached == 1);
}

static void cut_long_messages(void)
{
    static char text[20000];
    memset(text, 'a', sizeof text - 1);
    pm_status_fail(PM_EINPUT, "%s", text);
    size_t length = strlen(pm_status_message());
    CHECK(length >= 4000 && length < sizeof text - 1);
    CHECK(strspn(pm_status_message(), "a") == length);
}

static void name_unwritten_task(void)
{
    CHECK_FAILS(PM_TODO("3b"), PM_ETODO, "lab 3b: not implemented yet");
}

static void give_exit_codes(void)
{
    CHECK(pm_status_exit_code(PM_OK) == 0);
    CHECK(pm_status_exit_code(PM_ESTOPPED) == 130);
    const pm_status faults[] = {PM_EINPUT, PM_ENOMEM, PM_EIO, PM_ETODO, PM_ELIMIT};
    for (size_t i = 0; i < sizeof faults / sizeof faults[0]; ++i) {
        CHECK(pm_status_exit_code(faults[i]) == 2);
    }
}

PM_TESTS({"status.1", "the first message is kept, because later ones are its consequences",
          keep_first_message},
         {"status.2", "a cleared message is gone", forget_when_cleared},
         {"status.3", "each thread has its own message", keep_threads_apart},
         {"status.4", "a fault of ours names its source line", name_source_line},
         {"status.5", "PM_TRY returns at the first failure", return_at_first_failure},
         {"status.6", "a message that is too long is cut, not dropped", cut_long_messages},
         {"status.7", "a stub names its lab task", name_unwritten_task},
         {"status.8", "exit codes are 0, 2 and 130", give_exit_codes})

// The handler sets the flag and nothing else; the second signal does not wait any longer.
#include "interrupt.h"

#include "file.h"

#include <signal.h>
#include <string.h>
#include <unistd.h>

// Mutable and global, like the names in file.c: a signal handler can reach nothing else.
static volatile sig_atomic_t caught;

static void note_signal(int number)
{
    (void)number;
    if (caught) {
        pm_file_abandon_all();
        _exit(130);
    }
    caught = 1;
}

void pm_interrupt_catch(void)
{
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = note_signal;
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

bool pm_interrupted(void)
{
    return caught != 0;
}

pm_status pm_interrupt_check(void)
{
    return pm_interrupted() ? pm_status_fail(PM_ESTOPPED, "stopped; nothing was written")
                            : PM_OK;
}

// SIGINT as a question that long loops ask: the handler only sets a flag, so that whoever holds
// files and memory gives them back and `main` exits with 130.
#ifndef PM_INTERRUPT_H
#define PM_INTERRUPT_H

#include "status.h"

#include <stdbool.h>

/// From now on SIGINT and SIGTERM set the flag; a second one ends the process at once, with no
/// half-written file left.
void pm_interrupt_catch(void);

/// Whether the flag is set. Any thread, any time.
bool pm_interrupted(void);

/// PM_ESTOPPED with a message when the flag is set, else PM_OK: `PM_TRY(pm_interrupt_check())`.
pm_status pm_interrupt_check(void);

#endif

// One message buffer per thread; the first failure since the last clear owns it.
#include "status.h"

#include <stdarg.h>
#include <stdio.h>

static _Thread_local char message[8192];

pm_status pm_status_fail(pm_status code, const char *format, ...)
{
    if (message[0] != '\0') {
        return code;
    }
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    return code;
}

const char *pm_status_message(void)
{
    return message;
}

void pm_status_clear(void)
{
    message[0] = '\0';
}

int pm_status_exit_code(pm_status status)
{
    switch (status) {
    case PM_OK:
        return 0;
    case PM_ESTOPPED:
        return 130;
    default:
        return 2;
    }
}

// Lines live in a fixed table, so that reporting works without memory.
#include "faults.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static void tidy(char *line)
{
    for (char *c = line; *c != '\0'; c++) {
        if (iscntrl((unsigned char)*c)) {
            *c = '?';
        }
    }
}

void pm_faults_add(pm_faults *faults, const char *file, int line, const char *format, ...)
{
    if (faults->count == PM_FAULTS_MAX) {
        return;
    }
    char *text = faults->lines[faults->count];
    int used = line > 0 ? snprintf(text, PM_FAULTS_LINE, "%.120s:%d: ", file, line)
                        : snprintf(text, PM_FAULTS_LINE, "%.120s: ", file);
    va_list arguments;
    va_start(arguments, format);
    int more = vsnprintf(text + used, PM_FAULTS_LINE - (size_t)used, format, arguments);
    va_end(arguments);
    if (used + more >= PM_FAULTS_LINE) {
        memcpy(text + PM_FAULTS_LINE - 4, "...", 4);
    }
    tidy(text);
    faults->count++;
    if (faults->worst == PM_OK) {
        faults->worst = PM_EINPUT;
    }
}

void pm_faults_fail(pm_faults *faults, pm_status code)
{
    faults->worst = code;
}

bool pm_faults_none(const pm_faults *faults)
{
    return faults->worst == PM_OK;
}

pm_status pm_faults_report(const pm_faults *faults)
{
    if (faults->worst == PM_OK) {
        return PM_OK;
    }
    if (faults->worst == PM_ENOMEM) {
        return pm_status_fail(PM_ENOMEM, "no memory to read the scene");
    }
    char all[PM_FAULTS_MAX * PM_FAULTS_LINE] = "";
    size_t used = 0;
    for (int i = 0; i < faults->count; i++) {
        size_t room = sizeof all - used;
        int wrote = snprintf(all + used, room, "%s%s", i > 0 ? "\n" : "", faults->lines[i]);
        used += (size_t)wrote;
    }
    return pm_status_fail(faults->worst, "%s", all);
}

// Contracts are in the header. Values are few, so a list is searched from end to end.
#include "defaults.h"

#include "nearest.h"

#include <stdbool.h>
#include <string.h>

static bool has(const pm_defaults *defaults, const char *name)
{
    for (const pm_default *d = defaults->given; d != NULL; d = d->next) {
        if (strcmp(d->name, name) == 0) {
            return true;
        }
    }
    return false;
}

static const char *defined_value(const pm_defaults *defaults, const char *name,
                                 const char *value)
{
    for (int i = 0; i < defaults->define_count; i++) {
        if (strcmp(defaults->defines[i].name, name) == 0) {
            return defaults->defines[i].value;
        }
    }
    return value;
}

pm_status pm_defaults_give(pm_defaults *defaults, pm_arena *arena, const char *name,
                           const char *value)
{
    if (has(defaults, name)) {
        return PM_OK;
    }
    value = defined_value(defaults, name, value);
    pm_default *given = pm_arena_take(arena, 1, sizeof *given);
    char *own_name = pm_arena_copy(arena, name, strlen(name));
    char *own_value = pm_arena_copy(arena, value, strlen(value));
    if (given == NULL || own_name == NULL || own_value == NULL) {
        return PM_ENOMEM;
    }
    *given = (pm_default){own_name, own_value, defaults->given};
    defaults->given = given;
    return PM_OK;
}

/// The longest name that `text` begins with, or NULL.
static const pm_default *match(const pm_defaults *defaults, const char *text)
{
    const pm_default *longest = NULL;
    for (const pm_default *d = defaults->given; d != NULL; d = d->next) {
        size_t length = strlen(d->name);
        bool fits = strncmp(text, d->name, length) == 0;
        if (fits && (longest == NULL || length > strlen(longest->name))) {
            longest = d;
        }
    }
    return longest;
}

pm_status pm_defaults_replace(const pm_defaults *defaults, pm_arena *arena, const char *text,
                              const char **result, const char **unknown)
{
    char *done = pm_arena_copy(arena, "", 0);
    *result = NULL;
    *unknown = NULL;
    while (done != NULL) {
        size_t plain = strcspn(text, "$");
        if (text[plain] == '\0') {
            *result = pm_arena_print(arena, "%s%s", done, text);
            return *result == NULL ? PM_ENOMEM : PM_OK;
        }
        const char *name = text + plain + 1;
        if (plain > 0 && text[plain - 1] == '\\') {
            done = pm_arena_print(arena, "%s%.*s$", done, (int)plain - 1, text);
            text = name;
            continue;
        }
        const pm_default *found = match(defaults, name);
        if (found == NULL) {
            *unknown = name;
            return PM_OK;
        }
        done = pm_arena_print(arena, "%s%.*s%s", done, (int)plain, text, found->value);
        text = name + strlen(found->name);
    }
    return PM_ENOMEM;
}

/// The nearest name given so far, or NULL.
static const char *nearest_name(const pm_defaults *defaults, const char *name)
{
    const char *nearest = NULL;
    for (const pm_default *d = defaults->given; d != NULL; d = d->next) {
        const char *pair[2] = {d->name, nearest};
        nearest = pm_nearest_word(name, pair, nearest == NULL ? 1 : 2);
    }
    return nearest;
}

void pm_defaults_report_unknown(const pm_defaults *defaults, const char *name,
                                pm_faults *faults, const char *file, int line)
{
    const char *nearest = nearest_name(defaults, name);
    if (nearest == NULL) {
        pm_faults_add(faults, file, line, "\"$%.60s\" has no <default> before it", name);
    } else {
        pm_faults_add(faults, file, line,
                      "\"$%.60s\" has no <default> before it; the nearest is \"%.60s\"", name,
                      nearest);
    }
}

void pm_defaults_report_unused(const pm_defaults *defaults, pm_faults *faults, const char *path)
{
    for (int i = 0; i < defaults->define_count; i++) {
        const char *name = defaults->defines[i].name;
        if (has(defaults, name)) {
            continue;
        }
        const char *nearest = nearest_name(defaults, name);
        pm_faults_add(
            faults, path, 0, "-D %.60s: the file has no <default> of this name%s%.60s", name,
            nearest == NULL ? "" : "; the nearest is ", nearest == NULL ? "" : nearest);
    }
}

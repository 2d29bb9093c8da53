// Both forms are taken, `--depth 4` and `--depth=4`; behind `--` nothing is an option.
#include "view_options.h"

#include "tree_split.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define PATHS_MOST 1000000

static pm_status read_count(const char *name, const char *text, uint64_t most, uint64_t *value)
{
    char *end = NULL;
    bool digits =
        text[0] != '\0' && strlen(text) < 16 && strspn(text, "0123456789") == strlen(text);
    uint64_t got = digits ? strtoull(text, &end, 10) : 0;
    if (got < 1 || got > most) {
        return pm_status_fail(PM_EINPUT,
                              "view: %s must be a whole number from 1 to %llu, got \"%s\"",
                              name, (unsigned long long)most, text);
    }
    *value = got;
    return PM_OK;
}

/// Sets the option called `name`.
static pm_status set(pm_view_options *view, const char *name, const char *text)
{
    if (strcmp(name, "--scene") == 0) {
        view->scene = text;
        return PM_OK;
    }
    if (strcmp(name, "--paths") == 0) {
        return read_count(name, text, PATHS_MOST, &view->paths);
    }
    uint64_t depth = 0;
    PM_TRY(read_count(name, text, PM_TREE_DEPTHS_MAX, &depth));
    view->depth = (int)depth;
    return PM_OK;
}

/// Which of our options `argument` is, and where its value starts (NULL: in the next argument).
static const char *recognise(char *argument, char **value)
{
    static const char *const names[] = {"--scene", "--depth", "--paths"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        size_t length = strlen(names[i]);
        if (strncmp(argument, names[i], length) == 0 &&
            (argument[length] == '\0' || argument[length] == '=')) {
            *value = argument[length] == '=' ? argument + length + 1 : NULL;
            return names[i];
        }
    }
    return NULL;
}

pm_status pm_view_options_take(int *argc, char **argv, pm_view_options *view)
{
    pm_view_options taken = {.depth = PM_VIEW_DEPTH_DEFAULT, .paths = PM_VIEW_PATHS_DEFAULT};
    int kept = 0;
    bool over = false;
    for (int i = 0; i < *argc; i++) {
        char *value = NULL;
        over = over || strcmp(argv[i], "--") == 0;
        const char *name = over || i == 0 ? NULL : recognise(argv[i], &value);
        if (name == NULL) {
            argv[kept++] = argv[i];
            continue;
        }
        if (value == NULL && ++i < *argc) {
            value = argv[i];
        }
        if (value == NULL) {
            return pm_status_fail(PM_EINPUT, "view: %s needs a value", name);
        }
        PM_TRY(set(&taken, name, value));
    }
    argv[kept] = NULL;
    *argc = kept;
    *view = taken;
    return PM_OK;
}

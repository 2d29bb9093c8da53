// Named values of a scene file: <default name="spp" value="16"/> gives one, -D spp=64 replaces
// it, "$spp" in an attribute stands for it. The first value given to a name stays.
#ifndef PM_DEFAULTS_H
#define PM_DEFAULTS_H

#include "arena.h"
#include "faults.h"
#include "scene_read.h"

typedef struct pm_default {
    const char *name;
    const char *value;
    struct pm_default *next;
} pm_default;

typedef struct {
    const pm_define *defines; // from the command line
    int define_count;
    pm_default *given; // by <default> elements so far
} pm_defaults;

/// Gives `name` the value of its define, or else `value`.
/// @return PM_ENOMEM
pm_status pm_defaults_give(pm_defaults *defaults, pm_arena *arena, const char *name,
                           const char *value);

/// `text` with every $name replaced (the longest known name that fits) and "\$" made "$".
///
/// @param result   [out] in the arena; NULL when a name is not known
/// @param unknown  [out] then: where the name begins in `text`, behind the dollar sign
/// @return PM_ENOMEM
pm_status pm_defaults_replace(const pm_defaults *defaults, pm_arena *arena, const char *text,
                              const char **result, const char **unknown);

/// Adds the fault that no <default> before `file`:`line` gives `name`.
void pm_defaults_report_unknown(const pm_defaults *defaults, const char *name,
                                pm_faults *faults, const char *file, int line);

/// Adds a fault for every define that no <default> has asked for, once all is read.
void pm_defaults_report_unused(const pm_defaults *defaults, pm_faults *faults,
                               const char *path);

#endif

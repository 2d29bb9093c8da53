// Colours that stand apart on the dark ground: white for the plain average, which every kernel
// is measured against.
#include "kernel_look.h"

#include <string.h>

static const char lecture[] = "-lecture";

bool pm_kernel_look_is_lecture(const char *name)
{
    size_t length = strlen(name);
    size_t tail = strlen(lecture);
    return length > tail && strcmp(name + length - tail, lecture) == 0;
}

pm_kernel_look pm_kernel_look_of(const char *name)
{
    static const struct {
        const char *name, *words;
        pm_colour_name colour;
    } known[] = {{"none", "none (all alike)", PM_COLOUR_WHITE},
                 {"cone", "cone", PM_COLOUR_ORANGE},
                 {"gaussian", "Gaussian", PM_COLOUR_SKY},
                 {"epanechnikov", "Epanechnikov", PM_COLOUR_GREEN},
                 {"differential", "differential checking", PM_COLOUR_PURPLE}};
    size_t length = strlen(name);
    if (pm_kernel_look_is_lecture(name)) {
        length -= strlen(lecture);
    }
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        if (strlen(known[i].name) == length && memcmp(known[i].name, name, length) == 0) {
            return (pm_kernel_look){known[i].name, known[i].words,
                                    pm_colour_named(known[i].colour)};
        }
    }
    return (pm_kernel_look){name, name, pm_colour_named(PM_COLOUR_WHITE)};
}

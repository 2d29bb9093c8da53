// The table holds the names and values that Mitsuba 3 documents for `int_ior` and `ext_ior`
// (589 nm, room temperature; most after Hecht, "Optics").
#include "ior.h"

#include "nearest.h"

#include <string.h>
#include <strings.h>

#define PM_IOR_COUNT 23

static const char *const names[PM_IOR_COUNT] = {
    "vacuum",   "helium",          "hydrogen",
    "air",      "carbon dioxide",  "water",
    "acetone",  "ethanol",         "carbon tetrachloride",
    "glycerol", "benzene",         "silicone oil",
    "bromine",  "water ice",       "fused quartz",
    "pyrex",    "acrylic glass",   "polypropylene",
    "bk7",      "sodium chloride", "amber",
    "pet",      "diamond",
};

static const double indices[PM_IOR_COUNT] = {
    1.0,   1.000036, 1.000132, 1.000277, 1.00045, 1.3330, 1.36,  1.361,
    1.461, 1.4729,   1.501,    1.52045,  1.661,   1.31,   1.458, 1.470,
    1.49,  1.49,     1.5046,   1.544,    1.55,    1.5750, 2.419,
};

bool pm_ior_find(const char *name, double *index, const char **nearest)
{
    for (int i = 0; i < PM_IOR_COUNT; i++) {
        if (strcasecmp(name, names[i]) == 0) {
            *index = indices[i];
            return true;
        }
    }
    *nearest = pm_nearest_word(name, names, PM_IOR_COUNT);
    return false;
}

// Coefficients of glasses, each checked in the tests by the n_d and the Abbe number that it is
// sold by.
#include "glass.h"

#include "nearest.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

static const pm_glass glasses[] = {
    {"bk7",
     3,
     {1.03961212, 0.231792344, 1.01046945},
     {0.00600069867, 0.0200179144, 103.560653}},
};

#define GLASSES ((int)(sizeof glasses / sizeof glasses[0]))

const pm_glass *pm_glass_named(const char *name)
{
    for (int i = 0; i < GLASSES; i++) {
        if (strcmp(glasses[i].name, name) == 0) {
            return &glasses[i];
        }
    }
    return NULL;
}

const char *pm_glass_nearest(const char *name)
{
    const char *known[GLASSES];
    for (int i = 0; i < GLASSES; i++) {
        known[i] = glasses[i].name;
    }
    return pm_nearest_word(name, known, GLASSES);
}

double pm_glass_index(const pm_glass *glass, double wavelength)
{
    double um = wavelength / 1000.0;
    double w2 = um * um;
    double n2 = 1.0;
    for (int i = 0; i < glass->terms; i++) {
        n2 += glass->b[i] * w2 / (w2 - glass->c[i]);
    }
    return sqrt(n2);
}

double pm_glass_abbe(const pm_glass *glass)
{
    double blue = pm_glass_index(glass, 486.1327); // the F and C lines of hydrogen
    double red = pm_glass_index(glass, 656.2725);
    return (pm_glass_index(glass, PM_GLASS_D_LINE) - 1.0) / (blue - red);
}

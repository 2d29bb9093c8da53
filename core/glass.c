// Coefficients of glasses, each checked in the tests by the n_d and the Abbe number that it is
// sold by.
#include "glass.h"

#include "nearest.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/// Where a source prints the resonances themselves [um] and not their squares.
#define SQUARED(um) ((um) * (um))

static const pm_glass glasses[] = {
    {"bk7",
     3,
     {1.03961212, 0.231792344, 1.01046945},
     {0.00600069867, 0.0200179144, 103.560653}},
    {"sf10", 3, {1.61625977, 0.259229334, 1.07762317}, {0.0127534559, 0.0581983954, 116.60768}},
    {"sf11",
     3,
     {1.73848403, 0.311168974, 1.17490871},
     {0.0136068604, 0.0615960463, 121.922711}},
    {"n-sf11",
     3,
     {1.73759695, 0.313747346, 1.89878101},
     {0.013188707, 0.0623068142, 155.23629}},
    {"fused-silica",
     3,
     {0.6961663, 0.4079426, 0.8974794},
     {SQUARED(0.0684043), SQUARED(0.1162414), SQUARED(9.896161)}},
    {"diamond", 2, {0.3306, 4.3356}, {SQUARED(0.1750), SQUARED(0.1060)}},
    {"water",
     4,
     {0.5684027565, 0.1726177391, 0.02086189578, 0.1130748688},
     {0.005101829712, 0.01821153936, 0.02620722293, 10.69792721}},
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

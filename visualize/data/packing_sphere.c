// Patches lie where photons are, so that there is something to see; ties go to the first.
#include "packing_sphere.h"

#include <math.h>

#define STRETCHES 60 // of the equator, each as wide as a patch

static pm_vec3 vec_of(const float v[3])
{
    return pm_vec((double)v[0], (double)v[1], (double)v[2]);
}

pm_vec3 pm_sphere_at(double theta, double phi)
{
    return pm_vec(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
}

void pm_sphere_choose(float (*exact)[3], float (*packed)[3], unsigned count,
                      pm_sphere_choice *choice)
{
    choice->count = count < PM_SPHERE_WHOLE ? (int)count : PM_SPHERE_WHOLE;
    for (int i = 0; i < choice->count; i++) {
        unsigned from =
            (unsigned)((unsigned long long)i * count / (unsigned long long)choice->count);
        choice->pairs[i] = (pm_sphere_pair){vec_of(exact[from]), vec_of(packed[from])};
    }
}

static bool lies_in(const pm_sphere_patch *patch, pm_vec3 direction)
{
    pm_vec3 middle = pm_sphere_at(patch->theta, patch->phi);
    return pm_vec_dot(direction, middle) > cos(PM_SPHERE_REACH);
}

/// At even steps among those that lie in the patch.
static void fill(float (*exact)[3], float (*packed)[3], unsigned count, pm_sphere_patch *patch)
{
    patch->there = 0;
    for (unsigned i = 0; i < count; i++) {
        patch->there += lies_in(patch, vec_of(exact[i])) ? 1 : 0;
    }
    int step = 1 + (patch->there - 1) / PM_SPHERE_PATCH;
    int met = 0;
    patch->count = 0;
    for (unsigned i = 0; i < count; i++) {
        if (lies_in(patch, vec_of(exact[i])) && met++ % step == 0) {
            patch->pairs[patch->count++] =
                (pm_sphere_pair){vec_of(exact[i]), vec_of(packed[i])};
        }
    }
}

void pm_sphere_equator(float (*exact)[3], float (*packed)[3], unsigned count,
                       pm_sphere_patch *patch)
{
    int found[STRETCHES] = {0};
    int most = 0;
    for (unsigned i = 0; i < count; i++) {
        pm_vec3 way = vec_of(exact[i]);
        double turn = atan2(way.y, way.x) / (2.0 * PM_PI);
        int at = (int)((turn < 0.0 ? turn + 1.0 : turn) * STRETCHES) % STRETCHES;
        found[at] += fabs(way.z) < PM_SPHERE_REACH ? 1 : 0;
        most = found[at] > found[most] ? at : most;
    }
    patch->theta = 0.5 * PM_PI;
    patch->phi = (most + 0.5) * (2.0 * PM_PI / STRETCHES);
    fill(exact, packed, count, patch);
}

void pm_sphere_pole(float (*exact)[3], float (*packed)[3], unsigned count,
                    pm_sphere_patch *patch)
{
    unsigned up = 0;
    unsigned down = 0;
    for (unsigned i = 0; i < count; i++) {
        up += (double)exact[i][2] > cos(PM_SPHERE_REACH) ? 1 : 0;
        down += (double)exact[i][2] < -cos(PM_SPHERE_REACH) ? 1 : 0;
    }
    patch->theta = down > up ? PM_PI : 0.0;
    patch->phi = 0.0;
    fill(exact, packed, count, patch);
}

// What is looked at on the sphere of directions: a thin choice of all of them, and two small
// patches, where cells are widest and where they are narrowest.
//
// The polar angle theta is counted from +z, the azimuth phi from +x; a cell spans pi/256 in
// theta and 2 pi/256 in phi.
#ifndef PM_PACKING_SPHERE_H
#define PM_PACKING_SPHERE_H

#include "vec.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

#define PM_SPHERE_CELLS 256
#define PM_SPHERE_STEP 8       // lines that the whole sphere shows
#define PM_SPHERE_WHOLE 4000   // directions on the whole sphere, at most
#define PM_SPHERE_PATCH 160    // directions in a patch, at most
#define PM_SPHERE_HALF 0.0349  // half the width of a patch as it is shown [rad]: 2 degrees
#define PM_SPHERE_REACH 0.0524 // of its directions from the middle [rad]: out to the corners

/// A photon's direction and what its bytes give back.
typedef struct {
    pm_vec3 exact, packed; // unit
} pm_sphere_pair;

typedef struct {
    pm_sphere_pair pairs[PM_SPHERE_WHOLE];
    int count;
} pm_sphere_choice;

typedef struct {
    double theta, phi; // of its middle [rad]
    pm_sphere_pair pairs[PM_SPHERE_PATCH];
    int count;
    int there; // directions in it, shown or not
} pm_sphere_patch;

/// The unit vector at two angles.
pm_vec3 pm_sphere_at(double theta, double phi);

/// Directions at even steps.
/// @param choice  [out]
void pm_sphere_choose(float (*exact)[3], float (*packed)[3], unsigned count,
                      pm_sphere_choice *choice);

/// The stretch of the equator that most directions go through, and the pole that has more of
/// them around it.
/// @param patch  [out]
void pm_sphere_equator(float (*exact)[3], float (*packed)[3], unsigned count,
                       pm_sphere_patch *patch);
void pm_sphere_pole(float (*exact)[3], float (*packed)[3], unsigned count,
                    pm_sphere_patch *patch);

#ifdef __cplusplus
}
#endif
#endif

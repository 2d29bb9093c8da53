// Photons of one light counted by their angle to its axis, to be held against what the light's
// law says.
//
// Invariant: a photon counts by the share of the light's power that it carries. So where a
// projection map leaves directions dark, what is counted in the lit ones still meets the law.
#ifndef PM_RAY_TALLY_H
#define PM_RAY_TALLY_H

#include "light_law.h"

enum { PM_RAY_BANDS_MAX = 24 };

typedef struct {
    int bands;                           // 0 where there is no density
    double border[PM_RAY_BANDS_MAX + 2]; // [rad]; one band more, beyond reach, holds strays
    uint64_t photons[PM_RAY_BANDS_MAX + 1];
    double density[PM_RAY_BANDS_MAX + 1]; // counted [1/sr], on average over the band
    double error[PM_RAY_BANDS_MAX + 1];   // of that, one standard deviation [1/sr]
    uint64_t count, strays;               // strays leave where the light sends nothing
    double sent;                          // share of the light's power that the photons carry
} pm_ray_tally;

/// Counts the photons of a light.
/// @param light       index that `law` is of
/// @param bands_most  1 to PM_RAY_BANDS_MAX; fewer where there are few photons
pm_ray_tally pm_ray_tally_make(const pm_ray_set *rays, const pm_light_law *law, int light,
                               int bands_most);

/// Whether a photon along this direction (pm_light_law_local()) leaves where none should.
bool pm_ray_tally_is_stray(const pm_light_law *law, pm_vec3 local);

#endif

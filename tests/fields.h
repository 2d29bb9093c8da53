// Photon fields laid out by hand or by chance around a point of the floor, and asked.
#ifndef PM_FIELDS_H
#define PM_FIELDS_H

#include "estimate.h"
#include "rng.h"

#define PM_FIELDS_K_MAX 128u

/// The origin of the floor z = 0, seen from above.
extern const pm_estimate_point pm_fields_floor;

pm_rng pm_fields_rng(uint64_t trial);

/// Unit exponential.
double pm_fields_exponential(pm_rng *rng);

/// One photon that flies down; the normal zero: in a medium.
void pm_fields_push(pm_photon_map *map, pm_vec3 at, pm_vec3 normal, double power);

/// Makes an emptied map ready for pushing; scales it by 1 and balances it.
void pm_fields_empty(pm_photon_map *map);
void pm_fields_finish(pm_photon_map *map);

/// Irradiance, which must be PM_OK; k at most PM_FIELDS_K_MAX.
pm_estimate pm_fields_ask(const pm_photon_map *map, const pm_estimate_settings *settings,
                          const pm_estimate_point *point);

/// An even field of unit density on the floor around the origin: `count` photons, or all inside
/// the area `limit`. Powers are 1, or 0.5 and 1.5 as chance has it. The area pi r^2 up to each
/// photon is a sum of unit exponentials.
void pm_fields_lay_out(pm_photon_map *map, pm_rng *rng, uint32_t count, double limit,
                       bool uneven);

typedef struct {
    double mean, sd;
} pm_moments;

pm_moments pm_fields_moments(double sum, double sum2, int trials);

#endif

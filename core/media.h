// What a path through a medium picks up: single scattering straight from the lights (single.h),
// all other light from the volume map, by one of two queries over the same photons that check
// each other: a beam (beams.h), or a march of balls.
//
// Invariant: photons that come straight from a light are skipped in the map, since single
// scattering is sampled; so each path counts once.
#ifndef PM_MEDIA_H
#define PM_MEDIA_H

#include "gather.h"

/// In-scattered radiance along a stretch of an eye path.
/// @param radiance  [out] arriving at the start of the stretch
pm_status pm_media_seen(pm_gather *gather, const pm_stretch *along, pm_spectrum *radiance);

/// The same along a gather ray, by one sample of each light.
pm_status pm_media_gathered(pm_gather *gather, const pm_stretch *along, pm_rng *rng,
                            pm_spectrum *radiance);

/// The ray march alone: sum over steps of transmittance * estimate * step, each at a random
/// place of its step, between the start of `along` and where it leaves the photons' box or
/// ends.
///
/// @param step      [m] > 0
/// @param settings  of the estimates; `skip` as given
/// @param scratch   room for settings->k
/// @param radiance  [out]
/// @source Jensen and Christensen, "Efficient Simulation of Light Transport in Scenes with
/// Participating Media using Photon Maps", SIGGRAPH 1998
pm_status pm_media_march(const pm_photon_map *map, const pm_estimate_settings *settings,
                         const pm_medium *medium, const pm_ray *along, double step, pm_rng *rng,
                         pm_neighbour *scratch, pm_spectrum *radiance);

/// The step [m] of a march by default: half a mean free path, but no more than a fortieth of
/// the photons' box across.
double pm_media_step(const pm_photon_map *map, const pm_medium *medium);

#endif

// What a path through a medium picks up: single scattering straight from the lights (single.h),
// all other light from the volume map, by one of two queries over the same photons that check
// each other: a beam (beams.h), or a march of balls.
//
// Invariant: photons that come straight from a light are skipped in the map, since single
// scattering is sampled; so each path counts once. Where a medium ends both queries count what
// is on this side alone (rim.h).
#ifndef PM_MEDIA_H
#define PM_MEDIA_H

#include "gather.h"

/// In-scattered radiance along a stretch of an eye path. Its single scattering takes the
/// sample's share of the pixel's light points. Without a volume map that is all.
/// @param radiance  [out] arriving at the start of the stretch
/// @return PM_EINPUT when the volume map is to be asked by beams and there are none
pm_status pm_media_seen(pm_gather *gather, const pm_stretch *along, pm_spectrum *radiance);

/// The same along a gather ray, by one sample of each light.
pm_status pm_media_gathered(pm_gather *gather, const pm_stretch *along, pm_rng *rng,
                            pm_spectrum *radiance);

/// A ray march and what it asks.
typedef struct {
    const pm_intersector *world; // in which media end; NULL: they go on for ever
    const pm_photon_map *map;    // volume map; balanced and scaled
    pm_vec3 low, high;           // box around its photons
    pm_estimate_settings estimate;
    double step;           // [m] > 0
    pm_neighbour *scratch; // room for estimate.k
} pm_march;

/// The march alone: sum over equal steps, none longer than march->step, of transmittance *
/// estimate * step, each at a random place of its step. From the start of `along`, or where it
/// enters the box, to its end, or where it leaves the box; the box grown by a finite reach of
/// the estimate. One number of `rng` a step.
///
/// @param radiance  [out] untouched unless PM_OK
/// @return PM_EINPUT when the step is not > 0, or what pm_estimate_volume() refuses; PM_ELIMIT
///         when the way takes 2^32 steps or more
/// @source Jensen and Christensen, "Efficient Simulation of Light Transport in Scenes with
/// Participating Media using Photon Maps", SIGGRAPH 1998
pm_status pm_media_march(const pm_march *march, const pm_medium *medium, const pm_ray *along,
                         pm_rng *rng, pm_spectrum *radiance);

/// The step [m] of a march by default: half a mean free path, but no more than a fortieth of
/// the longest side of the photons' box. Infinite where nothing scatters.
double pm_media_step(const pm_march *march, const pm_medium *medium);

#endif

// Single scattering: light that comes straight from a light to a point in a medium and is
// scattered there into the path. No photons are asked.
//
// Invariant: points along the path are drawn by the distance to the light (equiangular) and by
// what the medium lets through, directions by the light and by the phase function; the balance
// heuristic weighs them, so each path counts once.
// @source Kulla and Fajardo, "Importance Sampling Techniques for Path Tracing in Participating
// Media", CGF 31(4), 2012
#ifndef PM_SINGLE_H
#define PM_SINGLE_H

#include "direct.h"

/// Radiance [W/(m^2 sr)] that arrives at the start of `along` after light straight from all
/// lights, constant ones too, was scattered once between there and its end, attenuated on both
/// ways. Surfaces other than null block the light.
///
/// @param along  in a medium; t_max may be INFINITY
/// @param query  `samples`, `first`, `step` and `shift` spread points along the path for each
///               light; `rng` draws the rest; shadow photons are not asked
pm_spectrum pm_single(pm_direct_query *query, const pm_ray *along);

#endif

// Light that reaches a surface straight from the lights.
//
// Each light is asked by shadow rays to points drawn on it. Where a surface is glossy, or the
// light is all around, the surface's own lobes draw directions too, and both answers are
// weighed by the balance heuristic, so each path counts once.
// @source Veach and Guibas, "Optimally Combining Sampling Techniques", SIGGRAPH 1995
#ifndef PM_DIRECT_H
#define PM_DIRECT_H

#include "intersect.h"
#include "material.h"
#include "shadow.h"

/// Who asks and how. Area lights are drawn at `samples` points: the points `first`, `first +
/// step`, .. of a lattice of samples * step with the given shift, so that several calls share
/// one even spread.
typedef struct {
    const pm_intersector *world;
    uint32_t samples, first, step;
    double shift[2];
    pm_rng rng;                    // for what the lobes draw
    const pm_shadow_maps *shadows; // NULL: rays decide everywhere
    pm_neighbour *scratch;         // with shadows: PM_SHADOW_K entries
    uint64_t rays, spared;         // [in, out] rays shot, those along drawn directions too, and
                                   // those that shadow photons made needless
} pm_direct_query;

/// Radiance [W/(m^2 sr)] that leaves `hit` towards lobes->wi by its D lobes after coming
/// straight from all lights, constant ones too. Every surface but null blocks.
///
/// Glossy D lobes draw `samples` directions each where there is a lamp to meet, any D lobe
/// where there is a constant light. Shadow photons stand in for rays to points on lights only.
pm_spectrum pm_direct(pm_direct_query *query, const pm_hit *hit, const pm_lobes *lobes);

/// The same for the S lobes that are not smooth, but only the share of it that drawing points
/// on lights has: the rest is found where the path goes on by such a lobe and meets a light
/// (pm_direct_weight()).
pm_spectrum pm_direct_glint(pm_direct_query *query, const pm_hit *hit, const pm_lobes *lobes);

/// The balance heuristic's share of a direction drawn with density `pdf` where another
/// technique draws it with density `other` (both [1/sr]). A density may be infinite, as that
/// of a lamp seen edge-on.
static inline double pm_direct_weight(double pdf, double other)
{
    return pdf > 0.0 ? 1.0 / (1.0 + other / pdf) : 0.0;
}

#endif

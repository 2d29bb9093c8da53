// Stub: filled in by its owner.
#include "single.h"

pm_spectrum pm_single(pm_direct_query *query, const pm_ray *along)
{
    (void)query;
    (void)along;
    return pm_gray(0.0);
}

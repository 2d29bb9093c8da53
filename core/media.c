// Each stretch is asked twice: the lights for what they send there straight, the map for all
// the rest.
#include "media.h"

#include "lookup.h"
#include "medium.h"
#include "single.h"

#include <stddef.h>

// --- the march ------------------------------------------------------------------------------

/// Part of a ray, as lengths [m] from its start.
typedef struct {
    double from, to;
} stretch;

/// The part of a stretch between two planes across an axis.
static stretch between(stretch part, double origin, double direction, double low, double high)
{
    if (direction == 0.0) {
        bool outside = origin < low || origin > high;
        return outside ? (stretch){0.0, 0.0} : part;
    }
    double one = (low - origin) / direction;
    double other = (high - origin) / direction;
    part.from = pm_most(part.from, pm_least(one, other));
    part.to = pm_least(part.to, pm_most(one, other));
    return part;
}

/// The part of a ray that runs where the photons can be seen from.
static stretch near_photons(const pm_march *march, const pm_ray *along)
{
    double grown = isfinite(march->estimate.radius) ? march->estimate.radius : 0.0;
    stretch part = {0.0, along->t_max};
    for (int axis = 0; axis < 3; axis++) {
        part = between(
            part, pm_vec_axis(along->origin, axis), pm_vec_axis(along->direction, axis),
            pm_vec_axis(march->low, axis) - grown, pm_vec_axis(march->high, axis) + grown);
    }
    return part;
}

static pm_status count_steps(const pm_march *march, double length, uint32_t *steps)
{
    if (!(march->step > 0.0)) {
        return PM_FAIL(PM_EINPUT, "a march's step must be > 0, got %g", march->step);
    }
    double count = ceil(length / march->step);
    if (!(count < 0x1p32)) {
        return PM_FAIL(PM_ELIMIT, "steps of %g m over %g m are too many: at most 2^32 - 1",
                       march->step, length);
    }
    *steps = (uint32_t)pm_most(count, 0.0);
    return PM_OK;
}

pm_status pm_media_march(const pm_march *march, const pm_medium *medium, const pm_ray *along,
                         pm_rng *rng, pm_spectrum *radiance)
{
    stretch part = near_photons(march, along);
    double length = pm_most(part.to - part.from, 0.0);
    uint32_t steps = 0;
    PM_TRY(count_steps(march, length, &steps));
    pm_vec3 wo = pm_vec_negate(along->direction);
    double step = length / pm_most(steps, 1.0);
    pm_spectrum sum = pm_gray(0.0);
    for (uint32_t i = 0; i < steps; i++) {
        double t = part.from + (i + pm_rng_draw(rng)) * step;
        pm_vec3 at = pm_vec_along(along->origin, along->direction, t);
        pm_rim rim = pm_rim_find(march->world, at, march->estimate.radius);
        pm_estimate scattered;
        PM_TRY(pm_estimate_beside(march->map, &march->estimate, at, &rim, medium, wo,
                                  march->scratch, &scattered));
        double weight = pm_medium_transmittance(medium, t) * step;
        sum = pm_spectrum_add(sum, pm_spectrum_scale(scattered.value, weight));
    }
    *radiance = sum;
    return PM_OK;
}

double pm_media_step(const pm_march *march, const pm_medium *medium)
{
    pm_vec3 side = pm_vec_sub(march->high, march->low);
    double longest = pm_vec_reach(side) / 40.0;
    double path = medium->sigma_t > 0.0 ? 0.5 / medium->sigma_t : HUGE_VAL;
    return longest > 0.0 ? pm_least(longest, path) : path;
}

// --- stretches of paths ---------------------------------------------------------------------

static const pm_medium *medium_of(const pm_gather *gather, const pm_ray *along)
{
    return &gather->compose->world->scene->media[along->medium];
}

static pm_march march_of(const pm_gather *gather, const pm_medium *medium)
{
    pm_march march = {
        .world = gather->compose->world,
        .map = gather->map[PM_MAP_VOLUME],
        .low = gather->low,
        .high = gather->high,
        .estimate = pm_lookup_asked(gather, PM_MAP_VOLUME),
        .step = gather->settings.step,
        .scratch = gather->scratch,
    };
    march.estimate.skip = PM_PHOTON_FIRST;
    march.step = march.step > 0.0 ? march.step : pm_media_step(&march, medium);
    return march;
}

static bool scatters(const pm_medium *medium)
{
    return medium->sigma_t > 0.0 && !pm_spectrum_is_black(medium->albedo);
}

/// Light scattered more than once, by the way the settings say. A medium that scatters nothing
/// asks for none: photons near by are those of another medium, round the corner.
static pm_status ask_map(const pm_gather *gather, const pm_ray *along, pm_rng *rng,
                         pm_spectrum *radiance)
{
    const pm_medium *medium = medium_of(gather, along);
    *radiance = pm_gray(0.0);
    if (gather->map[PM_MAP_VOLUME] == NULL || !scatters(medium)) {
        return PM_OK;
    }
    if (gather->settings.media == PM_MEDIA_MARCH) {
        pm_march march = march_of(gather, medium);
        return pm_media_march(&march, medium, along, rng, radiance);
    }
    if (gather->beams == NULL) {
        return PM_FAIL(PM_EINPUT, "%s", "the volume map has no beams to be asked by");
    }
    *radiance = pm_beams_query(gather->beams, medium, along).radiance;
    return PM_OK;
}

/// Both answers; the query's numbers serve the march, too.
static pm_status ask_both(pm_gather *gather, const pm_ray *along, pm_direct_query *query,
                          pm_spectrum *radiance)
{
    pm_spectrum single = pm_single(query, along);
    pm_spectrum multiple;
    pm_gather_count(gather, query);
    PM_TRY(ask_map(gather, along, &query->rng, &multiple));
    *radiance = pm_spectrum_add(single, multiple);
    return PM_OK;
}

pm_status pm_media_seen(pm_gather *gather, const pm_stretch *along, pm_spectrum *radiance)
{
    pm_direct_query query =
        pm_gather_share(gather, along->pixel, along->sample, along->number, PM_GATHER_FOG);
    return ask_both(gather, &along->ray, &query, radiance);
}

pm_status pm_media_gathered(pm_gather *gather, const pm_stretch *along, pm_rng *rng,
                            pm_spectrum *radiance)
{
    pm_direct_query query = pm_gather_single(gather, rng);
    PM_TRY(ask_both(gather, &along->ray, &query, radiance));
    *rng = query.rng;
    return PM_OK;
}

// Density estimation: powers of the nearest photons, weighed, over the area that they fill.
//
// Invariant: which photons count and what area they stand for are decided once (reach_of), the
// same for irradiance, radiance and the volume estimate. The photon that sets the radius is the
// one left out, whatever the kernel gives it.
// @source Jensen 2001, ch. 7; Garcia et al., CGF 31(1), 2012, for the (k-1) form
#include "estimate.h"

#include "coarse_normal.h"
#include "medium.h"
#include "photon_map.h"
#include "store.h"

#include <stddef.h>

// A photon's coarse normal is up to 2.7 degrees off. Walls that meet at a right angle must not
// lose each other's photons by that, so the side test lets -sin(2.9 degrees) pass; the far side
// of a wall is at -1.
#define SIDE_SLACK (-0.05)

#define LEFT_OUT_NONE UINT32_MAX

/// What a search's result amounts to.
typedef struct {
    uint32_t found;
    uint32_t left_out; // place in the list of the photon that only sets the radius
    double radius2;    // squared, in the measure of the search, > 0 when a photon counts
    double flat2;      // the same in the plane of the disc
    bool floored;
} extent;

pm_estimate_settings pm_estimate_defaults(void)
{
    return (pm_estimate_settings){
        .k = 100,
        .radius = HUGE_VAL,
        .shape = PM_GATHER_DISC,
        .flatness = 0.1,
        .filter = PM_FILTER_NONE,
        .constants = PM_CONSTANTS_UNBIASED,
    };
}

static pm_status check(const pm_photon_map *map, const pm_estimate_settings *settings)
{
    if (!map->scaled && map->count > 0) {
        return PM_FAIL(PM_EINPUT, "%s", "the photon map must be scaled before it is asked");
    }
    if (!(settings->radius > 0.0 && settings->radius * settings->radius > 0.0)) {
        return PM_FAIL(PM_EINPUT, "radius must be > 0, squared too, got %g", settings->radius);
    }
    if (!(settings->flatness > 0.0 && settings->flatness <= 1.0)) {
        return PM_FAIL(PM_EINPUT, "flatness must lie in (0, 1], got %g", settings->flatness);
    }
    return PM_OK;
}

// --- which photons count --------------------------------------------------------------------

bool pm_estimate_accept(const void *context, const pm_photon *photon, double *distance2)
{
    const pm_estimate_query *query = context;
    pm_vec3 normal = query->point.normal;
    if ((photon->flags & query->skip) != 0 || (photon->flags & query->only) != query->only ||
        !pm_normal_within(photon->flags >> PM_PHOTON_NORMAL_SHIFT, normal, SIDE_SLACK)) {
        return false;
    }
    pm_vec3 away = pm_vec((double)photon->position[0] - query->point.at.x,
                          (double)photon->position[1] - query->point.at.y,
                          (double)photon->position[2] - query->point.at.z);
    *distance2 = pm_vec_dot(away, away);
    if (query->shape == PM_GATHER_DISC) {
        // In-plane^2 + (height / flatness)^2. Not by 1 / flatness^2: where that overflows, even
        // photons in the plane would come out as NaN.
        double height = pm_vec_dot(away, normal);
        double stretched = height / query->flatness;
        *distance2 += (stretched - height) * (stretched + height);
    }
    return true;
}

/// How much farther than its Euclidean distance a plane across an axis is for a disc. The least
/// p^T (I + s n n^T) p over p_a >= d is d^2 / (1 - s/(1+s) n_a^2), with 1 + s = 1 / flatness^2.
/// Taken down by far more than its rounding, as it may only be too small.
static void widen_planes(const pm_estimate_query *query, double widen[3])
{
    double flatten = 1.0 - query->flatness * query->flatness;
    for (int a = 0; a < 3 && query->shape == PM_GATHER_DISC; a++) {
        double along = pm_vec_axis(query->point.normal, a);
        widen[a] = (1.0 - 0x1p-40) / (1.0 - flatten * along * along);
    }
}

// --- how large an area they stand for -------------------------------------------------------

/// The smallest radius that float positions around `at` can tell from 0.
static double least_radius(pm_vec3 at)
{
    float reach = (float)pm_vec_reach(at);
    return (double)nextafterf(reach, INFINITY) - (double)reach;
}

static uint32_t farthest(const pm_neighbour *nearest, uint32_t found)
{
    uint32_t last = 0;
    for (uint32_t i = 1; i < found; i++) {
        last = nearest[i].distance2 > nearest[last].distance2 ? i : last;
    }
    return last;
}

/// Squared distance, in the plane of the disc, of the photon that is widest there. Where the
/// surface curves away photons lie off the plane, and their distance in the disc's measure is
/// longer than the radius that they fill.
static double widest2(const pm_photon_map *map, const pm_estimate_query *query,
                      const pm_neighbour *nearest, uint32_t found)
{
    double widest = 0.0;
    for (uint32_t i = 0; i < found; i++) {
        const float *at = map->photons[nearest[i].index].position;
        pm_vec3 position = pm_vec((double)at[0], (double)at[1], (double)at[2]);
        pm_vec3 away = pm_vec_sub(position, query->point.at);
        double height = pm_vec_dot(away, query->point.normal);
        widest = pm_most(widest, pm_vec_dot(away, away) - height * height);
    }
    return widest;
}

/// The rule of the header: k found, or no reach: the farthest photon sets the radius and is
/// left out (the lecture keeps it); fewer in a finite reach: all count, over the area of the
/// reach.
static extent extent_of(const pm_estimate_settings *settings, pm_vec3 at,
                        const pm_neighbour *nearest, uint32_t found)
{
    double reach2 = settings->radius * settings->radius;
    extent result = {found, LEFT_OUT_NONE, reach2, reach2, false};
    if (found == 0 || (found < settings->k && isfinite(settings->radius))) {
        return result;
    }
    uint32_t last = farthest(nearest, found);
    double least = least_radius(at);
    result.left_out = settings->plain_k ? LEFT_OUT_NONE : last;
    result.floored = nearest[last].distance2 < least * least;
    result.radius2 = result.floored ? least * least : nearest[last].distance2;
    result.flat2 = result.radius2;
    return result;
}

/// The area of a disc is that in its plane, where a photon set its radius.
static void flatten(const pm_photon_map *map, const pm_estimate_settings *settings,
                    const pm_estimate_query *query, const pm_neighbour *nearest, extent *area)
{
    bool by_reach = area->found < settings->k && isfinite(settings->radius);
    if (query->shape == PM_GATHER_DISC && area->found > 0 && !by_reach) {
        double least = least_radius(query->point.at);
        area->flat2 = pm_most(widest2(map, query, nearest, area->found), least * least);
    }
}

static pm_status search(const pm_photon_map *map, const pm_estimate_settings *settings,
                        pm_search what, pm_neighbour *nearest, extent *result)
{
    uint32_t found;
    what.k = settings->k;
    what.radius2 = settings->radius * settings->radius;
    PM_TRY(pm_balance_nearest(map, &what, nearest, &found, NULL));
    *result = extent_of(settings, what.at, nearest, found);
    return PM_OK;
}

// --- sums -----------------------------------------------------------------------------------

/// A photon's share by direction: bsdf, phase function, or 1.
typedef pm_spectrum (*response_fn)(const void *context, const pm_photon_view *photon);

static pm_spectrum answer(const pm_photon_map *map, uint32_t index, response_fn response,
                          const void *context)
{
    if (response == NULL) {
        return pm_store_power(map, index);
    }
    pm_photon_view photon = pm_store_unpack(map, index);
    return pm_spectrum_mul(photon.power, response(context, &photon));
}

/// Sums response * weight * power over the photons that count.
static pm_status sum_weighed(const pm_photon_map *map, const pm_estimate_settings *settings,
                             const pm_neighbour *nearest, const extent *area,
                             response_fn response, const void *context, pm_spectrum *sum)
{
    *sum = pm_gray(0.0);
    for (uint32_t i = 0; i < area->found; i++) {
        if (i == area->left_out) {
            continue;
        }
        double weight;
        double u = nearest[i].distance2 / area->radius2;
        PM_TRY(pm_filter_weight(settings->filter, settings->constants, u, &weight));
        pm_spectrum power = answer(map, nearest[i].index, response, context);
        *sum = pm_spectrum_add(*sum, pm_spectrum_scale(power, weight));
    }
    return PM_OK;
}

static pm_estimate make_estimate(const extent *area, pm_spectrum sum, double measure)
{
    bool none = area->found == 0;
    return (pm_estimate){
        .value = none ? pm_gray(0.0) : pm_spectrum_scale(sum, 1.0 / measure),
        .radius = none ? 0.0 : sqrt(area->flat2),
        .found = area->found,
        .floored = area->floored,
    };
}

static pm_status estimate_surface(const pm_photon_map *map,
                                  const pm_estimate_settings *settings,
                                  const pm_estimate_point *point, response_fn response,
                                  const void *context, pm_neighbour *scratch, pm_estimate *out)
{
    PM_TRY(check(map, settings));
    pm_estimate_query query = {*point, settings->shape, settings->flatness, settings->skip,
                               settings->only};
    pm_search what = {.at = point->at, .accept = pm_estimate_accept, .context = &query};
    widen_planes(&query, what.widen);
    extent area;
    pm_spectrum sum;
    double normalisation;
    PM_TRY(pm_filter_normalisation(settings->filter, settings->constants, &normalisation));
    PM_TRY(search(map, settings, what, scratch, &area));
    flatten(map, settings, &query, scratch, &area);
    PM_TRY(sum_weighed(map, settings, scratch, &area, response, context, &sum));
    *out = make_estimate(&area, sum, normalisation * PM_PI * area.flat2);
    return PM_OK;
}

pm_status pm_estimate_irradiance(const pm_photon_map *map, const pm_estimate_settings *settings,
                                 const pm_estimate_point *point, pm_neighbour *scratch,
                                 pm_estimate *out)
{
    return estimate_surface(map, settings, point, NULL, NULL, scratch, out);
}

/// The bsdf for a photon that came along its direction. The photon passed the side test by its
/// normal; where the coarse direction says otherwise near grazing, it is mirrored back above.
static pm_spectrum reflected(const void *context, const pm_photon_view *photon)
{
    const pm_lobes *lobes = context;
    pm_vec3 from = pm_vec_negate(photon->direction);
    double above = pm_vec_dot(from, lobes->normal);
    if (above < 0.0) {
        from = pm_vec_along(from, lobes->normal, -2.0 * above);
    }
    return pm_material_evaluate(lobes, from);
}

pm_status pm_estimate_radiance(const pm_photon_map *map, const pm_estimate_settings *settings,
                               const pm_estimate_point *point, const pm_lobes *lobes,
                               pm_neighbour *scratch, pm_estimate *out)
{
    if (!pm_material_is_lambertian(lobes)) {
        return estimate_surface(map, settings, point, reflected, lobes, scratch, out);
    }
    // One factor for all photons, whose directions need not be decoded then.
    pm_estimate found;
    PM_TRY(estimate_surface(map, settings, point, NULL, NULL, scratch, &found));
    found.value = pm_spectrum_mul(found.value, pm_material_evaluate(lobes, lobes->normal));
    *out = found;
    return PM_OK;
}

// --- volume ---------------------------------------------------------------------------------

typedef struct {
    const pm_medium *medium;
    pm_vec3 wo;
} scattering;

/// Albedo times phase function [1/sr].
static pm_spectrum scattered(const void *context, const pm_photon_view *photon)
{
    const scattering *to = context;
    double phase = pm_medium_phase(to->medium, pm_vec_dot(photon->direction, to->wo));
    return pm_spectrum_scale(to->medium->albedo, phase);
}

/// Who counts in a ball. Without a normal: in a medium no side is the wrong one.
typedef struct {
    pm_estimate_query query;
    const pm_rim *rim;
} ball_query;

/// In the manner of pm_estimate_accept().
static bool is_inside(const void *context, const pm_photon *photon, double *distance2)
{
    const ball_query *ball = context;
    pm_vec3 place = pm_vec((double)photon->position[0], (double)photon->position[1],
                           (double)photon->position[2]);
    return pm_rim_is_before(ball->rim, pm_vec_sub(place, ball->query.point.at)) &&
           pm_estimate_accept(&ball->query, photon, distance2);
}

/// Volume of a ball before a plane that passes its middle at `distance`.
static double volume_before(double radius, double distance)
{
    double y = pm_least(distance / radius, 1.0);
    return PM_PI / 3.0 * radius * radius * radius * (2.0 + 3.0 * y - y * y * y);
}

pm_status pm_estimate_beside(const pm_photon_map *map, const pm_estimate_settings *settings,
                             pm_vec3 at, const pm_rim *rim, const pm_medium *medium, pm_vec3 wo,
                             pm_neighbour *scratch, pm_estimate *out)
{
    PM_TRY(check(map, settings));
    pm_estimate_settings constant = *settings;
    constant.filter = PM_FILTER_NONE; // kernels are made for discs
    scattering to = {medium, wo};
    ball_query query = {{{.at = at}, PM_GATHER_SPHERE, 1.0, settings->skip, settings->only},
                        rim};
    pm_search what = {.at = at, .accept = is_inside, .context = &query};
    extent ball;
    pm_spectrum sum;
    PM_TRY(search(map, &constant, what, scratch, &ball));
    PM_TRY(sum_weighed(map, &constant, scratch, &ball, medium != NULL ? scattered : NULL, &to,
                       &sum));
    *out = make_estimate(&ball, sum, volume_before(sqrt(ball.radius2), (double)rim->distance));
    return PM_OK;
}

pm_status pm_estimate_volume(const pm_photon_map *map, const pm_estimate_settings *settings,
                             pm_vec3 at, const pm_medium *medium, pm_vec3 wo,
                             pm_neighbour *scratch, pm_estimate *out)
{
    return pm_estimate_beside(map, settings, at, &pm_rim_none, medium, wo, scratch, out);
}

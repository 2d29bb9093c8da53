// In the plane of centre and ray, s = t - foot is the place on the ray, D = apart its distance
// from the centre; both angles there are computed from cross and dot products, so that a ray
// that nearly meets the centre loses no digits.
#include "span.h"

static double square(double x)
{
    return x * x;
}

pm_span pm_span_all(const pm_ray *along, double sigma_t)
{
    return (pm_span){
        .end = along->t_max,
        .sigma_t = sigma_t,
        .ends = -expm1(-sigma_t * along->t_max),
    };
}

/// Between the directions from the centre to the two ends.
static double angle_of(const pm_span *span)
{
    double first = span->begin - span->foot;
    if (span->end == HUGE_VAL) {
        return atan2(span->apart, first);
    }
    double last = span->end - span->foot;
    return atan2(span->apart * (span->end - span->begin), square(span->apart) + first * last);
}

/// From the centre to the ray's foot. Made normal to the ray twice, for rays close by.
static pm_vec3 to_ray(const pm_span *span, const pm_ray *along, pm_vec3 centre)
{
    pm_vec3 foot = pm_vec_along(along->origin, along->direction, span->foot);
    pm_vec3 way = pm_vec_sub(foot, centre);
    return pm_vec_along(way, along->direction, -pm_vec_dot(way, along->direction));
}

void pm_span_about(pm_span *span, const pm_ray *along, pm_vec3 centre, double blur)
{
    pm_vec3 way = pm_vec_sub(centre, along->origin);
    span->foot = pm_vec_dot(way, along->direction);
    pm_vec3 aside = to_ray(span, along, centre);
    span->apart = sqrt(pm_vec_dot(aside, aside) + square(blur));
    span->angle = square(span->apart) > 0.0 ? angle_of(span) : 0.0;
}

/// The span between two angles at the centre, from the foot on.
static bool clip_angles(pm_span *span, double low, double high)
{
    if (low >= 0.5 * PM_PI || high <= -0.5 * PM_PI) {
        return false;
    }
    if (low > -0.5 * PM_PI) {
        span->begin = pm_most(span->begin, span->foot + span->apart * tan(low));
    }
    if (high < 0.5 * PM_PI) {
        span->end = pm_least(span->end, span->foot + span->apart * tan(high));
    }
    return span->begin < span->end;
}

bool pm_span_clip(pm_span *span, const pm_ray *along, const pm_light *spot)
{
    if (span->angle == 0.0 || spot->cutoff >= 0.5 * PM_PI) {
        return true;
    }
    pm_vec3 aside = pm_vec_normalize(to_ray(span, along, spot->position));
    pm_vec3 across = pm_vec_cross(aside, along->direction);
    // The cone cuts the plane in a wedge about the axis laid into the plane. cos(half) =
    // cos(cutoff) / length of the laid axis, written for narrow cones by sines.
    double half2 = square(sin(spot->cutoff)) - square(pm_vec_dot(spot->direction, across));
    if (half2 <= 0.0) {
        return false;
    }
    double half = atan2(sqrt(half2), cos(spot->cutoff));
    double middle = atan2(pm_vec_dot(spot->direction, along->direction),
                          pm_vec_dot(spot->direction, aside));
    if (!clip_angles(span, middle - half, middle + half)) {
        return false;
    }
    span->ends = -expm1(-span->sigma_t * (span->end - span->begin));
    span->angle = angle_of(span);
    return true;
}

/// By what the medium lets through.
static double draw_through(const pm_span *span, double u)
{
    return span->begin - log1p(-u * span->ends) / span->sigma_t;
}

/// By the angle at the centre.
static double draw_about(const pm_span *span, double u)
{
    double first = span->begin - span->foot;
    double sine = sin(u * span->angle);
    double down = span->apart * cos(u * span->angle) - first * sine;
    double length = (square(first) + square(span->apart)) * sine / down;
    return down > 0.0 ? span->begin + length : span->end;
}

double pm_span_draw(const pm_span *span, double u)
{
    double t;
    if (span->angle == 0.0) {
        t = draw_through(span, u);
    } else {
        t = u < 0.5 ? draw_about(span, 2.0 * u) : draw_through(span, 2.0 * u - 1.0);
    }
    return pm_most(span->begin, pm_least(span->end, t)); // rounding only
}

double pm_span_pdf(const pm_span *span, double t)
{
    double through = span->sigma_t * exp(-span->sigma_t * (t - span->begin)) / span->ends;
    if (span->angle == 0.0) {
        return through;
    }
    double distance2 = square(span->apart) + square(t - span->foot);
    double about = span->apart / (span->angle * distance2);
    return 0.5 * (about + through);
}

// Distances along a ray through a medium: densities against the draws and against 1, and the
// cone of a spot against its own falloff.
#include "span.h"

#include "chance.h"
#include "integrals.h"
#include "light.h"
#include "shapes.h"
#include "test.h"

static const pm_vec3 origin = {0.0, 0.0, 0.0};
static const pm_vec3 forward = {0.0, 0.0, 1.0};

static pm_ray ray_of(double t_max)
{
    return (pm_ray){origin, forward, t_max, 0.0, 0};
}

/// A span of length `t_max` whose centre is `ahead` along the ray and `aside` of it.
static pm_span span_about(double t_max, double sigma_t, double ahead, double aside)
{
    pm_ray ray = ray_of(t_max);
    pm_span span = pm_span_all(&ray, sigma_t);
    pm_span_about(&span, &ray, pm_vec(aside, 0.0, ahead), 0.0);
    return span;
}

/// How many of 20000 draws lie in each twentieth of the range of `share`, the closed form of
/// the half of the density that the draws below 1/2, or from there on, stand for.
static void count_draws(const pm_span *span, bool about,
                        double (*share)(const pm_span *, double), uint64_t counts[20])
{
    for (int i = 0; i < 20; i++) {
        counts[i] = 0;
    }
    for (int i = 0; i < 20000; i++) {
        pm_rng rng = pm_shapes_rng((uint64_t)i, 0);
        double half = span->angle > 0.0 ? 0.5 : 1.0;
        double u = half * pm_rng_draw(&rng) + (about || half == 1.0 ? 0.0 : 0.5);
        double t = pm_span_draw(span, u);
        CHECK(t >= span->begin && t <= span->end);
        int cell = (int)(20.0 * share(span, t));
        counts[cell < 20 ? cell : 19]++;
    }
}

/// Share of the light lost on the span that is lost before t.
static double lost_before(const pm_span *span, double t)
{
    return expm1(-span->sigma_t * (t - span->begin)) /
           expm1(-span->sigma_t * (span->end - span->begin));
}

/// Share of the angle at the centre, by two arctangents.
static double seen_before(const pm_span *span, double t)
{
    double low = atan((span->begin - span->foot) / span->apart);
    double high = atan((span->end - span->foot) / span->apart);
    return (atan((t - span->foot) / span->apart) - low) / (high - low);
}

static const double endings[3] = {0.5, 4.0, HUGE_VAL};

static void draws_follow_both_laws(void)
{
    for (int i = 0; i < 3; i++) {
        uint64_t counts[20];
        pm_ray ray = ray_of(endings[i]);
        pm_span plain = pm_span_all(&ray, 1.7);
        count_draws(&plain, false, lost_before, counts);
        CHECK_EVEN(counts, 20);
        for (double ahead = -1.0; ahead < 6.0; ahead += 2.0) {
            pm_span span = span_about(endings[i], 1.7, ahead, 0.3);
            count_draws(&span, false, lost_before, counts);
            CHECK_EVEN(counts, 20);
            count_draws(&span, true, seen_before, counts);
            CHECK_EVEN(counts, 20);
        }
    }
}

static double density(double t, void *span)
{
    return pm_span_pdf(span, t);
}

static void densities_add_up_to_one(void)
{
    for (int i = 0; i < 3; i++) {
        for (double sigma_t = 0.01; sigma_t < 20.0; sigma_t *= 10.0) {
            pm_ray ray = ray_of(endings[i]);
            pm_span plain = pm_span_all(&ray, sigma_t);
            CHECK_NEAR(pm_integral(density, &plain, 0.0, endings[i]), 1.0, 1e-8);
            for (double ahead = -1.0; ahead < 6.0; ahead += 2.0) {
                pm_span span = span_about(endings[i], sigma_t, ahead, 0.2);
                CHECK_NEAR(pm_integral(density, &span, 0.0, endings[i]), 1.0, 1e-8);
            }
        }
    }
}

/// Every draw of the span is a number in it, with a density above 0 that is one, too.
static void check_draws(const pm_span *span)
{
    static const double u[7] = {0.0, 0x1p-53, 0.25, 0.5 - 0x1p-53, 0.5, 0.75, 1.0 - 0x1p-53};
    for (int i = 0; i < 7; i++) {
        double t = pm_span_draw(span, u[i]);
        CHECK(t >= span->begin && t <= span->end);
        CHECK(pm_span_pdf(span, t) >= 0.0 && (isfinite(t) || span->end == HUGE_VAL));
        CHECK(t == HUGE_VAL || pm_span_pdf(span, t) > 0.0);
    }
}

static void extremes_are_numbers(void)
{
    static const double lengths[4] = {1e-12, 1.0, 1e6, HUGE_VAL};
    static const double densities[4] = {1e-12, 1.0, 1e6, 1e12};
    static const double asides[6] = {0.0, 1e-300, 1e-100, 1e-16, 1.0, 1e6};
    static const double aheads[7] = {-1e6, -1.0, -1e-16, 0.0, 1e-16, 1.0, 1e6};
    for (int i = 0; i < 4 * 4 * 6 * 7; i++) {
        pm_span span = span_about(lengths[i % 4], densities[i / 4 % 4], aheads[i / 16 % 7],
                                  asides[i / 112]);
        check_draws(&span);
    }
    // Right through a centre there is nothing to go by but the medium.
    CHECK(span_about(2.0, 1.0, 1.0, 0.0).angle == 0.0);
    CHECK(span_about(2.0, 1.0, 1.0, 1e-100).angle == PM_PI);
}

static void grazing_centres_lose_no_digits(void)
{
    // Both ends on one side of a centre that is hardly aside: density a b / ((b - a) s^2).
    for (double aside = 1e-3; aside > 1e-60; aside *= 1e-9) {
        pm_span span = span_about(3.0, 1e-9, -0.5, aside);
        double about = pm_span_pdf(&span, 1.0) - 0.5 / 3.0;
        double want = 0.5 * 0.5 * 3.5 / 3.0 / (1.5 * 1.5);
        CHECK_NEAR(about, want, 1e-8 + 10.0 * aside * aside);
        // Half of it lies before the harmonic middle of 0.5 and 3.5.
        CHECK_NEAR(pm_span_draw(&span, 0.25), 2.0 / (1.0 / 0.5 + 1.0 / 3.5) - 0.5,
                   1e-8 + 10.0 * aside * aside);
    }
}

// --- spots ----------------------------------------------------------------------------------

/// Whether the spot lights the place `t` of the ray.
static bool is_lit(const pm_light *spot, const pm_ray *ray, double t)
{
    pm_vec3 place = pm_vec_along(ray->origin, ray->direction, t);
    pm_vec3 way = pm_vec_normalize(pm_vec_sub(place, spot->position));
    return pm_light_falloff(spot, pm_vec_dot(way, spot->direction)) > 0.0;
}

/// A spot anywhere, and whether its clipped span ends where its light does.
static bool check_spot(uint64_t number, double cutoff, double t_max)
{
    pm_rng rng = pm_shapes_rng(number, 1);
    pm_light spot = {.type = PM_LIGHT_SPOT, .beam = 0.5 * cutoff, .cutoff = cutoff};
    spot.position = pm_shapes_inside(&rng, 2.0);
    pm_vec3 target = pm_shapes_inside(&rng, 2.0);
    spot.direction = pm_vec_normalize(pm_vec_sub(target, spot.position));
    pm_vec3 from = pm_shapes_inside(&rng, 2.0);
    pm_vec3 through = pm_vec_along(target, pm_shapes_direction(&rng), 4.0 * cutoff);
    pm_vec3 way = pm_vec_normalize(pm_vec_sub(through, from));
    pm_ray ray = {from, way, t_max, 0.0, 0};
    pm_span span = pm_span_all(&ray, 1.0);
    pm_span_about(&span, &ray, spot.position, 0.0);
    bool left = pm_span_clip(&span, &ray, &spot);
    for (int i = 0; i < 300; i++) {
        // Nearly everywhere on the ray, and nearly at both ends of the span.
        double end = i % 3 == 1 ? span.begin : span.end;
        double t = i % 3 == 0 ? 0.04 * i : end + (i % 2 - 0.5) * 1e-6 * pm_most(1.0, fabs(end));
        bool inside = left && t >= span.begin && t <= span.end;
        if (t > 0.0 && t < t_max) {
            CHECK_THAT(inside == is_lit(&spot, &ray, t), "spot %d at %g", (int)number, t);
        }
    }
    if (left && number % 10 == 0) {
        CHECK_NEAR(pm_integral(density, &span, span.begin, span.end), 1.0, 1e-7);
    }
    return left;
}

static void cones_clip_where_the_light_ends(void)
{
    int left = 0;
    for (uint64_t i = 0; i < 300; i++) {
        left += check_spot(i, 0.02, HUGE_VAL);
        left += check_spot(i, 0.4, HUGE_VAL);
        left += check_spot(i, 1.5, 3.0);
    }
    CHECK_THAT(left > 300 && left < 850, "%d left", left); // both happen
}

static void wide_cones_are_not_clipped(void)
{
    pm_light spot = {.direction = {0.0, 0.0, 1.0}, .cutoff = 2.0};
    pm_span span = span_about(2.0, 1.0, 1.0, 0.5);
    pm_ray ray = ray_of(2.0);
    CHECK(pm_span_clip(&span, &ray, &spot) && span.begin == 0.0 && span.end == 2.0);
}

PM_TESTS({"span.1", "draws go by what a medium lets through, and by the angle at a centre",
          draws_follow_both_laws},
         {"span.2", "densities add up to one, on endless rays too", densities_add_up_to_one},
         {"span.3", "extreme lengths, densities and distances give numbers",
          extremes_are_numbers},
         {"span.4", "a ray that nearly meets the centre behind it loses no digits",
          grazing_centres_lose_no_digits},
         {"span.5", "a spot's cone clips the span where its light ends",
          cones_clip_where_the_light_ends},
         {"span.6", "cones of more than a half-space clip nothing", wide_cones_are_not_clipped})

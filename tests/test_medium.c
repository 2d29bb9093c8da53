// Free paths and the phase function, against closed forms: the cdf of Henyey and Greenstein is
// written here on its own.
#include "medium.h"

#include "chance.h"
#include "quadrature.h"
#include "shapes.h"
#include "test.h"

#include <math.h>

enum { COUNT = 40000 };

static const double gs[] = {-0.95, -0.5, 0.0, 1e-9, 0.5, 0.95};
enum { GS = sizeof gs / sizeof gs[0] };

static pm_medium scattering(double g)
{
    return (pm_medium){.sigma_t = 1.0, .albedo = pm_gray(1.0), .g = g};
}

/// Share of the phase function below `cosine`.
static double cdf(double g, double cosine)
{
    if (fabs(g) < 1e-6) {
        return 0.5 * (1.0 + cosine);
    }
    double root = sqrt(1.0 + g * g - 2.0 * g * cosine);
    return (1.0 - g * g) / (2.0 * g) * (1.0 / root - 1.0 / (1.0 + g));
}

/// The integrals of phase * cosine^power over all directions.
static double moment(double g, int power)
{
    enum { PANELS = 100, NODES = 64 };
    pm_medium medium = scattering(g);
    double node[NODES];
    double weight[NODES];
    pm_quadrature_nodes(NODES, node, weight);
    double sum = 0.0;
    for (int i = 0; i < PANELS * NODES; i++) {
        double cosine = -1.0 + 2.0 / PANELS * (i / NODES + node[i % NODES]);
        double value = pm_medium_phase(&medium, cosine) * pow(cosine, power);
        sum += 2.0 * PM_PI * value * 2.0 / PANELS * weight[i % NODES];
    }
    return sum;
}

static void the_phase_function_has_mean_cosine_g(void)
{
    for (int i = 0; i < GS; i++) {
        CHECK_NEAR(moment(gs[i], 0), 1.0, 1e-10);
        CHECK_NEAR(moment(gs[i], 1), gs[i], 1e-10);
        CHECK_NEAR(moment(gs[i], 2), (1.0 + 2.0 * gs[i] * gs[i]) / 3.0, 1e-10);
    }
}

static void the_phase_function_is_the_slope_of_its_cdf(void)
{
    const double h = 1e-5;
    for (int i = 0; i < GS; i++) {
        pm_medium medium = scattering(gs[i]);
        for (double cosine = -0.99; cosine < 1.0; cosine += 0.09) {
            double slope = (cdf(gs[i], cosine + h) - cdf(gs[i], cosine - h)) / (2.0 * h);
            double phase = 2.0 * PM_PI * pm_medium_phase(&medium, cosine);
            CHECK_NEAR(phase / slope, 1.0, 1e-5);
        }
    }
}

/// Cosines and azimuths of turns from `way`, in cells that are all equally likely.
static void check_turns(double g, pm_vec3 way, uint64_t first)
{
    enum { CELLS = 25 };
    pm_medium medium = scattering(g);
    pm_frame frame = pm_frame_around(way);
    uint64_t cosines[CELLS] = {0};
    uint64_t azimuths[CELLS] = {0};
    double mean = 0.0;
    for (uint64_t i = 0; i < COUNT; i++) {
        pm_rng rng = pm_shapes_rng(first + i, 0);
        pm_vec3 onward = pm_medium_turn(&medium, way, &rng);
        CHECK_NEAR(pm_vec_length(onward), 1.0, 1e-14);
        double cosine = fmin(1.0, fmax(-1.0, pm_vec_dot(onward, way)));
        double azimuth = atan2(pm_vec_dot(onward, frame.t), pm_vec_dot(onward, frame.s));
        int cell = (int)(CELLS * cdf(g, cosine));
        int sector = (int)(CELLS * (0.5 + 0.5 * azimuth / PM_PI));
        cosines[cell < CELLS ? cell : CELLS - 1]++;
        azimuths[sector < CELLS ? sector : CELLS - 1]++;
        mean += cosine / COUNT;
    }
    CHECK_NEAR(mean, g, pm_chance_bound((1.0 + 2.0 * g * g) / 3.0 - g * g, COUNT));
    CHECK_EVEN(cosines, CELLS);
    CHECK_EVEN(azimuths, CELLS);
}

static void turns_follow_the_phase_function(void)
{
    for (int i = 0; i < GS; i++) {
        check_turns(gs[i], pm_vec(0.0, 0.0, -1.0), (uint64_t)i * COUNT);
        check_turns(gs[i], pm_vec_normalize(pm_vec(3.0, -2.0, 1.0)),
                    (uint64_t)(i + GS) * COUNT);
    }
}

/// Half of all turns are within the median of the way on, or back, which is far narrower than
/// what a cosine can tell from 1.
static void narrow_turns_keep_their_digits(void)
{
    static const double ends[] = {1.0 - 0x1p-30, -1.0 + 0x1p-30};
    for (int i = 0; i < 2; i++) {
        double rest = 1.0 - fabs(ends[i]);
        pm_medium medium = scattering(ends[i]);
        double peak = pm_medium_phase(&medium, i == 0 ? 1.0 : -1.0);
        CHECK_NEAR(peak * 4.0 * PM_PI * rest * rest / (2.0 - rest), 1.0, 1e-12);
        int within = 0;
        for (uint64_t j = 0; j < COUNT; j++) {
            pm_rng rng = pm_shapes_rng(j, 1);
            pm_vec3 onward = pm_medium_turn(&medium, pm_vec(0.0, 0.0, 1.0), &rng);
            CHECK((onward.z > 0.0) == (i == 0) || fabs(onward.z) < 0.999);
            // sin^2 is about twice 1 - cos; its median is rest^2 (2 + |g|).
            within += onward.x * onward.x + onward.y * onward.y < 3.0 * rest * rest;
        }
        CHECK_NEAR((double)within / COUNT, 0.5, pm_chance_bound(0.25, COUNT));
    }
}

static void free_paths_are_exponential(void)
{
    CHECK_NEAR(pm_medium_collision_depth(0.0), 0.0, 0.0);
    for (double u = 1e-12; u < 1.0; u = 0.5 * (u + 1.0)) {
        CHECK_NEAR(exp(-pm_medium_collision_depth(u)), 1.0 - u, 1e-15);
    }
    // Depth 20 must be in reach: a number of 24 bits would end at 16.6.
    CHECK_NEAR(pm_medium_collision_depth(1.0 - 0x1p-53), 53.0 * log(2.0), 1e-12);
    CHECK_NEAR(pm_medium_collision_depth(1e-18) / 1e-18, 1.0, 1e-15);
}

static void extinction_at_its_ends(void)
{
    pm_medium clear = {.sigma_t = 0.0};
    pm_medium soot = {.sigma_t = 1e6};
    CHECK_NEAR(pm_medium_depth(&clear, HUGE_VAL), 0.0, 0.0);
    CHECK_NEAR(pm_medium_transmittance(&clear, HUGE_VAL), 1.0, 0.0);
    CHECK_NEAR(pm_medium_transmittance(&soot, 1e-6), exp(-1.0), 1e-15);
    CHECK_NEAR(pm_medium_transmittance(&soot, 1.0), 0.0, 0.0);
    CHECK_NEAR(pm_medium_transmittance(&soot, HUGE_VAL), 0.0, 0.0);
}

PM_TESTS({"medium.1", "the phase function integrates to 1 with mean cosine g",
          the_phase_function_has_mean_cosine_g},
         {"medium.2", "the phase function is the slope of its closed cdf",
          the_phase_function_is_the_slope_of_its_cdf},
         {"medium.3", "turns follow the phase function, about the way that light travels",
          turns_follow_the_phase_function},
         {"medium.4", "free paths are exponential, far beyond sixteen of them too",
          free_paths_are_exponential},
         {"medium.5", "no extinction lets all through, a million a metre nothing",
          extinction_at_its_ends},
         {"medium.6", "g within 1e-9 of 1 or -1 gives a peak and turns of the right width",
          narrow_turns_keep_their_digits})

// How fast a progressive picture gets better: the mean square error of indirect light on a
// smooth part of the floor, against what the exact radii predict.
//
// A ceiling lit by a point below it lights the floor, which reflects next to nothing, so that
// light on the floor is one integral and each photon on it carries the same power w. A pass of
// n photons and radius r then has the variance w E / (pi r^2) - E^2 / n and the bias
// laplacian(E) r^2 / 8.
#include "pictures.h"
#include "progressive.h"
#include "test.h"

#include <omp.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 20, PIXELS = SIDE * SIDE, STEPS = 5, SEEDS = 16, GRID = 40 };

static const uint32_t steps[STEPS] = {8, 16, 32, 64, 128};
static const double ceiling_albedo = 0.8;
static const double floor_albedo = 1e-6;
static const double half_ceiling = 2.0;
static const double seen = 1.5; // [m] the picture is this half wide on the floor
static const double flux = 10.0;

typedef struct {
    uint64_t photons; // of a pass
    double radius;    // [m] of the first
} effort;

/// Irradiance of the floor, 2 m below the ceiling, by the midpoint rule.
static double irradiance_at(double x, double y)
{
    double cell = 2.0 * half_ceiling / GRID;
    double sum = 0.0;
    for (int i = 0; i < GRID * GRID; i++) {
        double u = (i % GRID + 0.5) * cell - half_ceiling;
        double v = (i / GRID + 0.5) * cell - half_ceiling;
        double lamp2 = u * u + v * v + 0.25;
        double lit = flux / (4.0 * PM_PI) * 0.5 / (lamp2 * sqrt(lamp2));
        double way2 = (u - x) * (u - x) + (v - y) * (v - y) + 4.0;
        sum += lit * 4.0 / (way2 * way2);
    }
    return ceiling_albedo / PM_PI * sum * cell * cell;
}

static double laplacian_at(double x, double y)
{
    const double h = 0.05;
    double around = irradiance_at(x + h, y) + irradiance_at(x - h, y) +
                    irradiance_at(x, y + h) + irradiance_at(x, y - h);
    return (around - 4.0 * irradiance_at(x, y)) / (h * h);
}

/// Middle of a pixel on the floor. The picture's axes are those of the floor, up to their
/// signs, which symmetry forgives.
static double middle(int pixel)
{
    return ((pixel + 0.5) / SIDE * 2.0 - 1.0) * seen;
}

static void begin(pm_scenes *s)
{
    pm_scenes_begin(s);
    pm_scenes_wear(s, pm_scenes_square(2.0 * half_ceiling, 1.0, true),
                   pm_scenes_diffuse(s, pm_gray(ceiling_albedo)));
    pm_scenes_wear(s, pm_scenes_square(8.0, -1.0, false),
                   pm_scenes_diffuse(s, pm_gray(floor_albedo)));
    pm_scenes_point(s, pm_vec(0.0, 0.0, 0.5), pm_gray(flux));
    pm_scenes_ready(s);
    pm_pictures_look(s, pm_vec(0.0, 0.0, 0.0), pm_vec(0.0, 0.0, -1.0), seen, SIDE);
}

/// Predicted mean square errors, by the product of the radii's ratios.
static void predict(const effort *of, const double truth[PIXELS], double error[STEPS])
{
    static double bend[PIXELS];
    for (int i = 0; i < PIXELS; i++) {
        bend[i] = laplacian_at(middle(i % SIDE), middle(i / SIDE));
    }
    double share = 0.0;   // sum of r_1^2 / r_i^2
    double squares = 0.0; // sum of r_i^2 / r_1^2
    double left = 1.0;
    double r2 = of->radius * of->radius;
    int step = 0;
    for (uint32_t pass = 1; pass <= steps[STEPS - 1]; pass++) {
        share += 1.0 / left;
        squares += left;
        left *= (pass + 2.0 / 3.0) / (pass + 1.0);
        if (pass != steps[step]) {
            continue;
        }
        double sum = 0.0;
        for (int i = 0; i < PIXELS; i++) {
            double n = (double)of->photons;
            double power = flux / n;
            double variance =
                (power * truth[i] / (PM_PI * r2) * share / pass - truth[i] * truth[i] / n) /
                pass;
            double bias = bend[i] * r2 / 8.0 * squares / pass;
            sum += variance + bias * bias;
        }
        error[step++] = sum / PIXELS;
    }
}

static double square_error(const pm_progressive *done, const double truth[PIXELS])
{
    const double *plane = done->sum + (size_t)3 * PM_LAYER_INDIRECT * PIXELS;
    double sum = 0.0;
    for (int i = 0; i < PIXELS; i++) {
        double miss = plane[i] / done->passes * PM_PI / floor_albedo - truth[i];
        sum += miss * miss;
    }
    return sum / PIXELS;
}

static void measure(const effort *of, const double truth[PIXELS], double error[STEPS])
{
    pm_scenes s;
    begin(&s);
    pm_render_settings settings = pm_pictures_settings();
    settings.photons[PM_MAP_GLOBAL] = of->photons;
    settings.light.estimate.radius = of->radius;
    settings.light.spp = 1;
    settings.everywhere = true;
    settings.unpacked = true; // photons of one power would all be rounded the same way
    settings.only = PM_LAYER_INDIRECT;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        pm_progressive done = {0};
        pm_render_maps maps = {0};
        settings.seed = seed;
        for (int step = 0; step < STEPS; step++) {
            while (done.passes < steps[step]) {
                CHECK_OK(pm_progressive_pass(&s.world, &settings, &done, &maps));
            }
            error[step] += square_error(&done, truth) / SEEDS;
        }
        pm_render_maps_free(&maps);
        pm_progressive_free(&done);
    }
    pm_scenes_free(&s);
}

/// Least squares of log error over log passes.
static double slope_of(const double error[STEPS])
{
    double x = 0.0;
    double y = 0.0;
    double xx = 0.0;
    double xy = 0.0;
    for (int i = 0; i < STEPS; i++) {
        double u = log(steps[i]);
        double v = log(error[i]);
        x += u / STEPS;
        y += v / STEPS;
        xx += u * u / STEPS;
        xy += u * v / STEPS;
    }
    return (xy - x * y) / (xx - x * x);
}

/// Radii that take in a photon or two leave hardly any bias in sight; with FULL=1 they are so
/// wide that bias is a good part of the error.
static void errors_fall_as_the_radii_say(void)
{
    const char *full = getenv("FULL");
    bool wide = full != NULL && full[0] != '\0';
    effort of = wide ? (effort){20000, 0.55} : (effort){300, 0.1};
    static double truth[PIXELS];
    double want[STEPS];
    double got[STEPS] = {0.0};
    if (wide) {
        pm_test_limit(600.0);
    } else {
        omp_set_num_threads(1); // passes are too short to be shared
    }
    double side = 2.0 * seen / SIDE;
    for (int i = 0; i < PIXELS; i++) {
        double x = middle(i % SIDE);
        double y = middle(i / SIDE);
        truth[i] = irradiance_at(x, y) + laplacian_at(x, y) * side * side / 24.0; // its mean
    }
    predict(&of, truth, want);
    measure(&of, truth, got);
    for (int i = 0; i < STEPS; i++) {
        printf("%4u passes: mean square error %.4g, predicted %.4g\n", steps[i], got[i],
               want[i]);
    }
    printf("slope %.3f, predicted %.3f\n", slope_of(got), slope_of(want));
    CHECK_NEAR(got[STEPS - 1] / want[STEPS - 1], 1.0, 0.2);
    CHECK_NEAR(slope_of(got), slope_of(want), 0.08);
}

PM_TESTS({"progressive_rates.1",
          "from 8 to 128 passes the error falls as fast as the radii predict",
          errors_fall_as_the_radii_say})

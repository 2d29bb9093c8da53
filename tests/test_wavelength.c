// What a wavelength does to the three channels, and how wavelengths are handed out.
#include "wavelength.h"

#include "chance.h"
#include "test.h"

#include <gsl/gsl_integration.h>
#include <stdlib.h>

static double weight_of(double wavelength, void *channel)
{
    return pm_wavelength_weight(wavelength).c[*(const int *)channel];
}

static void means_are_one(void)
{
    // Adaptive, for the kinks where a curve is cut off at 0, and with many nodes, so as not to
    // step over the small ones.
    for (int c = 0; c < 3; c++) {
        gsl_function integrand = {weight_of, &c};
        gsl_integration_workspace *room = gsl_integration_workspace_alloc(4000);
        double sum;
        double error;
        CHECK(gsl_integration_qag(&integrand, PM_WAVELENGTH_LEAST, PM_WAVELENGTH_MOST, 1e-11,
                                  0.0, 4000, GSL_INTEG_GAUSS51, room, &sum, &error) == 0);
        gsl_integration_workspace_free(room);
        CHECK_NEAR(sum / (PM_WAVELENGTH_MOST - PM_WAVELENGTH_LEAST), 1.0, 1e-13);
    }
}

static void weights_are_never_negative(void)
{
    for (int i = 0; i <= 34000; i++) {
        double nm = PM_WAVELENGTH_LEAST + 0.01 * i;
        pm_spectrum weight = pm_wavelength_weight(nm);
        for (int c = 0; c < 3; c++) {
            CHECK_THAT(weight.c[c] >= 0.0, "channel %d is %g at %g nm", c, weight.c[c], nm);
            CHECK_THAT(weight.c[c] < 6.0, "channel %d is %g at %g nm", c, weight.c[c], nm);
        }
        CHECK_THAT(!pm_spectrum_is_black(weight), "no light at all at %g nm", nm);
    }
}

static void hues_are_those_of_the_rainbow(void)
{
    // nm; strongest channel
    static const struct {
        double nm;
        int strongest;
    } known[] = {{430.0, 2}, {450.0, 2}, {470.0, 2}, {520.0, 1}, {550.0, 1},
                 {590.0, 0}, {610.0, 0}, {650.0, 0}, {700.0, 0}};
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++) {
        pm_spectrum weight = pm_wavelength_weight(known[i].nm);
        for (int c = 0; c < 3; c++) {
            CHECK_THAT(c == known[i].strongest || weight.c[c] < weight.c[known[i].strongest],
                       "at %g nm channel %d is %g", known[i].nm, c, weight.c[c]);
        }
    }
    // Violet is blue with some red; green is neither.
    pm_spectrum violet = pm_wavelength_weight(430.0);
    pm_spectrum green = pm_wavelength_weight(530.0);
    CHECK(violet.c[0] > 0.0 && violet.c[1] == 0.0);
    CHECK(green.c[0] == 0.0 && green.c[2] == 0.0);
}

/// x, y, z of the 1931 observer as tabulated, and the channel that they are compared in.
typedef struct {
    double nm, xyz[3];
    int channel;
} tabulated;

static double from_table(const tabulated *entry)
{
    static const double to_rgb[3][3] = {
        {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};
    const double *row = to_rgb[entry->channel];
    return row[0] * entry->xyz[0] + row[1] * entry->xyz[1] + row[2] * entry->xyz[2];
}

static void curves_are_those_of_the_observer(void)
{
    // Ratios within a channel, where the scale to mean 1 drops out; the fit is good to some 2 %
    // of its peaks.
    static const tabulated known[3][3] = {
        {{600.0, {1.0622, 0.6310, 0.0008}, 0},
         {580.0, {0.9163, 0.8700, 0.0017}, 0},
         {640.0, {0.4479, 0.1750, 0.0000}, 0}},
        {{540.0, {0.2904, 0.9540, 0.0203}, 1},
         {520.0, {0.0633, 0.7100, 0.0782}, 1},
         {580.0, {0.9163, 0.8700, 0.0017}, 1}},
        {{450.0, {0.3362, 0.0380, 1.7721}, 2},
         {480.0, {0.0956, 0.1390, 0.8130}, 2},
         {430.0, {0.2839, 0.0116, 1.3856}, 2}},
    };
    for (int c = 0; c < 3; c++) {
        double peak = pm_wavelength_weight(known[c][0].nm).c[c];
        for (int i = 1; i < 3; i++) {
            double got = pm_wavelength_weight(known[c][i].nm).c[c] / peak;
            CHECK_NEAR(got, from_table(&known[c][i]) / from_table(&known[c][0]), 0.04);
        }
    }
}

// --- handing out

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a;
    double y = *(const double *)b;
    return (x > y) - (x < y);
}

static void a_pass_leaves_no_gaps(void)
{
    // Photons 0 .. n - 1, and those of one light among three, which come by turns.
    enum { COUNT = 5000 };
    static double u[COUNT];
    for (uint64_t every = 1; every <= 3; every += 2) {
        pm_rng_source source = {.seed = 3, .stream = PM_STREAM_CAUSTIC};
        for (uint64_t i = 0; i < COUNT; i++) {
            u[i] = pm_wavelength_spread(&source, i * every + 1);
            CHECK(u[i] >= 0.0 && u[i] < 1.0);
        }
        qsort(u, COUNT, sizeof *u, ascending);
        double widest = 1.0 - u[COUNT - 1] + u[0];
        for (int i = 1; i < COUNT; i++) {
            widest = fmax(widest, u[i] - u[i - 1]);
        }
        CHECK_THAT(widest < 4.0 / COUNT, "every %d: a gap of %g", (int)every, widest);
    }
}

static void each_photon_is_uniform_over_passes_and_seeds(void)
{
    enum { CELLS = 20, COUNT = 20000 };
    uint64_t over_seeds[CELLS] = {0};
    uint64_t over_passes[CELLS] = {0};
    for (uint32_t i = 0; i < COUNT; i++) {
        pm_rng_source seeded = {.seed = i, .stream = PM_STREAM_CAUSTIC};
        pm_rng_source passing = {.seed = 1, .stream = PM_STREAM_GLOBAL, .pass = i};
        over_seeds[(int)(pm_wavelength_spread(&seeded, 12345) * CELLS)]++;
        over_passes[(int)(pm_wavelength_spread(&passing, 7) * CELLS)]++;
    }
    CHECK_EVEN(over_seeds, CELLS);
    CHECK_EVEN(over_passes, CELLS);
}

static void passes_seeds_and_maps_are_independent(void)
{
    // Mean of (u - 1/2)(v - 1/2), whose variance is 1/144 when u and v are independent.
    enum { COUNT = 20000 };
    double passes = 0.0;
    double seeds = 0.0;
    double maps = 0.0;
    for (uint32_t i = 0; i < COUNT; i++) {
        pm_rng_source one = {.seed = i, .stream = PM_STREAM_CAUSTIC};
        pm_rng_source seed = {.seed = i + 1, .stream = PM_STREAM_CAUSTIC};
        pm_rng_source pass = {.seed = i, .stream = PM_STREAM_CAUSTIC, .pass = 1};
        pm_rng_source map = {.seed = i, .stream = PM_STREAM_GLOBAL};
        double u = pm_wavelength_spread(&one, 4) - 0.5;
        seeds += u * (pm_wavelength_spread(&seed, 4) - 0.5);
        passes += u * (pm_wavelength_spread(&pass, 4) - 0.5);
        maps += u * (pm_wavelength_spread(&map, 4) - 0.5);
    }
    double bound = pm_chance_bound(1.0 / 144.0, COUNT);
    CHECK_NEAR(seeds / COUNT, 0.0, bound);
    CHECK_NEAR(passes / COUNT, 0.0, bound);
    CHECK_NEAR(maps / COUNT, 0.0, bound);
}

PM_TESTS({"wavelength.1", "each channel's weight has mean 1 over the range", means_are_one},
         {"wavelength.2", "no weight is negative, and no wavelength is dark",
          weights_are_never_negative},
         {"wavelength.3", "blue, green and red stand in the order of the rainbow",
          hues_are_those_of_the_rainbow},
         {"wavelength.4", "the weights follow the observer's tables",
          curves_are_those_of_the_observer},
         {"wavelength.5", "the wavelengths of a pass leave no gap in the range",
          a_pass_leaves_no_gaps},
         {"wavelength.6", "a photon's wavelength is uniform over seeds and over passes",
          each_photon_is_uniform_over_passes_and_seeds},
         {"wavelength.7", "passes, seeds and maps take wavelengths independently",
          passes_seeds_and_maps_are_independent})

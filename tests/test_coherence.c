// Fault or noise: z is a standard normal variable for noise of any kind that regions do not
// share, and large for whatever leans one way.
#include "chance.h"
#include "coherence.h"
#include "compare.h"
#include "rng.h"
#include "test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 128, PIXELS = SIDE * SIDE };

static uint8_t all[PIXELS];
static double field[3][PIXELS];

// One number per (run, pixel): uniform in [-1, 1).
static double draw(uint32_t run, int pixel)
{
    const pm_rng_source source = {.seed = 1 + run, .stream = PM_STREAM_TEST};
    pm_rng rng = pm_rng_at(&source, (uint64_t)pixel, 0);
    double u = pm_rng_draw(&rng);
    return 2.0 * u - 1.0;
}

static pm_coherence measure(const double *difference, const double *noise_a,
                            const double *noise_b)
{
    pm_coherence_planes planes = {.width = SIDE,
                                  .height = SIDE,
                                  .counted = all,
                                  .difference = difference,
                                  .noise = {noise_a, noise_b}};
    pm_coherence found;
    memset(all, 1, sizeof all);
    CHECK_OK(pm_coherence_measure(&planes, &found));
    return found;
}

// Noise whose spread grows a thousandfold across the picture, with sparse very bright pixels.
static void make_rough_noise(uint32_t run, double *out)
{
    for (int i = 0; i < PIXELS; i++) {
        double x = draw(run, i);
        double spread = pow(1000.0, (double)(i % SIDE) / SIDE);
        out[i] = spread * (fabs(x) > 0.999 ? 300.0 * x : x);
    }
}

static void z_of_noise_is_standard_normal(void)
{
    enum { RUNS = 100 };
    double sum = 0.0;
    double squares = 0.0;
    for (uint32_t run = 0; run < RUNS; run++) {
        make_rough_noise(run, field[0]);
        pm_coherence found = measure(field[0], NULL, NULL);
        CHECK(found.pairs == 2 * 16 * 14);
        sum += found.z;
        squares += found.z * found.z;
    }
    // 5 sigma: the mean of RUNS normal numbers has variance 1/RUNS, of their squares 2/RUNS.
    CHECK_NEAR(sum / RUNS, 0.0, pm_chance_bound(1.0, RUNS));
    CHECK_NEAR(squares / RUNS, 1.0, pm_chance_bound(2.0, RUNS));
}

static void a_lean_is_found_below_the_noise(void)
{
    // Tiles of 8x8 of uniform noise have deviation 1 / sqrt(3 * 64) = 0.072; the lean is less.
    for (int i = 0; i < PIXELS; i++) {
        field[0][i] = draw(5, i) + 0.06;
    }
    pm_coherence found = measure(field[0], NULL, NULL);
    CHECK_THAT(found.z > 5.0, "z = %g", found.z);
    CHECK_NEAR(found.coherent, 0.06, 0.02);
    // A lean of the other sign in the other half counts as much.
    for (int i = 0; i < PIXELS; i++) {
        field[0][i] = draw(5, i) + (i < PIXELS / 2 ? 0.1 : -0.1);
    }
    CHECK(measure(field[0], NULL, NULL).z > 5.0);
}

static void pure_lean_reaches_the_largest_z(void)
{
    for (int i = 0; i < PIXELS; i++) {
        field[0][i] = -0.5;
    }
    pm_coherence found = measure(field[0], NULL, NULL);
    CHECK_NEAR(found.z, sqrt(2 * 16 * 14), 1e-9);
    CHECK_NEAR(found.coherent, 0.5, 1e-12);
    memset(field[0], 0, sizeof field[0]);
    found = measure(field[0], NULL, NULL);
    CHECK(found.z == 0.0 && found.coherent == 0.0);
}

// Noise in blotches of 64 pixels, as a photon map's: a lean, unless halves show it as noise.
static void make_blotches(uint32_t run, double *out)
{
    for (int i = 0; i < PIXELS; i++) {
        int block = i / SIDE / 32 * 4 + i % SIDE / 32;
        out[i] = draw(run, block);
    }
}

static void noise_shown_by_halves_is_no_lean(void)
{
    int alone = 0;
    int known = 0;
    for (uint32_t run = 0; run < 20; run++) {
        make_blotches(3 * run, field[1]); // noise that A's halves show; B's below
        make_blotches(3 * run + 1, field[2]);
        for (int i = 0; i < PIXELS; i++) {
            // A's error and B's, of the same spread as what the halves show
            double a = draw(3 * run + 1000, i / SIDE / 32 * 4 + i % SIDE / 32);
            double b = draw(3 * run + 1001, i / SIDE / 32 * 4 + i % SIDE / 32);
            field[0][i] = a - b;
        }
        alone += measure(field[0], NULL, NULL).z > PM_COMPARE_SIGMA;
        known += measure(field[0], field[1], field[2]).z > PM_COMPARE_SIGMA;
    }
    CHECK_THAT(alone >= 15, "blotches alone look like faults: %d of 20", alone);
    CHECK_THAT(known <= 2, "with halves they do not: %d of 20", known);
}

static void left_out_pixels_do_not_count(void)
{
    memset(all, 1, sizeof all);
    for (int i = 0; i < PIXELS; i++) {
        field[0][i] = draw(9, i);
        if (i % SIDE < 40) {
            all[i] = 0;
            field[0][i] = 1e6;
        }
    }
    pm_coherence_planes planes = {
        .width = SIDE, .height = SIDE, .counted = all, .difference = field[0]};
    pm_coherence found;
    CHECK_OK(pm_coherence_measure(&planes, &found));
    CHECK(found.pairs == 11 * 14 + 9 * 16); // columns 5 to 15 of 16
    CHECK(fabs(found.z) < 5.0);
}

// A part as pm_compare_measure() would fill it.
static pm_compare_part part_of(const char *name, double z, double coherent, bool known)
{
    pm_compare_part part = {.mean_b = 1.0,
                            .mean_ratio = {1.0, 1.0, 1.0},
                            .max = 1.0,
                            .noise_known = known,
                            .coherence = {.pairs = 448, .z = z, .coherent = coherent}};
    snprintf(part.name, sizeof part.name, "%s", name);
    return part;
}

static pm_compare_verdict judge(const pm_compare_part *whole, const pm_compare_part *layer,
                                const char *part_of_sentence)
{
    char text[320];
    pm_compare_verdict verdict =
        pm_compare_judge(whole, layer, layer != NULL ? 1 : 0, text, sizeof text);
    CHECK_CONTAINS(text, part_of_sentence);
    return verdict;
}

static void verdicts_say_why(void)
{
    pm_compare_part quiet = part_of("direct", 3.0, 0.9, false);
    pm_compare_part loud = part_of("caustic", 9.0, 0.2, false);
    pm_compare_part whole = part_of("", 3.0, 0.2, false);
    CHECK(judge(&whole, &quiet, "noise: regions differ by chance (z = 3.0") ==
          PM_COMPARE_NOISE);
    CHECK(judge(&whole, &loud, "in the layer caustic (z = 9.0), by 20 %") == PM_COMPARE_FAULT);
    whole = part_of("", 12.0, 0.08, false);
    CHECK(judge(&whole, &quiet, "the same way (z = 12.0), by 8 %") == PM_COMPARE_FAULT);
    CHECK(judge(&whole, &loud, "in the layer caustic") == PM_COMPARE_FAULT);
    whole = part_of("", 12.0, 0.005, false);
    CHECK(judge(&whole, NULL, "unclear: ") == PM_COMPARE_UNCERTAIN);
    whole.noise_known = true;
    CHECK(judge(&whole, NULL, "not noise") == PM_COMPARE_FAULT);
    whole.coherence.pairs = 10;
    CHECK(judge(&whole, NULL, "too few pixels") == PM_COMPARE_UNCERTAIN);
    whole.mean_b = 0.0;
    CHECK(judge(&whole, NULL, "the right picture is black") == PM_COMPARE_FAULT);
    whole.max = 0.0;
    CHECK(judge(&whole, NULL, "no pixel differs") == PM_COMPARE_EQUAL);
}

static void a_layer_that_is_off_is_named(void)
{
    pm_compare_part whole = part_of("", 0.0, 0.0, false);
    pm_compare_part layer = part_of("caustic", 0.0, 0.0, false);
    memset(layer.mean_ratio, 0, sizeof layer.mean_ratio);
    CHECK(judge(&whole, &layer, "the layer caustic is black in A only") == PM_COMPARE_FAULT);
    layer = part_of("caustic", 0.0, 0.0, false);
    layer.mean_b = 0.0;
    CHECK(judge(&whole, &layer, "the layer caustic is black in B only") == PM_COMPARE_FAULT);
    layer.max = 0.0; // black in both
    CHECK(judge(&whole, &layer, "noise") == PM_COMPARE_NOISE);
}

PM_TESTS({"coherence.1", "z of uneven, spiky noise is a standard normal variable",
          z_of_noise_is_standard_normal},
         {"coherence.2", "a lean below the noise of a tile is found",
          a_lean_is_found_below_the_noise},
         {"coherence.3", "a pure lean reaches the largest z there is",
          pure_lean_reaches_the_largest_z},
         {"coherence.4", "blotches that halves show as noise are no fault",
          noise_shown_by_halves_is_no_lean},
         {"coherence.5", "pixels that are left out do not count", left_out_pixels_do_not_count},
         {"coherence.6", "the verdict says why, and names the layer", verdicts_say_why},
         {"coherence.7", "a layer that is black in one picture only is a fault by name",
          a_layer_that_is_off_is_named})

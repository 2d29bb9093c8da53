// The random numbers: the generator against its published answers, the handle against its
// promises, the numbers against chance. Seeds are fixed; statistical bounds are 5 sigma of the
// known variance, which a right generator misses once in two million tries.
#include "rng.h"
#include "test.h"

#include <gsl/gsl_cdf.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

static const double rare = 5.733e-7; // two-sided probability of 5 sigma
static const pm_rng_source source = {.seed = 7, .stream = PM_STREAM_TEST};

// Source: tests/kat_vectors of Random123, philox4x32 with 10 rounds.
static const struct {
    uint32_t counter[4], key[2], words[4];
} known[] = {
    {{0, 0, 0, 0}, {0, 0}, {0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}},
    {{0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff},
     {0xffffffff, 0xffffffff},
     {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}},
    {{0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344},
     {0xa4093822, 0x299f31d0},
     {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}},
};

// 53 bits: all of the first word, the upper 21 of the second.
static double from_words(uint32_t high, uint32_t low)
{
    return (high * 0x1p21 + (low >> 11)) * 0x1p-53;
}

static void match_published_answers(void)
{
    for (size_t i = 0; i < sizeof known / sizeof known[0]; ++i) {
        pm_rng rng = {.used = 4};
        memcpy(rng.counter, known[i].counter, sizeof rng.counter);
        memcpy(rng.key, known[i].key, sizeof rng.key);
        double first = pm_rng_draw(&rng);
        double second = pm_rng_draw(&rng);
        CHECK(memcmp(rng.words, known[i].words, sizeof rng.words) == 0);
        CHECK_NEAR(first, from_words(known[i].words[0], known[i].words[1]), 0.0);
        CHECK_NEAR(second, from_words(known[i].words[2], known[i].words[3]), 0.0);
    }
}

static double first_at(pm_rng_source from, uint64_t index, uint32_t bounce)
{
    pm_rng rng = pm_rng_at(&from, index, bounce);
    return pm_rng_draw(&rng);
}

static double nth_at(uint64_t index, int n)
{
    pm_rng rng = pm_rng_at(&source, index, 0);
    double number = 0.0;
    for (int i = 0; i <= n; ++i) {
        number = pm_rng_draw(&rng);
    }
    return number;
}

static void repeat_at_same_place(void)
{
    double wanted[20];
    pm_rng rng = pm_rng_at(&source, 12345678901, 3);
    pm_rng copy = rng;
    for (int i = 0; i < 20; ++i) {
        wanted[i] = pm_rng_draw(&rng);
    }
    pm_rng again = pm_rng_at(&source, 12345678901, 3);
    for (int i = 0; i < 20; ++i) {
        pm_rng other = pm_rng_at(&source, (uint64_t)i, 3); // others may draw in between
        (void)pm_rng_draw(&other);
        CHECK_NEAR(pm_rng_draw(&again), wanted[i], 0.0);
        CHECK_NEAR(pm_rng_draw(&copy), wanted[i], 0.0);
    }
}

static void differ_in_every_coordinate(void)
{
    const pm_rng_source seeded = {.seed = 8, .stream = PM_STREAM_TEST};
    const pm_rng_source other_stream = {.seed = 7, .stream = PM_STREAM_GLOBAL};
    const pm_rng_source other_pass = {.seed = 7, .stream = PM_STREAM_TEST, .pass = 1};
    const pm_rng_source last_pass = {.seed = 7, .stream = PM_STREAM_TEST, .pass = 0x0fffffff};
    const double numbers[] = {first_at(source, 0, 0),
                              first_at(seeded, 0, 0),
                              first_at(other_stream, 0, 0),
                              first_at(other_pass, 0, 0),
                              first_at(last_pass, 0, 0),
                              first_at(source, 1, 0),
                              first_at(source, 1ull << 32, 0),
                              first_at(source, 0, 1),
                              nth_at(0, 1),
                              nth_at(0, 2),
                              nth_at(0, 4)};
    size_t count = sizeof numbers / sizeof numbers[0];
    for (size_t i = 0; i < count; ++i) {
        for (size_t j = 0; j < i; ++j) {
            CHECK_THAT(numbers[i] != numbers[j], "places %zu and %zu give the same number", i,
                       j);
        }
    }
}

static void stay_in_range(void)
{
    pm_rng least = {.words = {0, 0, 0, 0}, .used = 0};
    pm_rng most = {.words = {UINT32_MAX, UINT32_MAX, 0, 0}, .used = 0};
    CHECK_NEAR(pm_rng_draw(&least), 0.0, 0.0);
    double largest = pm_rng_draw(&most);
    CHECK(largest < 1.0);
    CHECK_NEAR(largest, 1.0 - 0x1p-53, 0.0);
}

static void use_53_bits(void)
{
    uint64_t seen = 0;
    for (uint64_t i = 0; i < 1000; ++i) {
        double scaled = first_at(source, i, 0) * 0x1p53;
        CHECK(scaled == floor(scaled));
        seen |= (uint64_t)scaled;
    }
    CHECK(seen == (1ull << 53) - 1);
}

static void check_flat(const char *what, const uint32_t *counts, size_t bins)
{
    double total = 0.0;
    double chi2 = 0.0;
    for (size_t i = 0; i < bins; ++i) {
        total += counts[i];
    }
    for (size_t i = 0; i < bins; ++i) {
        double off = counts[i] - total / (double)bins;
        chi2 += off * off / (total / (double)bins);
    }
    double above = gsl_cdf_chisq_Q(chi2, (double)bins - 1.0);
    double below = gsl_cdf_chisq_P(chi2, (double)bins - 1.0);
    CHECK_THAT(above > rare && below > rare, "%s: chi-square %g in %zu bins", what, chi2, bins);
}

enum { BINS = 1000, DRAWS = 1000000 };

static void fill_evenly(void)
{
    static uint32_t high[BINS];
    static uint32_t low[BINS];
    for (uint64_t i = 0; i < DRAWS / 10; ++i) {
        pm_rng rng = pm_rng_at(&source, i, 0);
        for (int n = 0; n < 10; ++n) {
            double number = pm_rng_draw(&rng);
            double rest = number * 0x1p30 - floor(number * 0x1p30); // the last 23 bits
            ++high[(size_t)(number * BINS)];
            ++low[(size_t)(rest * BINS)];
        }
    }
    check_flat("the numbers", high, BINS);
    check_flat("their low bits", low, BINS);
}

// Pairs in a grid: draws in a row, and first draws of neighbours in each coordinate.
static void fill_squares_evenly(void)
{
    static uint32_t in_row[32 * 32];
    static uint32_t by_index[32 * 32];
    static uint32_t by_bounce[32 * 32];
    for (uint64_t i = 0; i < 200000; ++i) {
        pm_rng rng = pm_rng_at(&source, i, 0);
        double first = pm_rng_draw(&rng);
        double second = pm_rng_draw(&rng);
        size_t row = (size_t)(first * 32) * 32;
        ++in_row[row + (size_t)(second * 32)];
        ++by_index[row + (size_t)(first_at(source, i + 1, 0) * 32)];
        ++by_bounce[row + (size_t)(first_at(source, i, 1) * 32)];
    }
    check_flat("pairs of draws", in_row, 32 * 32);
    check_flat("pairs of indices", by_index, 32 * 32);
    check_flat("pairs of bounces", by_bounce, 32 * 32);
}

// The mean of (u - 1/2)(v - 1/2) has mean 0 and variance 1/144 per pair when u and v are
// independent.
static void keep_streams_apart(void)
{
    const int pairs = 200000;
    for (pm_rng_stream stream = PM_STREAM_GLOBAL; stream < PM_STREAM_TEST; ++stream) {
        const pm_rng_source a = {.seed = 1, .stream = stream};
        const pm_rng_source b = {.seed = 1, .stream = stream + 1};
        const pm_rng_source c = {.seed = 1, .stream = stream, .pass = 1};
        const pm_rng_source d = {.seed = 2, .stream = stream};
        double sums[3] = {0.0, 0.0, 0.0};
        for (int i = 0; i < pairs; ++i) {
            double centred = first_at(a, (uint64_t)i, 0) - 0.5;
            sums[0] += centred * (first_at(b, (uint64_t)i, 0) - 0.5);
            sums[1] += centred * (first_at(c, (uint64_t)i, 0) - 0.5);
            sums[2] += centred * (first_at(d, (uint64_t)i, 0) - 0.5);
        }
        for (int i = 0; i < 3; ++i) {
            CHECK_NEAR(sums[i] / pairs, 0.0, 5.0 * sqrt(1.0 / 144.0 / pairs));
        }
    }
}

// Moments of the uniform distribution: mean 1/2, variance 1/12; the variance of the squared
// deviation is 1/180.
static void have_uniform_moments(void)
{
    double sum = 0.0;
    double square = 0.0;
    for (uint64_t i = 0; i < DRAWS; ++i) {
        double centred = first_at(source, i, 5) - 0.5;
        sum += centred;
        square += centred * centred;
    }
    CHECK_NEAR(sum / DRAWS, 0.0, 5.0 * sqrt(1.0 / 12.0 / DRAWS));
    CHECK_NEAR(square / DRAWS, 1.0 / 12.0, 5.0 * sqrt(1.0 / 180.0 / DRAWS));
}

PM_TESTS({"rng.1", "the generator gives Random123's known answers", match_published_answers},
         {"rng.2", "the same place always gives the same numbers", repeat_at_same_place},
         {"rng.3", "seed, stream, pass, index, bounce and draw each change the number",
          differ_in_every_coordinate},
         {"rng.4", "the smallest number is 0 and the largest is below 1", stay_in_range},
         {"rng.5", "numbers are multiples of 2^-53 and use every bit", use_53_bits},
         {"rng.6", "numbers and their low bits fill an interval evenly", fill_evenly},
         {"rng.7", "pairs of neighbouring draws fill a square evenly", fill_squares_evenly},
         {"rng.8", "streams, passes and seeds are uncorrelated", keep_streams_apart},
         {"rng.9", "mean and variance are those of the uniform distribution",
          have_uniform_moments})

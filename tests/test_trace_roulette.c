// Russian roulette: its probabilities, mean and variance are enumerated here from the rules'
// definitions and compared with what is drawn.
#include "trace.h"

#include "chance.h"
#include "test.h"

enum { DRAWS = 200000 };
static const pm_rng_source source = {.seed = 4, .stream = PM_STREAM_TEST};

typedef struct {
    pm_spectrum power;
    pm_spectrum albedos[PM_LOBES_MAX];
    int count;
} game;

static const game games[] = {
    {{{1, 1, 1}}, {{{0.5, 0.5, 0.5}}}, 1},
    {{{1, 1, 1}}, {{{0.63, 0.065, 0.05}}}, 1},
    {{{0.2, 3.0, 0.5}}, {{{0.63, 0.065, 0.05}}}, 1},
    {{{2, 0, 0}}, {{{0.3, 0.9, 0.9}}}, 1},
    {{{1, 1, 1}}, {{{0.3, 0.2, 0.1}}, {{0.1, 0.4, 0.6}}}, 2},
    {{{1, 1, 1}}, {{{1, 0, 0}}, {{0, 1, 0}}}, 2},
    {{{4, 2, 1}}, {{{0.5, 0, 0}}, {{0, 1, 0}}, {{0.5, 0, 1}}}, 3},
    {{{1, 1, 1}}, {{{0.04, 0.04, 0.04}}, {{0.96, 0.96, 0.96}}}, 2},
    {{{1, 2, 3}}, {{{1, 1, 1}}}, 1},
    {{{1, 2, 3}}, {{{0, 0, 0}}}, 1},
};
enum { GAMES = sizeof games / sizeof games[0] };

static void lobes_of(const game *g, pm_lobe *lobes)
{
    for (int i = 0; i < g->count; i++) {
        lobes[i] = (pm_lobe){PM_LOBE_DIFFUSE, false, g->albedos[i]};
    }
}

/// Probability of each lobe by the rule, scaled down to sum 1 where it must be.
static void chances_of(const game *g, pm_roulette_rule rule, double *chance)
{
    double total = 0.0;
    for (int i = 0; i < g->count; i++) {
        const double *a = g->albedos[i].c;
        const double *p = g->power.c;
        double largest = fmax(fmax(a[0] * p[0], a[1] * p[1]), a[2] * p[2]);
        double mean = (a[0] + a[1] + a[2]) / 3.0;
        chance[i] = rule == PM_ROULETTE_MAX ? largest / fmax(fmax(p[0], p[1]), p[2]) : mean;
        total += chance[i];
    }
    for (int i = 0; i < g->count && total > 1.0; i++) {
        chance[i] /= total;
    }
}

static pm_roulette play(const game *g, pm_roulette_rule rule, uint64_t index)
{
    pm_lobe lobes[PM_LOBES_MAX];
    lobes_of(g, lobes);
    pm_rng rng = pm_rng_at(&source, index, 0);
    pm_roulette outcome;
    CHECK_OK(pm_trace_roulette(g->power, lobes, g->count, rule, &rng, &outcome));
    return outcome;
}

static void check_chances(const game *g, pm_roulette_rule rule)
{
    double chance[PM_LOBES_MAX];
    chances_of(g, rule, chance);
    uint64_t counts[PM_LOBES_MAX + 1] = {0};
    double expected[PM_LOBES_MAX + 1] = {0};
    double rest = 1.0;
    for (int i = 0; i < g->count; i++) {
        expected[i] = chance[i] * DRAWS;
        rest -= chance[i];
    }
    expected[PM_LOBES_MAX] = rest > 1e-12 ? rest * DRAWS : 0.0;
    for (uint64_t i = 0; i < DRAWS; i++) {
        int lobe = play(g, rule, i).lobe;
        counts[lobe == PM_NONE ? PM_LOBES_MAX : lobe]++;
    }
    int cells = 0;
    for (int i = 0; i <= PM_LOBES_MAX; i++) {
        cells += expected[i] > 0.0;
        CHECK(expected[i] > 0.0 || counts[i] == 0);
    }
    if (cells > 1) {
        CHECK_FIT(counts, expected, PM_LOBES_MAX + 1);
    }
}

static void lobes_are_chosen_by_rule(void)
{
    for (int i = 0; i < GAMES; i++) {
        check_chances(&games[i], PM_ROULETTE_MAX);
        check_chances(&games[i], PM_ROULETTE_AVERAGE);
    }
}

/// Mean and variance of the power carried on in channel c.
static void expect_power(const game *g, const double *chance, int c, double *mean,
                         double *variance)
{
    double square = 0.0;
    *mean = 0.0;
    for (int i = 0; i < g->count; i++) {
        double promised = g->power.c[c] * g->albedos[i].c[c];
        *mean += promised;
        square += promised > 0.0 ? promised * promised / chance[i] : 0.0;
    }
    *variance = fmax(0.0, square - *mean * *mean);
}

static void check_power(const game *g, pm_roulette_rule rule)
{
    double chance[PM_LOBES_MAX];
    chances_of(g, rule, chance);
    pm_spectrum sum = pm_gray(0.0);
    for (uint64_t i = 0; i < DRAWS; i++) {
        pm_roulette outcome = play(g, rule, i);
        sum = pm_spectrum_add(sum, outcome.power);
        CHECK(outcome.lobe != PM_NONE || pm_spectrum_is_black(outcome.power));
        for (int c = 0; c < 3 && outcome.lobe != PM_NONE; c++) {
            double want = g->power.c[c] * g->albedos[outcome.lobe].c[c] / chance[outcome.lobe];
            CHECK_NEAR(outcome.power.c[c], want, 1e-14 * want);
        }
    }
    for (int c = 0; c < 3; c++) {
        double mean;
        double variance;
        expect_power(g, chance, c, &mean, &variance);
        CHECK_NEAR(sum.c[c] / DRAWS, mean, pm_chance_bound(variance, DRAWS) + 1e-9 * mean);
    }
}

static void power_is_unbiased(void)
{
    for (int i = 0; i < GAMES; i++) {
        check_power(&games[i], PM_ROULETTE_MAX);
        check_power(&games[i], PM_ROULETTE_AVERAGE);
    }
}

/// Power after `bounces` off `albedo`, from white; black when absorbed on the way.
static pm_spectrum bounced(pm_spectrum albedo, int bounces, pm_roulette_rule rule,
                           uint64_t index)
{
    pm_lobe lobe = {PM_LOBE_DIFFUSE, false, albedo};
    pm_spectrum power = pm_gray(1.0);
    for (int b = 0; b < bounces; b++) {
        pm_rng rng = pm_rng_at(&source, index, (uint32_t)b + 1);
        pm_roulette outcome;
        CHECK_OK(pm_trace_roulette(power, &lobe, 1, rule, &rng, &outcome));
        power = outcome.power;
    }
    return power;
}

static void noise_of_the_rules(void)
{
    // Off a red wall every survivor of three bounces carries the same red power, so mean and
    // variance follow from the survival alone: relative sd 1.73 by max, 8.0 by average.
    const pm_spectrum red = {{0.63, 0.065, 0.05}};
    const double survival[2] = {0.63, (0.63 + 0.065 + 0.05) / 3.0};
    for (int rule = PM_ROULETTE_MAX; rule <= PM_ROULETTE_AVERAGE; rule++) {
        double alive = pow(survival[rule], 3.0);
        double sum = 0.0;
        double squares = 0.0;
        for (uint64_t i = 0; i < DRAWS; i++) {
            double power = bounced(red, 3, (pm_roulette_rule)rule, i).c[0];
            sum += power;
            squares += power * power;
        }
        double mean = pow(0.63, 3.0);
        double each = mean / alive;
        double variance = each * each * alive * (1.0 - alive);
        CHECK_NEAR(sum / DRAWS, mean, pm_chance_bound(variance, DRAWS));
        CHECK_NEAR(squares / DRAWS, each * each * alive,
                   each * each * pm_chance_bound(alive * (1.0 - alive), DRAWS));
        CHECK_NEAR(sqrt(variance) / mean, rule == PM_ROULETTE_MAX ? 1.73 : 8.03, 0.02);
    }
}

static void bright_chain_loses_nothing(void)
{
    // Ten bounces at .999: gray survivors keep exactly their power.
    double sum = 0.0;
    for (uint64_t i = 0; i < DRAWS; i++) {
        double power = bounced(pm_gray(0.999), 10, PM_ROULETTE_MAX, i).c[0];
        CHECK(power == 0.0 || fabs(power - 1.0) < 1e-14);
        sum += power;
    }
    double alive = pow(0.999, 10.0);
    CHECK_NEAR(sum / DRAWS, alive, pm_chance_bound(alive * (1.0 - alive), DRAWS));
}

static void watts_do_not_matter(void)
{
    static const double factors[4] = {1e-6, 0x1p-60, 1e30, 1e-300};
    for (int i = 0; i < GAMES; i++) {
        for (int k = 0; k < 4; k++) {
            game scaled = games[i];
            scaled.power = pm_spectrum_scale(scaled.power, factors[k]);
            for (uint64_t j = 0; j < 1000; j++) {
                pm_roulette here = play(&games[i], PM_ROULETTE_MAX, j);
                pm_roulette there = play(&scaled, PM_ROULETTE_MAX, j);
                CHECK(here.lobe == there.lobe);
                double want = here.power.c[1] * factors[k];
                CHECK_NEAR(there.power.c[1], want, 1e-14 * want);
            }
        }
    }
}

static void nothing_is_absorbed(void)
{
    const game dark = {{{0, 0, 0}}, {{{1, 1, 1}}}, 1};
    const game bare = {{{1, 1, 1}}, {{{0, 0, 0}}}, 0};
    for (uint64_t i = 0; i < 100; i++) {
        for (int rule = PM_ROULETTE_MAX; rule <= PM_ROULETTE_AVERAGE; rule++) {
            pm_roulette outcome = play(&dark, (pm_roulette_rule)rule, i);
            CHECK(outcome.lobe == PM_NONE && pm_spectrum_is_black(outcome.power));
            outcome = play(&bare, (pm_roulette_rule)rule, i);
            CHECK(outcome.lobe == PM_NONE && pm_spectrum_is_black(outcome.power));
        }
    }
}

static void too_many_lobes_are_refused(void)
{
    pm_lobe lobes[PM_LOBES_MAX + 1] = {{0}};
    pm_rng rng = pm_rng_at(&source, 0, 0);
    pm_roulette outcome = {.lobe = 42};
    CHECK_FAILS(pm_trace_roulette(pm_gray(1.0), lobes, PM_LOBES_MAX + 1, PM_ROULETTE_MAX, &rng,
                                  &outcome),
                PM_EINPUT, "at most 3 lobes, got 4");
    CHECK(outcome.lobe == 42);
}

PM_TESTS({"trace.1", "roulette chooses each lobe as often as its rule says",
          lobes_are_chosen_by_rule},
         {"trace.2", "roulette is unbiased in every channel, with the variance it must have",
          power_is_unbiased},
         {"trace.3", "off a red wall the max rule is less noisy than the average rule",
          noise_of_the_rules},
         {"trace.4", "ten bounces at .999 lose a thousandth each", bright_chain_loses_nothing},
         {"trace.5", "roulette depends on reflectances, not on watts", watts_do_not_matter},
         {"trace.6", "a photon without power, or a surface without a lobe, ends there",
          nothing_is_absorbed},
         {"trace.7", "more lobes than there are is refused", too_many_lobes_are_refused})

// The integrating sphere: a diffuse globe, lit from any point inside. Hits per photon, power by
// channel, and where indirect light lands are known exactly.
#include "trace.h"

#include "chance.h"
#include "ledger.h"
#include "scenes.h"
#include "test.h"

#include <string.h>

// --- the integrating sphere: every indirect hit lies anywhere on it

static void globe_scene(pm_scenes *s, pm_spectrum albedo, double radius, double power)
{
    pm_scenes_begin(s);
    pm_scenes_globe(s, radius, pm_scenes_diffuse(s, albedo));
    pm_scenes_point(s, pm_vec(0.0, 0.3 * radius, 0.4 * radius), pm_gray(power));
    pm_scenes_ready(s);
}

static void hits_are_geometric(void)
{
    enum { COUNT = 100000, CELLS = 24 };
    const double rho = 0.6;
    pm_scenes s;
    pm_ledger l;
    globe_scene(&s, pm_gray(rho), 1.0, 1.0);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    pm_ledger_trace(&s, &tracing, COUNT);
    CHECK(l.absorbed == COUNT && l.escaped == 0 && l.first == COUNT && l.caustic == 0);
    double variance = rho / ((1.0 - rho) * (1.0 - rho));
    CHECK_NEAR((double)l.deposits / COUNT, 1.0 / (1.0 - rho), pm_chance_bound(variance, COUNT));
    double expected[CELLS];
    for (int n = 0; n < CELLS; n++) {
        expected[n] = COUNT * (1.0 - rho) * pow(rho, n);
    }
    expected[CELLS - 1] = COUNT * pow(rho, CELLS - 1);
    for (int n = CELLS; n < PM_LEDGER_PATH; n++) {
        l.lengths[CELLS - 1] += l.lengths[n];
    }
    CHECK_FIT(l.lengths, expected, CELLS);
    pm_scenes_free(&s);
}

/// E S^2 of the sum S of ratio^i over the bounces 1.. survived, each with probability `alive`.
static double square_of_sum(double alive, double ratio)
{
    double square = 0.0;
    for (int i = 1; i < 200; i++) {
        for (int j = 1; j < 200; j++) {
            square += pow(ratio, i + j) * pow(alive, i > j ? i : j);
        }
    }
    return square;
}

static void colours_fade_as_they_should(void)
{
    // Red rules the roulette: green and blue shrink by albedo / .6 a bounce.
    enum { COUNT = 100000 };
    const pm_spectrum rho = {{0.6, 0.3, 0.05}};
    pm_scenes s;
    pm_ledger l;
    globe_scene(&s, rho, 1.0, 1.0);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    pm_ledger_trace(&s, &tracing, COUNT);
    for (int c = 0; c < 3; c++) {
        double want = rho.c[c] / (1.0 - rho.c[c]);
        double variance = square_of_sum(0.6, rho.c[c] / 0.6) - want * want;
        CHECK_NEAR(l.direct.c[c] / COUNT, 1.0, 1e-12);
        CHECK_NEAR(l.indirect.c[c] / COUNT, want, pm_chance_bound(variance, COUNT));
    }
    pm_scenes_free(&s);
}

/// Counts where indirect photons land, by height and turn.
static pm_status land(void *context, const pm_deposit *d)
{
    uint64_t *cells = context;
    double radius = pm_vec_length(d->position);
    CHECK_NEAR(radius, 1.0, 1e-14);
    CHECK(d->bounce == 0 || pm_vec_dot(d->direction, d->position) > 0.0);
    if (!d->first) {
        int row = (int)fmin(8.0 * 0.5 * (1.0 + d->position.z), 7.0);
        double turn = atan2(d->position.y, d->position.x) / (2.0 * PM_PI) + 0.5;
        cells[row * 8 + (int)fmin(8.0 * turn, 7.0)]++;
    }
    return PM_OK;
}

static void indirect_light_is_everywhere_alike(void)
{
    uint64_t cells[64] = {0};
    pm_scenes s;
    pm_ledger l;
    globe_scene(&s, pm_gray(0.6), 1.0, 1.0);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    tracing.sink = (pm_trace_sink){cells, land, NULL};
    pm_ledger_trace(&s, &tracing, 100000);
    CHECK_EVEN(cells, 64);
    pm_scenes_free(&s);
}

/// Octants of successive hits of one photon.
typedef struct {
    uint64_t pairs[64];
    uint64_t photon;
    int octant;
} pair_count;

static pm_status pair_up(void *context, const pm_deposit *d)
{
    pair_count *p = context;
    int octant = (d->position.x > 0.0) + 2 * (d->position.y > 0.0) + 4 * (d->position.z > 0.0);
    if (d->bounce > 1 && p->photon == d->photon) {
        p->pairs[8 * p->octant + octant]++;
    }
    p->photon = d->photon;
    p->octant = octant;
    return PM_OK;
}

static void bounces_do_not_know_each_other(void)
{
    pair_count pairs = {.photon = UINT64_MAX};
    pm_scenes s;
    pm_ledger l;
    globe_scene(&s, pm_gray(0.8), 1.0, 1.0);
    pm_tracing tracing = pm_ledger_open(&s, &l);
    tracing.sink = (pm_trace_sink){&pairs, pair_up, NULL};
    pm_ledger_trace(&s, &tracing, 40000);
    CHECK_EVEN(pairs.pairs, 64);
    pm_scenes_free(&s);
}

static void capped_paths_lose_the_rest(void)
{
    enum { COUNT = 100000 };
    const double rho = 0.8;
    for (uint32_t most = 1; most <= 8; most += 7) {
        pm_scenes s;
        pm_ledger l;
        globe_scene(&s, pm_gray(rho), 1.0, 1.0);
        pm_tracing tracing = pm_ledger_open(&s, &l);
        tracing.max_bounces = most;
        pm_ledger_trace(&s, &tracing, COUNT);
        double cut = pow(rho, most);
        double want = (1.0 - cut) * rho / (1.0 - rho);
        double square = 0.0;
        for (uint32_t i = 1; i <= most; i++) {
            square += (2.0 * i - 1.0) * pow(rho, i);
        }
        CHECK_NEAR(l.indirect.c[0] / COUNT, want, pm_chance_bound(square - want * want, COUNT));
        CHECK_NEAR(l.lost.c[0] / COUNT, cut, pm_chance_bound(cut * (1.0 - cut), COUNT));
        CHECK(l.cut + l.absorbed == COUNT);
        pm_scenes_free(&s);
    }
}

static void lamp_power_changes_no_path(void)
{
    enum { COUNT = 20000 };
    static const double factors[3] = {1.0, 1e-6, 0x1p60};
    pm_ledger ledgers[3];
    for (int i = 0; i < 3; i++) {
        pm_scenes s;
        globe_scene(&s, pm_rgb(0.7, 0.5, 0.2), 1.0, factors[i]);
        pm_tracing tracing = pm_ledger_open(&s, &ledgers[i]);
        pm_ledger_trace(&s, &tracing, COUNT);
        CHECK(memcmp(ledgers[i].lengths, ledgers[0].lengths, sizeof ledgers[i].lengths) == 0);
        double want = ledgers[0].indirect.c[1] * factors[i];
        CHECK_NEAR(ledgers[i].indirect.c[1], want, 1e-10 * want);
        pm_scenes_free(&s);
    }
}

static void size_changes_no_path(void)
{
    pm_ledger here;
    pm_ledger there;
    for (int step = -20; step <= 20; step += 10) {
        pm_scenes s;
        globe_scene(&s, pm_gray(0.6), 1.0, 1.0);
        pm_tracing tracing = pm_ledger_open(&s, &here);
        pm_ledger_trace(&s, &tracing, 5000);
        pm_scenes_free(&s);
        globe_scene(&s, pm_gray(0.6), ldexp(1.0, step), 1.0);
        tracing = pm_ledger_open(&s, &there);
        pm_ledger_trace(&s, &tracing, 5000);
        CHECK(memcmp(here.lengths, there.lengths, sizeof here.lengths) == 0);
        pm_scenes_free(&s);
    }
}

PM_TESTS({"trace.10", "in a white sphere hits per photon are geometric, 1 / (1 - albedo)",
          hits_are_geometric},
         {"trace.11", "in a coloured sphere each channel fades by its own albedo",
          colours_fade_as_they_should},
         {"trace.12", "indirect light in a sphere is the same everywhere",
          indirect_light_is_everywhere_alike},
         {"trace.25", "where a photon lands next does not depend on where it was",
          bounces_do_not_know_each_other},
         {"trace.13", "capped after D bounces, 1 - albedo^D is kept and the rest lost",
          capped_paths_lose_the_rest},
         {"trace.14", "the lamp's power changes no path", lamp_power_changes_no_path},
         {"trace.15", "the scene's size changes no path", size_changes_no_path})

// Projection cells: chosen and filled evenly, and what they do to shares and powers.
#include "emit.h"

#include "chance.h"
#include "scenes.h"
#include "test.h"

#include <stdlib.h>

static const pm_rng_source source = {.seed = 1, .stream = PM_STREAM_GLOBAL};

static const uint32_t lit_cells[4] = {3, 17, 40, 63};
static const pm_projection checkered = {8, 8, lit_cells, 4};

/// Number among lit_cells of the cell that holds `u`, or 4.
static int lit_cell_of(const double u[2])
{
    uint32_t cell = (uint32_t)(u[0] * 8.0) * 8 + (uint32_t)(u[1] * 8.0);
    int found = 0;
    while (found < 4 && lit_cells[found] != cell) {
        found++;
    }
    return found;
}

static void cells_are_filled_evenly(void)
{
    enum { DRAWS = 200000, FINE = 16 };
    uint64_t cells[4] = {0};
    static uint64_t inside[FINE * FINE];
    for (uint64_t i = 0; i < DRAWS; i++) {
        pm_rng rng = pm_rng_at(&source, i, 0);
        double u[2];
        CHECK_OK(pm_emit_cell(&checkered, &rng, u));
        int cell = lit_cell_of(u);
        CHECK_THAT(cell < 4, "(%g, %g) lies in a dark cell", u[0], u[1]);
        cells[cell]++;
        double across = u[0] * 8.0 - floor(u[0] * 8.0);
        double along = u[1] * 8.0 - floor(u[1] * 8.0);
        inside[(int)(across * FINE) * FINE + (int)(along * FINE)]++;
    }
    CHECK_EVEN(cells, 4);
    CHECK_EVEN(inside, FINE * FINE);
}

static void no_rows_fill_the_square(void)
{
    enum { DRAWS = 100000, FINE = 16 };
    const pm_projection none = {0};
    const pm_projection *both[2] = {NULL, &none};
    for (int k = 0; k < 2; k++) {
        uint64_t cells[FINE * FINE] = {0};
        for (uint64_t i = 0; i < DRAWS; i++) {
            pm_rng rng = pm_rng_at(&source, i, 0);
            double u[2];
            CHECK_OK(pm_emit_cell(both[k], &rng, u));
            CHECK(u[0] >= 0.0 && u[0] < 1.0 && u[1] >= 0.0 && u[1] < 1.0);
            cells[(int)(u[0] * FINE) * FINE + (int)(u[1] * FINE)]++;
        }
        CHECK_EVEN(cells, FINE * FINE);
    }
}

static void two_points(pm_scenes *s, double first, double second)
{
    pm_scenes_begin(s);
    pm_scenes_point(s, pm_vec(0.0, 0.0, 0.0), pm_gray(first));
    pm_scenes_point(s, pm_vec(1.0, 0.0, 0.0), pm_gray(second));
    pm_scenes_ready(s);
}

static const pm_projection one_checkered[2] = {{8, 8, lit_cells, 4}, {0}};

/// All photons of a pass of `count`; free() them.
static pm_start *emit_all(const pm_scenes *s, uint32_t count, const pm_projection *projections)
{
    uint64_t share[2];
    CHECK_OK(pm_emit_share(&s->scene, projections, count, share));
    pm_emission emission = {&s->scene, source, count, share, projections};
    pm_start *starts = calloc(count, sizeof *starts);
    CHECK(starts != NULL);
    CHECK_OK(pm_emit_photons(&emission, 0, count, starts));
    return starts;
}

/// Power sent by `starts` into directions of lit cells, a photon.
static double lit_power(const pm_start *starts, uint32_t count)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        pm_vec3 d = starts[i].ray.direction;
        double turn = atan2(d.y, d.x) / (2.0 * PM_PI);
        double u[2] = {0.5 * (1.0 - d.z), turn < 0.0 ? turn + 1.0 : turn};
        sum += lit_cell_of(u) < 4 ? starts[i].power.c[0] : 0.0;
    }
    return sum / count;
}

static void projection_scales_power(void)
{
    // 1/16 of a point light's 5 W go through the lit cells, with the map (exactly) or without
    // it (binomial).
    enum { COUNT = 200000 };
    pm_scenes s;
    two_points(&s, 5.0, 0.0);
    pm_start *with = emit_all(&s, COUNT, one_checkered);
    pm_start *without = emit_all(&s, COUNT, NULL);
    CHECK_NEAR(lit_power(with, COUNT), 5.0 / 16.0, 1e-3 * 5.0 / 16.0); // rounded onto borders
    CHECK_NEAR(with[0].power.c[0], 5.0 / 16.0, 1e-15);
    CHECK_NEAR(lit_power(without, COUNT), 5.0 / 16.0,
               5.0 * pm_chance_bound(1.0 / 16.0 * 15.0 / 16.0, COUNT));
    free(with);
    free(without);
    pm_scenes_free(&s);
}

static void a_cell_is_never_left(void)
{
    // 1 - 2^-53, the last number below 1, rounds up to the next cell when it is added to 4095.
    const uint32_t last = 4095;
    const pm_projection fine = {4096, 1, &last, 1};
    pm_rng rng = {.words = {UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX}};
    double u[2];
    CHECK_OK(pm_emit_cell(&fine, &rng, u)); // two words pick the cell, two the place in it
    CHECK(u[0] >= 4095.0 / 4096.0 && u[0] < 1.0);
}

static void shares_follow_what_is_sent(void)
{
    // 6 W through 4 of 64 cells against 1 W everywhere: 3 to 8.
    pm_scenes s;
    two_points(&s, 6.0, 1.0);
    uint64_t share[2];
    CHECK_OK(pm_emit_share(&s.scene, one_checkered, 1100, share));
    CHECK(share[0] == 300 && share[1] == 800);
    pm_start *starts = emit_all(&s, 1100, one_checkered);
    for (int i = 0; i < 1100; i++) {
        CHECK_NEAR(starts[i].power.c[1], 1.375, 1e-14);
    }
    free(starts);
    pm_scenes_free(&s);
}

static void a_light_without_lit_cells_sends_nothing(void)
{
    static const pm_projection first_dark[2] = {{8, 8, NULL, 0}, {0}};
    static const pm_projection all_dark[2] = {{8, 8, NULL, 0}, {1, 1, NULL, 0}};
    pm_scenes s;
    two_points(&s, 6.0, 1.0);
    uint64_t share[2];
    CHECK_OK(pm_emit_share(&s.scene, first_dark, 50, share));
    CHECK(share[0] == 0 && share[1] == 50);
    pm_start *starts = emit_all(&s, 50, first_dark);
    for (int i = 0; i < 50; i++) {
        CHECK(starts[i].light == 1 && starts[i].power.c[0] == 1.0);
    }
    free(starts);
    CHECK_OK(pm_emit_share(&s.scene, first_dark, 1, share));
    CHECK(share[0] == 0 && share[1] == 1);
    CHECK_OK(pm_emit_share(&s.scene, all_dark, 50, share));
    CHECK(share[0] == 0 && share[1] == 0);
    pm_rng rng = pm_rng_at(&source, 0, 0);
    double u[2] = {7.0, 7.0};
    CHECK_FAILS(pm_emit_cell(&first_dark[0], &rng, u), PM_EINPUT, "without a lit cell");
    CHECK(u[0] == 7.0 && u[1] == 7.0);
    pm_scenes_free(&s);
}

static void a_weak_aimed_light_is_not_lost(void)
{
    // 1e-9 W through 1/16 of the cells still send one photon of exactly that power.
    pm_scenes s;
    two_points(&s, 1e-9, 1.0);
    pm_start *starts = emit_all(&s, 100, one_checkered);
    int from_weak = 0;
    for (int i = 0; i < 100; i++) {
        if (starts[i].light == 0) {
            from_weak++;
            CHECK_NEAR(starts[i].power.c[0], 100.0 * 1e-9 / 16.0, 1e-22);
        }
    }
    CHECK(from_weak == 1);
    free(starts);
    pm_scenes_free(&s);
}

PM_TESTS({"emit.10", "lit cells are chosen evenly and filled evenly, dark ones never",
          cells_are_filled_evenly},
         {"emit.11", "without rows the whole square is filled", no_rows_fill_the_square},
         {"emit.12", "a projection map changes no light's power through its lit cells",
          projection_scales_power},
         {"emit.13", "rounding leads out of no cell", a_cell_is_never_left},
         {"emit.14", "shares follow the power that is sent, so photons carry the same power",
          shares_follow_what_is_sent},
         {"emit.15", "a light without a lit cell sends nothing",
          a_light_without_lit_cells_sends_nothing},
         {"emit.16", "a weak light that is aimed keeps its photon and its power",
          a_weak_aimed_light_is_not_lost})

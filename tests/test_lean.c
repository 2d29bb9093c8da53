// The lean of discs by straight edges, against the closed form.
#include "balance.h"
#include "lean.h"
#include "photon_map.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

enum { K = 400 };

/// 20,000 photons evenly over -2 < x < 0, -1 < y < 1.
static void sow(pm_photon_map *map)
{
    for (uint32_t i = 0; i < 20000; i++) {
        pm_rng rng = pm_shapes_rng(i, 61);
        double x = -2.0 * pm_rng_draw(&rng);
        double y = 2.0 * pm_rng_draw(&rng) - 1.0;
        pm_deposit deposit = {
            .position = pm_vec(x, y, 0.0),
            .direction = pm_vec(0.0, 0.0, -1.0),
            .normal = pm_vec(0.0, 0.0, 1.0),
            .power = pm_gray(1.0),
        };
        CHECK_OK(pm_store_push(map, &deposit));
    }
    CHECK_OK(pm_store_scale(map, 1));
    CHECK_OK(pm_balance_build(map));
}

/// Lean of a disc whose edge is at `a` of its radius.
static double closed_form(double a)
{
    if (a >= 1.0) {
        return 0.0;
    }
    double area = PM_PI - acos(a) + a * sqrt(1.0 - a * a);
    return 2.0 / 3.0 * pow(1.0 - a * a, 1.5) / area;
}

static void discs_lean_away_from_edges(void)
{
    pm_photon_map map = {.kind = PM_MAP_GLOBAL, .scale = 1.0};
    sow(&map);
    pm_estimate_settings settings = pm_estimate_defaults();
    settings.k = K;
    for (int i = 0; i < 12; i++) {
        pm_estimate_point point = {pm_vec(-0.02 * i, 0.1, 0.0), pm_vec(0.0, 0.0, 1.0)};
        pm_neighbour scratch[K];
        pm_estimate found;
        CHECK_OK(pm_estimate_irradiance(&map, &settings, &point, scratch, &found));
        double lean = pm_lean_of(&map, scratch, &found, &point);
        double a = 0.02 * i / found.radius;
        // Each axis of the mean has a deviation of at most 1 / (2 sqrt k).
        CHECK_NEAR(lean, closed_form(a), 5.0 * 0.5 / sqrt(K));
        CHECK(a > 0.35 || pm_lean_is_edge(lean, found.found));
        CHECK(a < 0.8 || !pm_lean_is_edge(lean, found.found));
    }
    pm_photon_map_free(&map);
}

// 2.5 deviations of 1 / (2 sqrt k) are 0.28 for 20 photons.
static void few_photons_lean_by_chance(void)
{
    CHECK(!pm_lean_is_edge(0.14, 100000));
    CHECK(pm_lean_is_edge(0.16, 100));
    CHECK(!pm_lean_is_edge(0.27, 20) && pm_lean_is_edge(0.29, 20));
    CHECK(!pm_lean_is_edge(0.0, 0));
    pm_estimate none = {0};
    pm_estimate_point point = {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    CHECK_NEAR(pm_lean_of(NULL, NULL, &none, &point), 0.0, 0.0);
}

PM_TESTS({"lean.1", "a disc leans away from an edge as the closed form says",
          discs_lean_away_from_edges},
         {"lean.2", "what chance does to few photons is no edge", few_photons_lean_by_chance})

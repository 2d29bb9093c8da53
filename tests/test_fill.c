// The unevenness of discs by edges and on strips, against quadrature.
#include "balance.h"
#include "fill.h"
#include "photon_map.h"
#include "shapes.h"
#include "store.h"
#include "test.h"

enum { K = 400, FINE = 400 };

/// 40,000 photons evenly over `low` < x < `high`, -1 < y < 1.
static void sow(pm_photon_map *map, double low, double high)
{
    for (uint32_t i = 0; i < 40000; i++) {
        pm_rng rng = pm_shapes_rng(i, 61);
        double x = low + (high - low) * pm_rng_draw(&rng);
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

/// Of the part of the unit disc at `low` < x < `high`, by the midpoints of a fine grid.
static double by_quadrature(double low, double high)
{
    double count = 0.0;
    double x_sum = 0.0;
    double square = 0.0;
    double across = 0.0;
    for (int i = 0; i < FINE * FINE; i++) {
        double x = 2.0 * (i % FINE + 0.5) / FINE - 1.0;
        double y = 2.0 * (double)(i / FINE) / FINE + 1.0 / FINE - 1.0;
        if (x > low && x < high && x * x + y * y < 1.0) {
            count++;
            x_sum += x;
            square += x * x + y * y - 0.5;
            across += x * x - y * y;
        }
    }
    return (4.0 * x_sum * x_sum + 6.0 * across * across + 12.0 * square * square) /
           (count * count);
}

/// Unevenness at x, and the radius used.
static double unevenness_at(const pm_photon_map *map, double x, double *radius)
{
    pm_estimate_settings settings = pm_estimate_defaults();
    settings.k = K;
    pm_estimate_point point = {pm_vec(x, 0.1, 0.0), pm_vec(0.0, 0.0, 1.0)};
    pm_neighbour scratch[K];
    pm_estimate found;
    CHECK_OK(pm_estimate_irradiance(map, &settings, &point, scratch, &found));
    CHECK(found.found == K);
    *radius = found.radius;
    return pm_fill_unevenness(map, scratch, &found, &point);
}

/// By its root, whose parts have deviations of at most 1 / sqrt(k) each, five of them.
static void agrees(double got, double want)
{
    CHECK_NEAR(sqrt(got), sqrt(want), 5.0 / sqrt(K));
}

static void edges_are_uneven(void)
{
    pm_photon_map map = {.kind = PM_MAP_GLOBAL, .scale = 1.0};
    sow(&map, -2.0, 0.0);
    for (int i = 0; i < 12; i++) {
        double x = -0.02 * i;
        double radius;
        double got = unevenness_at(&map, x, &radius);
        agrees(got, by_quadrature(-1.0, -x / radius));
        CHECK(-x / radius > 0.5 || pm_fill_is_uneven(got, K));
        CHECK(-x / radius < 0.9 || !pm_fill_is_uneven(got, K));
    }
    pm_photon_map_free(&map);
}

static void strips_are_uneven(void)
{
    for (int i = 1; i <= 6; i++) {
        pm_photon_map map = {.kind = PM_MAP_GLOBAL, .scale = 1.0};
        double half = 0.02 * i;
        sow(&map, -half, half);
        double radius;
        double got = unevenness_at(&map, 0.0, &radius);
        agrees(got, by_quadrature(-half / radius, half / radius));
        CHECK(half > 0.65 * radius || pm_fill_is_uneven(got, K));
        CHECK(half < 1.0 * radius || !pm_fill_is_uneven(got, K));
        pm_photon_map_free(&map);
    }
}

/// k times the unevenness of even discs is chi-square with five degrees of freedom: mean 5,
/// variance 10. 100 discs that do not overlap.
static void even_discs_follow_chi_square(void)
{
    enum { FEW = 100 };
    pm_photon_map map = {.kind = PM_MAP_GLOBAL, .scale = 1.0};
    sow(&map, -1.0, 1.0);
    pm_estimate_settings settings = pm_estimate_defaults();
    settings.k = FEW;
    double sum = 0.0;
    for (int i = 0; i < 100; i++) {
        pm_estimate_point point = {
            pm_vec(-0.81 + 0.18 * (i % 10), -0.81 + 0.18 * (i / 10), 0.0),
            pm_vec(0.0, 0.0, 1.0)};
        pm_neighbour scratch[FEW];
        pm_estimate found;
        CHECK_OK(pm_estimate_irradiance(&map, &settings, &point, scratch, &found));
        CHECK(found.radius < 0.09);
        sum += FEW * pm_fill_unevenness(&map, scratch, &found, &point);
    }
    CHECK_NEAR(sum / 100.0, 5.0, 5.0 * sqrt(10.0 / 100.0));
    pm_photon_map_free(&map);
}

static void few_photons_are_uneven_by_chance(void)
{
    CHECK(!pm_fill_is_uneven(0.089, 100000) && pm_fill_is_uneven(0.091, 100000));
    CHECK(!pm_fill_is_uneven(0.5, 20) && pm_fill_is_uneven(0.6, 20));
    CHECK(!pm_fill_is_uneven(0.0, 0));
    pm_estimate none = {0};
    pm_estimate_point point = {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}};
    CHECK_NEAR(pm_fill_unevenness(NULL, NULL, &none, &point), 0.0, 0.0);
}

PM_TESTS({"fill.1", "discs over an edge are as uneven as quadrature says", edges_are_uneven},
         {"fill.2", "discs on a narrow strip are, too", strips_are_uneven},
         {"fill.3", "the unevenness of even discs is chi-square", even_discs_follow_chi_square},
         {"fill.4", "what chance does to few photons is no fault",
          few_photons_are_uneven_by_chance})

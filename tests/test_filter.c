// Kernels: their integrals by quadrature, their constants in closed form, their limits; and
// differential checking on sets made by hand and by chance.
#include "filter.h"
#include "rng.h"
#include "test.h"

#include <gsl/gsl_integration.h>
#include <math.h>

static double weight_of(pm_filter_kind kind, pm_filter_constants constants, double u)
{
    double weight;
    CHECK_OK(pm_filter_weight(kind, constants, u, &weight));
    return weight;
}

static double normalisation_of(pm_filter_kind kind, pm_filter_constants constants)
{
    double normalisation;
    CHECK_OK(pm_filter_normalisation(kind, constants, &normalisation));
    return normalisation;
}

// --- integrals ------------------------------------------------------------------------------

typedef struct {
    pm_filter_kind kind;
    pm_filter_constants constants;
} kernel;

static double ring(double d, void *context)
{
    const kernel *of = context;
    return 2.0 * d * weight_of(of->kind, of->constants, d * d);
}

/// Mean weight over the unit disc, in rings: the same integral as over u, by another way.
static double mean_weight(pm_filter_kind kind, pm_filter_constants constants)
{
    kernel of = {kind, constants};
    gsl_function integrand = {ring, &of};
    gsl_integration_workspace *room = gsl_integration_workspace_alloc(1000);
    double result;
    double error;
    CHECK(gsl_integration_qags(&integrand, 0.0, 1.0, 0.0, 1e-12, 1000, room, &result, &error) ==
          0);
    gsl_integration_workspace_free(room);
    return result;
}

static void weights_integrate_to_their_normalisation(void)
{
    for (pm_filter_kind kind = 0; kind < PM_FILTER_COUNT; kind++) {
        CHECK_NEAR(mean_weight(kind, PM_CONSTANTS_UNBIASED) /
                       normalisation_of(kind, PM_CONSTANTS_UNBIASED),
                   1.0, 1e-11);
    }
    double lecture = normalisation_of(PM_FILTER_GAUSSIAN, PM_CONSTANTS_LECTURE);
    CHECK_NEAR(lecture, 1.0, 0.0); // that is what it claims
    CHECK_NEAR(mean_weight(PM_FILTER_GAUSSIAN, PM_CONSTANTS_LECTURE), 0.531155, 1e-6);
}

static void constants_are_the_published_ones(void)
{
    CHECK_NEAR(weight_of(PM_FILTER_GAUSSIAN, PM_CONSTANTS_UNBIASED, 0.0), 1.728309, 5e-7);
    CHECK_NEAR(weight_of(PM_FILTER_GAUSSIAN, PM_CONSTANTS_LECTURE, 0.0), 0.918, 0.0);
    CHECK_NEAR(normalisation_of(PM_FILTER_CONE, PM_CONSTANTS_UNBIASED), 1.0 - 2.0 / 3.3, 1e-15);
    CHECK_NEAR(weight_of(PM_FILTER_CONE, PM_CONSTANTS_LECTURE, 1.0), 1.0 - 1.0 / 1.1, 1e-15);
    CHECK_NEAR(weight_of(PM_FILTER_CONE, PM_CONSTANTS_LECTURE, 0.25), 1.0 - 0.5 / 1.1, 1e-15);
    CHECK_NEAR(weight_of(PM_FILTER_EPANECHNIKOV, PM_CONSTANTS_UNBIASED, 0.25), 1.5, 1e-15);
    CHECK_NEAR(weight_of(PM_FILTER_NONE, PM_CONSTANTS_UNBIASED, 0.7), 1.0, 0.0);
    double beta = 1.953;
    double half_way = 1.0 - (1.0 - exp(-beta * 0.25)) / (1.0 - exp(-beta));
    CHECK_NEAR(weight_of(PM_FILTER_GAUSSIAN, PM_CONSTANTS_LECTURE, 0.5), 0.918 * half_way,
               1e-15);
}

static void weights_fall_and_stay_positive(void)
{
    for (pm_filter_kind kind = 0; kind < PM_FILTER_COUNT; kind++) {
        for (int lecture = 0; lecture < 2; lecture++) {
            pm_filter_constants constants = (pm_filter_constants)lecture;
            double before = weight_of(kind, constants, 0.0);
            for (int i = 1; i <= 1000; i++) {
                double weight = weight_of(kind, constants, i / 1000.0);
                CHECK(weight >= 0.0 && weight <= before);
                before = weight;
            }
            CHECK(weight_of(kind, constants, 1.0 + 1e-15) == 0.0);
            CHECK(weight_of(kind, constants, 1e300) == 0.0);
        }
    }
}

static void wrong_filters_are_refused(void)
{
    double out = 42.0;
    pm_filter_constants unbiased = PM_CONSTANTS_UNBIASED;
    CHECK_FAILS(pm_filter_weight(PM_FILTER_COUNT, unbiased, 0.5, &out), PM_EINPUT, "number 4");
    CHECK_FAILS(pm_filter_weight(PM_FILTER_NONE, unbiased, -1e-9, &out), PM_EINPUT, "u = ");
    CHECK_FAILS(pm_filter_weight(PM_FILTER_CONE, unbiased, (double)NAN, &out), PM_EINPUT,
                "nan");
    CHECK_FAILS(pm_filter_normalisation(PM_FILTER_COUNT, unbiased, &out), PM_EINPUT,
                "number 4");
    CHECK(out == 42.0);
}

// --- differential checking ------------------------------------------------------------------

static uint32_t kept_of(const double *distance2, const double *power, uint32_t count,
                        uint32_t least)
{
    uint32_t kept;
    CHECK_OK(pm_filter_differential(distance2, power, count, least, &kept));
    return kept;
}

/// Forty evenly spread photons of power 1, then sixty of power `beyond`.
static uint32_t kept_at_edge(double beyond, uint32_t least)
{
    double distance2[100];
    double power[100];
    for (int i = 0; i < 100; i++) {
        distance2[i] = i + 1.0;
        power[i] = i < 40 ? 1.0 : beyond;
    }
    return kept_of(distance2, power, 100, least);
}

static void an_edge_ends_the_disc(void)
{
    // Darkness is beyond doubt when about 36 of 76 places are empty, brightness sooner.
    uint32_t dark = kept_at_edge(0.0, 8);
    CHECK_THAT(dark >= 36 && dark <= 40, "kept %u of 40", dark);
    uint32_t bright = kept_at_edge(9.0, 8);
    CHECK_THAT(bright >= 20 && bright <= 40, "kept %u of 40", bright);
    CHECK(kept_at_edge(1.0, 8) == 100);
    CHECK(kept_at_edge(0.0, 45) >= 45); // never below the least
}

static void limits_of_keeping(void)
{
    double distance2[50];
    double power[50];
    for (int i = 0; i < 50; i++) {
        distance2[i] = i + 1.0;
        power[i] = i % 2 ? 0.5 : 1.5; // the estimate swings, there is no trend
    }
    CHECK(kept_of(distance2, power, 50, 10) == 50);
    CHECK(kept_of(distance2, power, 5, 10) == 5);
    CHECK(kept_of(distance2, power, 0, 10) == 0);
    CHECK(kept_of(distance2, power, 1, 0) <= 1);
    double same[20] = {0.0};
    double ones[20];
    for (int i = 0; i < 20; i++) {
        ones[i] = 1.0;
    }
    CHECK(kept_of(same, ones, 20, 4) == 20); // coincident: no density to compare
    double late[20] = {0.0};
    late[18] = 1.0;
    late[19] = 2.0;
    CHECK(kept_of(late, ones, 20, 4) >= 4);
}

static void flat_fields_keep_their_mean(void)
{
    // pi r_i^2 of an even field are cumulated unit exponentials. The rule costs photons, and so
    // noise; the estimate from what it keeps must stay near the truth.
    const int trials = 20000;
    double sum = 0.0;
    double kept_sum = 0.0;
    for (int t = 0; t < trials; t++) {
        pm_rng_source source = {.seed = 21, .stream = PM_STREAM_TEST};
        pm_rng rng = pm_rng_at(&source, (uint64_t)t, 0);
        double area[100];
        double power[100];
        double at = 0.0;
        for (int i = 0; i < 100; i++) {
            at -= log(1.0 - pm_rng_draw(&rng));
            area[i] = at;
            power[i] = 1.0;
        }
        uint32_t kept = kept_of(area, power, 100, 8);
        CHECK(kept >= 8 && kept <= 100);
        sum += (kept - 1.0) / area[kept - 1];
        kept_sum += kept;
    }
    // Stopping has a price: 1.1 % too dark. sd of one is 0.2.
    CHECK_NEAR(sum / trials, 0.989, 5.0 * 0.2 / sqrt(trials));
    CHECK_NEAR(kept_sum / trials, 95.0, 2.0);
}

static void unsorted_photons_are_refused(void)
{
    uint32_t kept = 7;
    double power[3] = {1.0, 1.0, 1.0};
    double falling[3] = {1.0, 3.0, 2.0};
    double below[3] = {-1.0, 1.0, 2.0};
    double rising[3] = {1.0, 2.0, 3.0};
    double nan[3] = {1.0, (double)NAN, 3.0};
    CHECK_FAILS(pm_filter_differential(falling, power, 3, 1, &kept), PM_EINPUT, "photon 2");
    CHECK_FAILS(pm_filter_differential(below, power, 3, 1, &kept), PM_EINPUT, "photon 0");
    CHECK_FAILS(pm_filter_differential(nan, power, 3, 1, &kept), PM_EINPUT, "photon 1");
    power[1] = -1.0;
    CHECK_FAILS(pm_filter_differential(rising, power, 3, 1, &kept), PM_EINPUT, "photon 1");
    CHECK(kept == 7);
}

PM_TESTS({"filter.1", "every kernel integrates to its normalisation over the disc",
          weights_integrate_to_their_normalisation},
         {"filter.2", "the constants are the published ones", constants_are_the_published_ones},
         {"filter.3", "weights fall with distance, are never negative, and end at the radius",
          weights_fall_and_stay_positive},
         {"filter.4", "filters that do not exist are refused", wrong_filters_are_refused},
         {"filter.5", "differential checking stops at an edge", an_edge_ends_the_disc},
         {"filter.6", "differential checking keeps all where there is no trend",
          limits_of_keeping},
         {"filter.7", "differential checking keeps the mean of a flat field",
          flat_fields_keep_their_mean},
         {"filter.8", "photons that are not sorted are refused", unsorted_photons_are_refused})

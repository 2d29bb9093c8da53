// The spread of facet normals: normalised, seen as Smith says, and drawn as they are seen.
#include "microfacet.h"

#include "chance.h"
#include "quadrature.h"
#include "test.h"

static const pm_rng_source source = {.seed = 5, .stream = PM_STREAM_TEST};
static const pm_microfacet_kind kinds[2] = {PM_MICROFACET_BECKMANN, PM_MICROFACET_GGX};
static const double alphas[6] = {1e-4, 0.01, 0.1, 0.3, 1.0, 10.0};
static const double cosines[6] = {1.0, 0.9, 0.5, 0.1, 1e-3, 1e-9};

/// The slope over alpha below which a share u of the flat area's facets lies.
static double slope_at(pm_microfacet_kind kind, double u)
{
    return kind == PM_MICROFACET_GGX ? sqrt(u / (1.0 - u)) : sqrt(-log(1.0 - u));
}

static double density_textbook(pm_microfacet facets, double cosine)
{
    double c2 = cosine * cosine;
    double t = (1.0 / c2 - 1.0) / (facets.alpha * facets.alpha);
    double front = 1.0 / (PM_PI * facets.alpha * facets.alpha * c2 * c2);
    return facets.kind == PM_MICROFACET_GGX ? front / ((1.0 + t) * (1.0 + t)) : front * exp(-t);
}

static void densities(void)
{
    for (int k = 0; k < 2; k++) {
        for (int a = 1; a < 6; a++) {
            pm_microfacet facets = {kinds[k], alphas[a]};
            for (int i = 1; i < 100; i++) {
                double cosine = cos(atan(facets.alpha * slope_at(kinds[k], i * 0.01)));
                double want = density_textbook(facets, cosine);
                double got =
                    pm_microfacet_density(facets, cosine * cosine, 1.0 - cosine * cosine);
                CHECK_NEAR(got, want, 1e-10 * want);
            }
        }
    }
    // Upright, and flat on its side.
    CHECK_NEAR(pm_microfacet_density((pm_microfacet){PM_MICROFACET_GGX, 0.5}, 1.0, 0.0),
               4.0 / PM_PI, 1e-15);
    CHECK_NEAR(pm_microfacet_density((pm_microfacet){PM_MICROFACET_BECKMANN, 0.5}, 1.0, 0.0),
               4.0 / PM_PI, 1e-15);
    CHECK_NEAR(pm_microfacet_density((pm_microfacet){PM_MICROFACET_BECKMANN, 0.5}, 0.0, 1.0),
               0.0, 0.0);
}

/// Integral of D(m) f(m) over the hemisphere of normals, by rings of facets.
static double sum_over_facets(pm_microfacet facets, double cosine)
{
    enum { STEPS = 200 };
    double sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    double sum = 0.0;
    for (int i = 0; i < STEPS; i++) {
        // Angles of the stretched slope: both tails fit.
        double psi = 0.5 * PM_PI * (i + 0.5) / STEPS;
        double theta = atan(facets.alpha * tan(psi));
        double widen = facets.alpha * pow(cos(theta) / cos(psi), 2.0); // d theta / d psi
        double c2 = cos(theta) * cos(theta);
        double density = pm_microfacet_density(facets, c2, sin(theta) * sin(theta));
        double ring = 0.5 * PM_PI / STEPS * widen * sin(theta) * density;
        for (int j = 0; j < STEPS; j++) {
            double phi = PM_PI * (j + 0.5) / STEPS;
            double seen = cosine * cos(theta) + sine * sin(theta) * cos(phi);
            sum += ring * 2.0 * PM_PI / STEPS * pm_most(0.0, seen);
        }
    }
    return sum;
}

static void seen_areas(void)
{
    for (int k = 0; k < 2; k++) {
        for (int a = 0; a < 6; a++) {
            pm_microfacet facets = {kinds[k], alphas[a]};
            for (int c = 0; c < 6; c += a == 2 || a == 4 ? 1 : 2) {
                double got = pm_microfacet_seen(facets, cosines[c]);
                CHECK_NEAR(got, sum_over_facets(facets, cosines[c]), 1e-3 * got);
                CHECK(got >= cosines[c] * (1.0 - 1e-15));
            }
            // Straight on, all of the surface; sideways, what stands up.
            CHECK_NEAR(pm_microfacet_seen(facets, 1.0), 1.0, 1e-15);
            double side = kinds[k] == PM_MICROFACET_GGX ? 0.5 : 0.5 / sqrt(PM_PI);
            CHECK_NEAR(pm_microfacet_seen(facets, 0.0), side * facets.alpha, 1e-15);
        }
    }
}

enum { CELLS = 8, FINE = 8, DRAWS = 12000 };

/// What the facets of one cell (share of slopes, half turn) show of themselves, over `seen`.
static double expected_in(pm_microfacet facets, pm_vec3 wi, int row, int column)
{
    double flat = hypot(wi.x, wi.y);
    double sum = 0.0;
    for (int i = 0; i < FINE; i++) {
        double slope = facets.alpha * slope_at(facets.kind, (row + (i + 0.5) / FINE) / CELLS);
        for (int j = 0; j < FINE; j++) {
            double phi = PM_PI * (column + (j + 0.5) / FINE) / CELLS;
            sum += pm_most(0.0, wi.z + slope * flat * cos(phi));
        }
    }
    double share = sum / (CELLS * CELLS * FINE * FINE);
    return share / pm_microfacet_seen(facets, wi.z);
}

/// The cell of a normal: how steep it is, and how far it is turned from (0.6, -0.8), where the
/// direction is.
static int cell_of(pm_microfacet facets, pm_vec3 m)
{
    double slope2 = (m.x * m.x + m.y * m.y) / (m.z * m.z * facets.alpha * facets.alpha);
    double u = facets.kind == PM_MICROFACET_GGX ? slope2 / (1.0 + slope2) : 1.0 - exp(-slope2);
    double turn = fabs(atan2(0.6 * m.y + 0.8 * m.x, 0.6 * m.x - 0.8 * m.y)) / PM_PI;
    int row = (int)fmin(u * CELLS, CELLS - 1);
    return row * CELLS + (int)fmin(turn * CELLS, CELLS - 1);
}

static void check_normals(pm_microfacet facets, double cosine)
{
    double sine = sqrt((1.0 - cosine) * (1.0 + cosine));
    pm_vec3 wi = pm_vec(0.6 * sine, -0.8 * sine, cosine);
    uint64_t counts[CELLS * CELLS + 1] = {0};
    double expected[CELLS * CELLS + 1] = {0.0};
    int into[CELLS * CELLS];
    double rest = 1.0; // the steepest ring has a long tail: the rest goes by difference
    for (int i = 0; i < CELLS * CELLS; i++) {
        double share =
            i / CELLS == CELLS - 1 ? 0.0 : expected_in(facets, wi, i / CELLS, i % CELLS);
        into[i] = share * DRAWS > 10.0 ? i : CELLS * CELLS;
        expected[i] = into[i] == i ? share * DRAWS : 0.0;
        rest -= into[i] == i ? share : 0.0;
    }
    expected[CELLS * CELLS] = rest * DRAWS;
    for (uint64_t i = 0; i < DRAWS; i++) {
        pm_rng rng = pm_rng_at(&source, i, 1);
        pm_vec3 m = pm_microfacet_normal(facets, wi, &rng);
        CHECK_NEAR(pm_vec_length(m), 1.0, 1e-14);
        CHECK(pm_vec_dot(m, wi) >= -1e-15 && m.z >= 0.0);
        counts[into[cell_of(facets, m)]]++;
    }
    CHECK_FIT(counts, expected, CELLS * CELLS + 1);
}

static void normals(void)
{
    for (int k = 0; k < 2; k++) {
        for (int a = 0; a < 6; a++) {
            for (int c = a % 2; c < 6; c += 2) {
                check_normals((pm_microfacet){kinds[k], alphas[a]}, cosines[c]);
            }
        }
    }
}

static void straight_and_sideways(void)
{
    for (int k = 0; k < 2; k++) {
        for (int a = 0; a < 6; a++) {
            for (uint64_t i = 0; i < 200; i++) {
                pm_microfacet facets = {kinds[k], alphas[a]};
                pm_rng rng = pm_rng_at(&source, i, 2);
                pm_vec3 m = pm_microfacet_normal(facets, pm_vec(0.0, 0.0, 1.0), &rng);
                CHECK_NEAR(pm_vec_length(m), 1.0, 1e-14);
                m = pm_microfacet_normal(facets, pm_vec(1.0, 0.0, 0.0), &rng);
                CHECK_NEAR(pm_vec_length(m), 1.0, 1e-14);
                CHECK(m.x >= 0.0 && m.z >= 0.0);
            }
        }
    }
}

static void polynomials(void)
{
    for (int count = 1; count <= PM_QUADRATURE_MAX; count += 7) {
        double node[PM_QUADRATURE_MAX];
        double weight[PM_QUADRATURE_MAX];
        pm_quadrature_nodes(count, node, weight);
        for (int degree = 0; degree < 2 * count; degree++) {
            double sum = 0.0;
            for (int i = 0; i < count; i++) {
                CHECK(i == 0 || node[i] > node[i - 1]);
                sum += weight[i] * pow(node[i], degree);
            }
            CHECK_NEAR(sum, 1.0 / (degree + 1.0), 1e-14);
        }
    }
}

PM_TESTS({"microfacet.1", "densities are the textbook's, in other words", densities},
         {"microfacet.2", "the area that is seen is the integral over all facets", seen_areas},
         {"microfacet.3", "normals are drawn as the direction sees them", normals},
         {"microfacet.4", "straight on and sideways normals are still normals",
          straight_and_sideways},
         {"quadrature.1", "n nodes integrate polynomials of degree 2 n - 1", polynomials})

// Chi-square by GSL.
#include "chance.h"

#include "test.h"

#include <gsl/gsl_cdf.h>
#include <math.h>

#define SIGMA 5.0

double pm_chance_bound(double variance, double count)
{
    return SIGMA * sqrt(variance / count);
}

static void judge(const char *file, int line, const char *what, double chi2, double freedom)
{
    double least = gsl_cdf_ugaussian_Q(SIGMA);
    double above = gsl_cdf_chisq_Q(chi2, freedom);
    double below = gsl_cdf_chisq_P(chi2, freedom);
    if (!(above > least && below > least)) {
        pm_test_fail(file, line, "%s: chi-square %g with %g degrees of freedom, p = %.2g", what,
                     chi2, freedom, fmin(above, below));
    }
}

void pm_chance_fit(const char *file, int line, const char *what, const uint64_t *counts,
                   const double *expected, size_t cells)
{
    double chi2 = 0.0;
    double freedom = -1.0;
    for (size_t i = 0; i < cells; i++) {
        double count = (double)counts[i];
        if (expected[i] == 0.0 && counts[i] != 0) {
            pm_test_fail(file, line, "%s: cell %zu must be empty, holds %g", what, i, count);
        }
        if (expected[i] > 0.0) {
            chi2 += (count - expected[i]) * (count - expected[i]) / expected[i];
            freedom += 1.0;
        }
    }
    judge(file, line, what, chi2, freedom);
}

void pm_chance_even(const char *file, int line, const char *what, const uint64_t *counts,
                    size_t cells)
{
    double total = 0.0;
    for (size_t i = 0; i < cells; i++) {
        total += (double)counts[i];
    }
    double each = total / (double)cells;
    double chi2 = 0.0;
    for (size_t i = 0; i < cells; i++) {
        chi2 += ((double)counts[i] - each) * ((double)counts[i] - each) / each;
    }
    judge(file, line, what, chi2, (double)cells - 1.0);
}

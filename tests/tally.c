// Sums of values and their squares; few enough values that these lose no digits that matter.
#include "tally.h"

#include "test.h"

#include <math.h>

void pm_tally_take(pm_tally *tally, double value)
{
    tally->sum += value;
    tally->squares += value * value;
    tally->count++;
}

double pm_tally_mean(const pm_tally *tally)
{
    return tally->sum / tally->count;
}

double pm_tally_variance(const pm_tally *tally)
{
    double mean = pm_tally_mean(tally);
    return tally->squares / tally->count - mean * mean;
}

void pm_tally_same(const char *what, const pm_tally *a, const pm_tally *b)
{
    double mean = pm_tally_mean(b);
    double sigma =
        sqrt(fabs(pm_tally_variance(a)) / a->count + fabs(pm_tally_variance(b)) / b->count);
    CHECK_THAT(sigma < 0.05 * mean, "%s: sigma %g of %g tells nothing", what, sigma, mean);
    // Means of the same number over and over differ by rounding alone.
    CHECK_THAT(fabs(pm_tally_mean(a) - mean) <= 5.0 * sigma + 1e-12 * mean,
               "%s: %g and %g, sigma %g", what, pm_tally_mean(a), mean, sigma);
}

// Means of many runs, and whether two of them agree.
#ifndef PM_TALLY_H
#define PM_TALLY_H

/// Zero-initialised it is empty.
typedef struct {
    double sum, squares;
    int count;
} pm_tally;

void pm_tally_take(pm_tally *tally, double value);
double pm_tally_mean(const pm_tally *tally);

/// Of one run, not of the mean.
double pm_tally_variance(const pm_tally *tally);

/// Fails the test when the means differ by more than 5 sigma of both, and when they scatter so
/// much (sigma above 5 % of the second) that this tells nothing.
void pm_tally_same(const char *what, const pm_tally *a, const pm_tally *b);

#endif

// The nodes are the zeros of a Legendre polynomial, found by Newton's steps from where cosines
// put them.
#include "quadrature.h"

#include "vec.h"

/// The Legendre polynomial of this degree at x, |x| < 1. Writes its derivative.
static double legendre(int degree, double x, double *slope)
{
    double before = 0.0;
    double here = 1.0;
    for (int i = 1; i <= degree; i++) {
        double next = ((2.0 * i - 1.0) * x * here - (i - 1.0) * before) / i;
        before = here;
        here = next;
    }
    *slope = degree * (before - x * here) / ((1.0 - x) * (1.0 + x));
    return here;
}

void pm_quadrature_nodes(int count, double *node, double *weight)
{
    for (int i = 0; i < count; i++) {
        double x = -cos(PM_PI * (i + 0.75) / (count + 0.5));
        double slope;
        for (int step = 0; step < 6; step++) { // three double the digits past 1e-16 already
            double value = legendre(count, x, &slope);
            x -= value / slope;
        }
        legendre(count, x, &slope);
        node[i] = 0.5 * (1.0 + x);
        weight[i] = 1.0 / ((1.0 - x) * (1.0 + x) * slope * slope);
    }
}

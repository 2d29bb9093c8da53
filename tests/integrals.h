// Integrals by adaptive quadrature: what sampling is held to where there is no closed form.
#ifndef PM_INTEGRALS_H
#define PM_INTEGRALS_H

/// Integral of `f` from `from` to `to`, which may be INFINITY, to 1e-9 of itself. May be
/// nested. Ends the running test when it does not converge.
double pm_integral(double (*f)(double x, void *context), void *context, double from, double to);

#endif

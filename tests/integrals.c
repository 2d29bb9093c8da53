// By GSL.
#include "integrals.h"

#include "test.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <math.h>

enum { PIECES = 1000 };

double pm_integral(double (*f)(double x, void *context), void *context, double from, double to)
{
    gsl_set_error_handler_off();
    gsl_integration_workspace *work = gsl_integration_workspace_alloc(PIECES);
    gsl_function integrand = {f, context};
    double sum = 0.0;
    double error;
    int status = to == HUGE_VAL ? gsl_integration_qagiu(&integrand, from, 0.0, 1e-9, PIECES,
                                                        work, &sum, &error)
                                : gsl_integration_qag(&integrand, from, to, 0.0, 1e-9, PIECES,
                                                      GSL_INTEG_GAUSS21, work, &sum, &error);
    gsl_integration_workspace_free(work);
    CHECK_THAT(status == GSL_SUCCESS, "the integral does not converge: %s",
               gsl_strerror(status));
    return sum;
}

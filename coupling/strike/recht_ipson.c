/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/strike/recht_ipson.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_fit.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* v_r^2 = c0 + c1 v0^2; false: there is no such line. */
static bool fit_squares(int n, const double *arrival, const double *residual, double *c0, double *c1)
{
    double *x = malloc(3 * (size_t)n * sizeof *x), *y = x + n, *weight = x + 2 * n, cov[3], chi2;
    bool several = false;
    if (!x) return false;
    for (int i = 0; i < n; i++) {
        x[i] = arrival[i] * arrival[i];
        y[i] = residual[i] * residual[i];
        weight[i] = 1.0 / y[i];
        several = several || x[i] != x[0];
    }
    const bool done = several && gsl_fit_wlinear(x, 1, weight, 1, y, 1, (size_t)n, c0, c1, &cov[0], &cov[1], &cov[2],
                                                 &chi2) == GSL_SUCCESS;
    free(x);
    return done && *c1 > 0.0;
}

strike_fit strike_recht_ipson(int n, const double *arrival, const double *residual)
{
    double c0, c1;
    strike_fit f = { NAN, NAN, NAN };
    if (n < 2 || !fit_squares(n, arrival, residual, &c0, &c1)) return f;
    f.factor = sqrt(c1);
    f.limit = sqrt(fmax(-c0 / c1, 0.0));
    for (int i = 0; i < n && n > 2; i++) {
        const double v2 = c0 + c1 * arrival[i] * arrival[i], off = fabs(sqrt(fmax(v2, 0.0)) / residual[i] - 1.0);
        f.error = i == 0 ? off : fmax(f.error, off);
    }
    return f;
}

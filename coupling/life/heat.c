/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/life/heat.h"

#include "base/constants.h"

#include <gsl/gsl_sf_expint.h>
#include <math.h>

static const double OUT_OF_REACH = 200.0; /* E1 of more is zero beside one */

double life_heat_flux_rise(const life_heat_metal *m, double dwell, double flux)
{
    return 2.0 * flux * sqrt(dwell / (PI * m->conductivity * m->heat_capacity));
}

life_heat life_heat_of(const life_heat_metal *m, double dwell, double flux, double sheet, double film_rise)
{
    return (life_heat){ .dwell = dwell,
                        .rise = fmin(life_heat_flux_rise(m, dwell, flux), fmax(film_rise, 0.0)),
                        .conducts = m->conductivity / m->heat_capacity,
                        .current_rise = MU0 * sheet * sheet / (PI * m->heat_capacity),
                        .diffuses = m->resistivity / MU0 };
}

/* sqrt(pi t / t_c) ierfc(z / (2 sqrt(kappa t))): at the face the rise over R that a flux has brought in t. */
static double brought(const life_heat *h, double depth, double time)
{
    if (!(time > 0.0)) return 0.0;
    const double at = depth / (2.0 * sqrt(h->conducts * time));
    return sqrt(time / h->dwell) * (exp(-at * at) - sqrt(PI) * at * erfc(at));
}

static double exposed(double depth, double diffuses, double time)
{
    const double at = depth * depth / (2.0 * diffuses * time);
    return at > OUT_OF_REACH ? 0.0 : gsl_sf_expint_E1(at);
}

double life_heat_rise(const life_heat *h, double depth, double time)
{
    const double contact = h->rise * (brought(h, depth, time) - brought(h, depth, time - h->dwell));
    if (!(time > h->dwell)) return contact;
    const double current =
        depth > 0.0 ? exposed(depth, h->diffuses, time) - exposed(depth, h->diffuses, h->dwell) : log(time / h->dwell);
    return contact + h->current_rise * current;
}

double life_heat_largest_rise(const life_heat *h, double depth, double until)
{
    enum { TIMES = 200 };
    double most = 0.0;
    for (int k = 0; k <= TIMES; k++) /* evenly in ln t from the dwell on: within the dwell the rise only grows */
        most = fmax(most, life_heat_rise(h, depth, h->dwell * pow(until / h->dwell, (double)k / TIMES)));
    return most;
}

void life_heat_strain(double rise, double expansion, double poisson, double strain[3])
{
    strain[0] = -expansion * rise;
    strain[1] = 2.0 * poisson / (1.0 - poisson) * expansion * rise;
    strain[2] = 0.0;
}

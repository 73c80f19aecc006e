/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/law/gas.h"

#include "base/constants.h"

#include <math.h>

double mpm_gas_pressure(const mpm_gas *g, double v)
{
    return GAS_CONSTANT * g->temperature / (v - g->b) - g->a / (sqrt(g->temperature) * v * (v + g->b));
}

static double slope(const mpm_gas *g, double v)
{
    const double b = g->b;
    return -GAS_CONSTANT * g->temperature / ((v - b) * (v - b)) +
           g->a * (2 * v + b) / (sqrt(g->temperature) * v * v * (v + b) * (v + b));
}

/* Where the pressure of an isotherm below the critical one has its maximum; b where it has none. */
static double turn(const mpm_gas *g)
{
    double lo = g->b, hi = g->b;
    for (double v = 1.02 * g->b; v < 1e4 * g->b; v *= 1.02)
        if (slope(g, v) > 0) lo = v, hi = 1.02 * v;
    for (int i = 0; i < 60 && lo > g->b; i++) *(slope(g, 0.5 * (lo + hi)) > 0 ? &lo : &hi) = 0.5 * (lo + hi);
    return lo;
}

mpm_gas mpm_gas_make(double temperature, double critical_temperature, double critical_pressure)
{
    const double R = GAS_CONSTANT, Tc = critical_temperature, pc = critical_pressure;
    mpm_gas g = { .temperature = temperature };
    if (isnan(Tc) || isnan(pc)) return g;
    g.a = 0.42748 * R * R * pow(Tc, 2.5) / pc, g.b = 0.08664 * R * Tc / pc;
    g.least = turn(&g);
    return g;
}

double mpm_gas_condenses(const mpm_gas *g)
{
    return g->least > g->b ? mpm_gas_pressure(g, g->least) : INFINITY;
}

/* Newton's method from above.  The pressure is convex there only far from b: a step that leaves the interval in which
 * the root lies is replaced by half of that interval.  Above the critical temperature a step may even end below b,
 * where the pressure means nothing.  An ideal gas is there at once. */
double mpm_gas_molar_volume(const mpm_gas *g, double pressure)
{
    enum { ITERATIONS = 200 };
    double v = GAS_CONSTANT * g->temperature / pressure + g->b, lo = g->least, hi = v;
    for (int i = 0; i < ITERATIONS; i++) {
        const double over = mpm_gas_pressure(g, v) - pressure, step = over / slope(g, v);
        *(over > 0 ? &lo : &hi) = v;
        v -= step;
        if (fabs(step) < 1e-15 * v) break;
        if (!(v > lo && v < hi)) v = 0.5 * (lo + hi);
    }
    return v;
}

/*   n' = C A p psi/sqrt(R T M),   psi^2 = 2 g/(g - 1) (x^(2/g) - x^((g + 1)/g)),   x = p_a/p, no less than where psi is
 *   largest: the flow is choked below */
double mpm_gas_flow(const mpm_orifice *o, double temperature, double p, double p_a)
{
    const double g = o->gamma, choked = pow(2 / (g + 1), g / (g - 1)), x = fmin(fmax(p_a / p, choked), 1);
    const double psi = sqrt(2 * g / (g - 1) * (pow(x, 2 / g) - pow(x, (g + 1) / g)));
    return o->discharge * o->area * p * psi / sqrt(GAS_CONSTANT * temperature * o->molar_mass);
}

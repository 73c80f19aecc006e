/* SPDX-License-Identifier: BSD-3-Clause */
#include "circuit/rails/rails.h"

#include <math.h>

/* Below, 1 - exp(-1/theta) is cancelled by its own leading terms: their series is used. */
static const double LONG = 30.0;

double circuit_rails_share_at_birth(double theta)
{
    const double u = theta > 0.0 ? 1.0 / theta : INFINITY;
    if (theta > LONG) return u * (1.0 / 2.0 - u * (1.0 / 6.0 - u * (1.0 / 24.0 - u / 120.0)));
    return 1.0 + theta * expm1(-u);
}

double circuit_rails_share_of_force(double theta)
{
    const double u = theta > 0.0 ? 1.0 / theta : INFINITY;
    if (theta > LONG) return 2.0 * u * (1.0 / 6.0 - u * (1.0 / 24.0 - u * (1.0 / 120.0 - u / 720.0)));
    return 1.0 - 2.0 * theta * (1.0 + theta * expm1(-u));
}

static double theta_of(const circuit_rails_load *r, int k, double rate)
{
    return rate * r->ladder.L[k] / r->ladder.R[k];
}

/* 1 over the time that a slice of rail spends where the current enters [1/s]; only a ladder with rungs asks. */
static double passing_rate(const circuit_rails_load *r, double v, double I)
{
    return r->ladder.n > 0 ? v / circuit_contact_spread(&r->contact, v, I) : 0.0;
}

double circuit_rails_force_gradient(const circuit_rails_load *r, double v, double I)
{
    const double rate = passing_rate(r, v, I);
    double L = r->ladder.L_inf;
    for (int k = 0; k < r->ladder.n; k++) L += r->ladder.L[k] * circuit_rails_share_of_force(theta_of(r, k, rate));
    return L;
}

/* So little action says nothing of a temperature yet [A^2 s m]: some microseconds of a pulse. */
static const double LEAST_ACTION = 1.0;

int circuit_rails_memory_size(const circuit_rails_load *r)
{
    return 2 * r->ladder.n + (r->heat_capacity > 0.0 ? 3 : 0);
}

void circuit_rails_memory_scale(const circuit_rails_load *r, double x, double I, double E, double *scale)
{
    static const double LONG_PULSE = 1e-3; /* [s] */
    const int n = 2 * r->ladder.n;
    for (int k = 0; k < n; k += 2) {
        scale[k] = x * I;
        scale[k + 1] = x * I * I;
    }
    if (r->heat_capacity <= 0.0) return;
    scale[n] = scale[n + 1] = E;
    scale[n + 2] = x * I * I * LONG_PULSE;
}

double circuit_rails_memory_rise(const circuit_rails_load *r, double x, const double *memory)
{
    const double *heat = memory + 2 * r->ladder.n, E = heat[0], E_c = heat[1], G = fmax(heat[2], 0.0);
    const double R_dc = r->even_resistance > 0.0 ? r->even_resistance : r->ladder.R_dc;
    if (!(x > 0.0 && R_dc > 0.0)) return 0.0;
    return E * E_c / (R_dc * r->heat_capacity * x * (G + LEAST_ACTION));
}

double circuit_rails_warming(const circuit_rails_load *r, double x, const double *memory)
{
    return r->heat_capacity > 0.0 ? 1.0 + r->coefficient * circuit_rails_memory_rise(r, x, memory) : 1.0;
}

circuit_rails_flow circuit_rails_flow_at(const circuit_rails_load *r, double x, double v, double I,
                                         const double *memory)
{
    const circuit_ladder *l = &r->ladder;
    const double warm = circuit_rails_warming(r, x, memory), R_dc = warm * l->R_dc, rate = passing_rate(r, v, I);
    circuit_rails_flow f = { .inductance = l->L_inf * x,
                             .voltage = (l->L_inf * v + R_dc * x) * I,
                             .heat = R_dc * x * I * I,
                             .field = 0.5 * l->L_inf * x * I * I };
    for (int k = 0; k < l->n; k++) {
        const double Q = memory[2 * k], W = memory[2 * k + 1], theta = theta_of(r, k, rate);
        const double a = circuit_rails_share_at_birth(theta),
                     under = a * (2.0 - a) - circuit_rails_share_of_force(theta);
        f.voltage += warm * l->R[k] * (x * I - Q) + l->L[k] * v * a * I;
        f.heat += warm * l->R[k] * (x * I * I - 2.0 * I * Q + W) + 0.5 * l->L[k] * v * under * I * I;
        f.field += 0.5 * l->L[k] * W;
    }
    return f;
}

void circuit_rails_memory_rates(const circuit_rails_load *r, double x, double v, double I, const double *memory,
                                double *rates)
{
    const int n = r->ladder.n;
    const double warm = circuit_rails_warming(r, x, memory), rate = passing_rate(r, v, I);
    for (int k = 0; k < n; k++) {
        const double Q = memory[2 * k], W = memory[2 * k + 1], frequency = warm * r->ladder.R[k] / r->ladder.L[k];
        const double born = circuit_rails_share_at_birth(theta_of(r, k, rate)) * I;
        rates[2 * k] = frequency * (x * I - Q) + v * born;
        rates[2 * k + 1] = 2.0 * frequency * (I * Q - W) + v * born * born;
    }
    if (r->heat_capacity <= 0.0) return;
    rates[2 * n] = circuit_rails_flow_at(r, x, v, I, memory).heat;
    rates[2 * n + 1] = rates[2 * n] / warm;
    rates[2 * n + 2] = x * I * I;
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Single points: halving one, merging two neighbours, and the sums of one that leaves. */
#include "mpm/memory/store.h"

#include <math.h>
#include <string.h>

/* Halves a point along axis k.  Mass, momentum and energy stay: what the kinetic energy of the gradient lacks is taken
 * from e. */
void mpm_point_halve(double *q, double *other, int k)
{
    const double d = 0.5 * q[FIRST_half + k];
    double square = 0;
    q[FIRST_half + k] = d;
    q[FIRST_mass] *= 0.5;
    q[FIRST_area] *= 0.5;
    memcpy(other, q, BLOCK_DOUBLES * sizeof *q);
    q[FIRST_x + k] -= d, other[FIRST_x + k] += d;
    q[FIRST_start + k] -= d, other[FIRST_start + k] += d;
    for (int i = 0; i < 3; i++) {
        const double dv = d * q[FIRST_L + 3 * i + k];
        square += dv * dv;
        q[FIRST_v + i] -= dv, other[FIRST_v + i] += dv;
    }
    const double ka = q[FIRST_ka], left = fmax(ka - 0.5 * square, 0);
    q[FIRST_ka] = other[FIRST_ka] = left;
    q[FIRST_e] += ka - 0.5 * square - left;
    other[FIRST_e] = q[FIRST_e];
}

static double ahead_of(const double *q, double dt)
{
    return work_ahead(q + FIRST_s, q[FIRST_p], q + FIRST_L, q[FIRST_rho], dt);
}

/* Means by mass, of stresses by volume; lengths along k add up.  The kinetic energy of the relative motion goes to
 * where mpm_point_halve takes it from.  The work ahead of the mean stress differs from that of the two: the difference
 * is heat. */
void mpm_point_merge(double *q, const double *other, int k, double dt)
{
    const double m = q[FIRST_mass] + other[FIRST_mass], share = other[FIRST_mass] / m;
    const double v0 = q[FIRST_mass] / q[FIRST_rho], v1 = other[FIRST_mass] / other[FIRST_rho];
    const double length = q[FIRST_half + k] + other[FIRST_half + k], area = q[FIRST_area] + other[FIRST_area];
    const double ahead = ahead_of(q, dt) + share * (ahead_of(other, dt) - ahead_of(q, dt));
    double square = 0;
    for (int i = 0; i < 3; i++) square += pow(other[FIRST_v + i] - q[FIRST_v + i], 2);
    for (int i = 0; i < BLOCK_DOUBLES; i++) {
        const bool stress = (i >= FIRST_s && i <= LAST_s) || i == FIRST_p;
        q[i] += (stress ? v1 / (v0 + v1) : share) * (other[i] - q[i]);
    }
    q[FIRST_ka] += 0.5 * share * (1 - share) * square;
    q[FIRST_mass] = m;
    q[FIRST_rho] = m / (v0 + v1);
    q[FIRST_half + k] = length;
    q[FIRST_area] = area;
    q[FIRST_e] += ahead_of(q, dt) - ahead;
}

void mpm_point_rescale_step(double *q, double dt, double other)
{
    q[FIRST_e] += ahead_of(q, other) - ahead_of(q, dt);
}

void mpm_point_departure(const double *q, double dt, departure *sum)
{
    const double m = q[FIRST_mass], *v = q + FIRST_v;
    sum->count++;
    sum->mass += m;
    for (int k = 0; k < 3; k++) sum->momentum[k] += m * v[k];
    sum->energy += m * (0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + q[FIRST_ka] + q[FIRST_e] - ahead_of(q, dt));
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Pressure relaxation: what heat makes of a point's pressure beyond that of its element.                     (M-7)
 *
 * A point's density follows from the velocity gradients it has met, and the nodes feel only the sum of V p over the
 * points of an element, the box between nodes, each with the part w of its domain there.  So nothing holds together the
 * pressures of points side by side.  Heated by friction, a row of points by a face came to 1.6 times the pressure on it
 * and the row behind to a third; where matter is sheared for long, points came to twice the density and a hundred times
 * the pressure around.  So of x = p - P, P the mean of its body in each element e, a point loses what its heat since
 * the start accounts for, p_w, and what lies beyond a bound b = RELAX_BOUND K, in the time that sound takes through
 * some elements, and all of the element take it up:
 *   l_e = s_e [x - max(-b, min(x, max(0, min(x - p_w, b))))],   s_e = 1 - exp(-RELAX_RATE c t/h),
 *   dV_e = w_e (l_e - <l_e>) V/K,   m de = -sum_e P_e dV_e,   P_e = <p> = sum(w V p/K)/sum(w V/K),
 * t the time since the last time.  In each element volume and energy stay.  What differs without heat stays: it is the
 * stress of a bent or a twisted element, and the front of a shock. */
#ifndef BREECH_MPM_RELAX_LANES_H
#define BREECH_MPM_RELAX_LANES_H

#include "mpm/law/law_lanes.h"

#define RELAX_BOUND 0.1 /* b/K; the front of a strong shock stays within it (test_mpm_probe: test_force) */
#define RELAX_RATE 0.3  /* one over the crossings of an element by sound in which what is lost falls by e */
#define RELAX_MOST 0.3  /* greatest |dV/V| at a time */

typedef struct {
    vd mass, volume, p, K; /* [kg, m3/kg]; pressure without viscosity, bulk modulus [Pa] */
    vd warm;               /* pressure of the heat since the start, 0 without [Pa] */
    vd least;              /* pressure that the point takes [Pa] */
    vm takes_part;         /* not a hole, and its pressure is above that: what is torn fills no element */
} relaxing;

/* Energy of the body's first temperature [J/kg] */
LANE_INLINE double start_heat(const law *k, law_form f)
{
    return k->e_start - reference_energy(k, f, vd_set(k->rho_start * k->volume0 - 1))[0];
}

LANE_INLINE relaxing relaxing_of(const law *k, law_form f, double start, const block *q, int lane)
{
    const vd zero = vd_set(0), rho = vd_load(&q->rho[0][lane]);
    relaxing r = { .mass = vd_load(&q->mass[0][lane]), .volume = 1 / rho };
    r.least = f.shear == MPM_SHEAR_NONE ? vd_set(k->strength.none.least_pressure)
                                        : vd_select(loose_points(k, q, lane), zero, vd_set(-HUGE_VAL));
    const vd mu = rho * k->volume0 - 1;
    const vd free = pressure(k, f, mu, rho, vd_load(&q->e[0][lane]), zero);
    const vd cold = start + reference_energy(k, f, mu);
    r.p = vd_max(free, r.least);
    r.warm = vd_max(free - pressure(k, f, mu, rho, cold, zero), zero);
    r.K = rho * wave_speed_square(k, f, r.volume, r.p, zero);
    r.takes_part = vd_less(zero, r.mass) & vd_less(r.least, r.p);
    return r;
}

/* Changes volumes by `change` [m3/kg], with so much `work` on what is around [J/kg].  What the last step, of dt, has
 * booked at its end, dt/2 V sigma:L, goes by the new state, as p2g.c will take it. */
LANE_INLINE void relax(const law *k, law_form f, double dt, vd change, vd work, const relaxing *of, block *q, int lane)
{
    const relaxing r = *of;
    const vd zero = vd_set(0), volume = r.volume + change;
    const vd rho = 1 / volume, mu = rho * k->volume0 - 1, booked = vd_load(&q->p[0][lane]), q_v = booked - r.p;
    vd L[9], s[6], e = vd_load(&q->e[0][lane]);
    for (int i = 0; i < 9; i++) L[i] = vd_load(&q->L[i][lane]);
    for (int i = 0; i < 6; i++) s[i] = vd_load(&q->s[i][lane]);
    const vd half = 0.5 * dt * trace(L);
    e += half * (r.volume * booked - volume * q_v) + 0.5 * dt * change * stress_power(s, L) - work;
    const vd free = pressure(k, f, mu, rho, e, half * volume), p = vd_max(free, r.least);
    e -= half * volume * p;
    vd_store(&q->rho[0][lane], vd_select(r.takes_part, rho, vd_load(&q->rho[0][lane])));
    vd_store(&q->e[0][lane], vd_select(r.takes_part, e, vd_load(&q->e[0][lane])));
    vd_store(&q->p[0][lane], vd_select(r.takes_part, p + q_v, booked));
    if (k->plastic_heat) return;
    const elastic m = elastic_of(k, f, q, lane, mu, rho);
    const vm torn =
        f.shear == MPM_SHEAR_NONE ? ~vd_less(r.least, free) : ~vd_less(vd_load(&q->damage[0][lane]), vd_set(1));
    const vd stored = 1.5 * square_norm(s) * volume * m.inv_6G;
    const vd T = temperature(k, e, vd_where(~(torn & vd_less(mu, zero)), reference_energy(k, f, mu)), stored);
    vd_store(&q->T[0][lane], vd_select(r.takes_part, T, vd_load(&q->T[0][lane])));
}

#endif

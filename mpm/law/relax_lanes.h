/* SPDX-License-Identifier: BSD-3-Clause */
/* Pressure relaxation: what a point's pressure has beyond its neighbours'.                                   (M-7)
 *
 * A point's density follows from the velocity gradients it has met, and the nodes feel only the sum of V p over the
 * points of a cell.  So nothing holds together the densities of points side by side: where matter is sheared for long
 * they drift apart, to twice the density and a hundred times the pressure around, and such points set the time step.
 * Of what lies beyond a bound b of the strain (p - P)/K from the mean P of its body in its cell, a point loses in each
 * step what sound would take through the cell, and all of them together take it up:
 *   x = (p - P)/K,   dV/V = min(1, c dt/h) (x - clamp(x, -b, b)) - S/K,   P = sum(V p/K) / sum(V/K),
 * S such that their volume stays as it was.  So does their energy, each working against P: e <- e - P dV/m. */
#ifndef BREECH_MPM_RELAX_LANES_H
#define BREECH_MPM_RELAX_LANES_H

#include "mpm/law/law_lanes.h"

/* b [1].  The front of a strong shock, over two cells or three, stays within it (test_mpm_probe: test_force). */
#define RELAX_BOUND 0.1

/* Sums over the points of a body in a cell. */
typedef struct {
    vd room, push;  /* V/K, and times p [m3/Pa, m3] */
    vd least, most; /* p [Pa] */
    vd softest;     /* K [Pa] */
    vd excess;      /* volume that those beyond the bound give [m3] */
    vd lowest;      /* dV/V of what lies beyond the bound [1] */
} relax_sums;

/* What relaxes them. */
typedef struct {
    double dt, share, P, S; /* [s, 1, Pa, Pa] */
} relaxation;

typedef struct {
    vd mass, volume, p, K; /* [kg, m3/kg]; pressure without viscosity, bulk modulus [Pa] */
    vm loose;
} relaxing;

LANE_INLINE relaxing relaxing_of(const law *k, law_form f, const block *q, int lane)
{
    const vd zero = vd_set(0), rho = vd_load(&q->rho[0][lane]);
    relaxing r = { .mass = vd_load(&q->mass[0][lane]), .volume = 1 / rho, .loose = loose_points(k, q, lane) };
    const vd free = pressure(k, f, rho * k->volume0 - 1, rho, vd_load(&q->e[0][lane]), zero);
    r.p = vd_select(r.loose, vd_max(free, zero), free);
    r.K = rho * wave_speed_square(k, f, r.volume, r.p, zero);
    return r;
}

LANE_INLINE void relax_sum(const law *k, law_form f, const block *q, int lane, relax_sums *sum)
{
    const relaxing r = relaxing_of(k, f, q, lane);
    const vm here = vd_less(vd_set(0), r.mass);
    const vd room = r.mass * r.volume / r.K;
    sum->room += room;
    sum->push += room * r.p;
    sum->least = vd_select(here, vd_min(sum->least, r.p), sum->least);
    sum->most = vd_select(here, vd_max(sum->most, r.p), sum->most);
    sum->softest = vd_select(here, vd_min(sum->softest, r.K), sum->softest);
}

/* dV/V of what lies beyond the bound. */
LANE_INLINE vd relax_excess(const relaxing *r, const relaxation *by)
{
    const vd x = (r->p - by->P) / r->K;
    return by->share * (x - vd_min(vd_max(x, vd_set(-RELAX_BOUND)), vd_set(RELAX_BOUND)));
}

LANE_INLINE void relax_give(const law *k, law_form f, const relaxation *by, const block *q, int lane, relax_sums *sum)
{
    const relaxing r = relaxing_of(k, f, q, lane);
    const vd x = vd_where(vd_less(vd_set(0), r.mass), relax_excess(&r, by));
    sum->excess += r.mass * r.volume * x;
    sum->lowest = vd_min(sum->lowest, x);
}

/* What the step has booked at its end, dt/2 V sigma:L, goes by the new state, as p2g.c will take it. */
LANE_INLINE void relax(const law *k, law_form f, const relaxation *by, block *q, int lane)
{
    const relaxing r = relaxing_of(k, f, q, lane);
    const vm here = vd_less(vd_set(0), r.mass);
    const vd zero = vd_set(0), change = (relax_excess(&r, by) - by->S / r.K) * r.volume, volume = r.volume + change;
    const vd rho = 1 / volume, mu = rho * k->volume0 - 1, booked = vd_load(&q->p[0][lane]), q_v = booked - r.p;
    vd L[9], s[6], e = vd_load(&q->e[0][lane]);
    for (int i = 0; i < 9; i++) L[i] = vd_load(&q->L[i][lane]);
    for (int i = 0; i < 6; i++) s[i] = vd_load(&q->s[i][lane]);
    const vd half = 0.5 * by->dt * trace(L);
    e += half * (r.volume * booked - volume * q_v) + 0.5 * by->dt * change * stress_power(s, L) - by->P * change;
    const vd free = pressure(k, f, mu, rho, e, half * volume), p = vd_select(r.loose, vd_max(free, zero), free);
    e -= half * volume * p;
    vd_store(&q->rho[0][lane], vd_select(here, rho, vd_load(&q->rho[0][lane])));
    vd_store(&q->e[0][lane], vd_select(here, e, vd_load(&q->e[0][lane])));
    vd_store(&q->p[0][lane], vd_select(here, p + q_v, booked));
    if (k->plastic_heat) return;
    const elastic m = elastic_of(k, f, q, lane, mu, rho);
    const vm dust = ~vd_less(vd_load(&q->damage[0][lane]), vd_set(1)) & vd_less(mu, zero);
    const vd stored = 1.5 * square_norm(s) * volume * m.inv_6G;
    const vd T = temperature(k, e, vd_where(~dust, reference_energy(k, f, mu)), stored);
    vd_store(&q->T[0][lane], vd_select(here, T, vd_load(&q->T[0][lane])));
}

#endif

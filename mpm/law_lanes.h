/* The material law of some particles of one body over one step: strength (M-1), damage (M-2), pressure (M-3), temperature
 * (M-4), viscosity (M-5).  Constants are derived in law.c; the kernels include this once an instruction set.
 * To change a law: its function here, its constants in law.h and law.c, its closed answer in tests/test_mpm_material.c. */
#ifndef BREECH_MPM_LAW_LANES_H
#define BREECH_MPM_LAW_LANES_H

#include "mpm/law.h"
#include "mpm/motion_lanes.h"
#include "mpm/store.h"

typedef struct {
    double dt, h[3]; /* cell [m] */
    double force[3]; /* body force [m/s2] */
    double traction[3];
} step_of;

/* What is booked of some particles, a lane each. */
typedef struct {
    vd heat, heat_viscous, work_external, rate, mises, clamp_p, clamp_rho;
} lane_sums;

LANE_INLINE vd clamp01(vd x)
{
    return vd_min(vd_max(x, vd_set(0)), vd_set(1));
}

/* x^n, zero at zero */
LANE_INLINE vd power(vd x, double n)
{
    const vd tiny = vd_set(1e-14), y = vd_exp(n * vd_log(vd_max(x, tiny)));
    return vd_select(vd_less(tiny, x), y, vd_set(0));
}

/*   sigma_y = (A + B e^n) (1 + C ln max(edot/edot0, 1)) (1 - T*^m)                  (M-1) [Pa]; zero when molten */
LANE_INLINE vd flow_stress(const law *k, vd e, vd log_rate, vd T_star)
{
    return (k->A + k->B * power(e, k->n)) * (1 + k->C * log_rate) * (1 - power(T_star, k->m));
}

/*   e_f = (D1 + D2 exp(D3 s*)) (1 + D4 ln e*) (1 + D5 T*)                            (M-2); s* capped at 1.5, e_f floored */
LANE_INLINE vd failure_strain(const law *k, vd triaxiality, vd log_rate, vd T_star)
{
    const vd x = vd_max(vd_min(triaxiality, vd_set(1.5)), vd_set(-5));
    const vd f = (k->D1 + k->D2 * vd_exp(k->D3 * x)) * (1 + k->D4 * log_rate) * (1 + k->D5 * T_star);
    return vd_max(f, vd_set(0.01));
}

/*   T = T_s + (e - e_s - stored)/c_v = T_r + (e - e_r - stored)/c_v, with a plateau while melting         (M-4) [K]
 * T_s, e_s on the isentrope through rest at T_r; e_r = e_s - c_v (T_s - T_r) = mu x a polynomial either side of rest (law.c) */
LANE_INLINE vd temperature(const law *k, vd e, vd mu, vd stored)
{
    const vd zero = vd_set(0), x = vd_min(vd_max(mu, vd_set(k->mu_least)), vd_set(k->mu_most));
    const vm out = vd_less(x, zero);
    vd reference = zero;
    for (int i = LAW_COLD - 1; i >= 0; i--)
        reference = vd_select(out, vd_set(k->stretched[i]), vd_set(k->squeezed[i])) + x * reference;
    const double melt = k->c_v * (k->T_m - k->T_r);
    const vd thermal = e - x * reference - stored;
    const vd beyond = vd_max(thermal - melt - k->latent, zero);
    return vd_max(k->T_r + (vd_min(thermal, vd_set(melt)) + beyond) * k->inv_c, vd_set(1));
}

/*   p_H = rho0 c0^2 mu [1 + (1 - g0/2) mu] / [1 - (s-1) mu]^2, mu >= 0;   rho0 c0^2 mu below;   p = p_H + g0 rho_e e   (M-3)
 * rho_e = rho0 in compression, rho in expansion: with rho0 there too, hot debris would keep its full thermal pressure
 * however thin it has become, and burst. */
LANE_INLINE vd hugoniot_pressure(const law *k, vd mu)
{
    const vd d = 1 - k->s1 * mu, zero = vd_set(0);
    const vd compressed = mu * (1 + (1 - 0.5 * k->g) * mu) / (d * d);
    return k->K0 * vd_select(vd_less(zero, mu), compressed, mu);
}

/* Longitudinal wave speed: K = K0 + K' p in compression, c0 in expansion; a failed point has no shear stiffness [m/s] */
LANE_INLINE vd sound_speed(const law *k, vd rho, vd p, vm failed)
{
    const vd zero = vd_set(0);
    const vd bulk = (k->K0 + k->K_slope * vd_max(p, zero)) / vd_max(rho, vd_set(k->rho0));
    return vd_sqrt(bulk + vd_select(failed, zero, 4.0 / 3.0 * k->G / rho));
}

/* Jaumann rate  s' = W s - s W + 2 G dev D */
LANE_INLINE void stress_rate(const law *k, const vd L[9], const vd s[6], vd r[6])
{
    const vd w_xy = 0.5 * (L[1] - L[3]), w_xz = 0.5 * (L[2] - L[6]), w_yz = 0.5 * (L[5] - L[7]), third = trace(L) / 3.0;
    const double G2 = 2 * k->G;
    r[0] = 2 * (w_xy * s[3] + w_xz * s[4]) + G2 * (L[0] - third);
    r[1] = 2 * (w_yz * s[5] - w_xy * s[3]) + G2 * (L[4] - third);
    r[2] = G2 * (L[8] - third) - 2 * (w_xz * s[4] + w_yz * s[5]);
    r[3] = w_xy * (s[1] - s[0]) + w_xz * s[5] + w_yz * s[4] + k->G * (L[1] + L[3]);
    r[4] = w_xz * (s[2] - s[0]) + w_xy * s[5] - w_yz * s[3] + k->G * (L[2] + L[6]);
    r[5] = w_yz * (s[2] - s[1]) - w_xy * s[4] - w_xz * s[3] + k->G * (L[5] + L[7]);
}

/* Elastic predictor by the midpoint rule */
LANE_INLINE void predict(const law *k, double dt, const vd L[9], vd s[6])
{
    vd rate[6], middle[6];
    stress_rate(k, L, s, rate);
    for (int i = 0; i < 6; i++) middle[i] = s[i] + 0.5 * dt * rate[i];
    stress_rate(k, L, middle, rate);
    for (int i = 0; i < 6; i++) s[i] += dt * rate[i];
}

LANE_INLINE vd stress_power(const vd s[6], const vd L[9])
{
    return s[0] * L[0] + s[1] * L[4] + s[2] * L[8] + s[3] * (L[1] + L[3]) + s[4] * (L[2] + L[6]) + s[5] * (L[5] + L[7]);
}

LANE_INLINE vd square_norm(const vd s[6])
{
    return s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
}

/* sqrt(2/3 dev D : dev D) [1/s] */
LANE_INLINE vd shear_rate(const vd L[9], vd tr)
{
    const vd a = L[1] + L[3], b = L[2] + L[6], c = L[5] + L[7];
    const vd D2 = L[0] * L[0] + L[4] * L[4] + L[8] * L[8] + 0.5 * (a * a + b * b + c * c) - tr * tr / 3.0;
    return vd_sqrt(2.0 / 3.0 * vd_max(D2, vd_set(0)));
}

/* (M-5)  q = rho l |tr D| (q1 c + q2 l |tr D|) in compression, l the cell's size in the direction that is compressed */
LANE_INLINE vd viscosity(const law *k, const step_of *step, const vd L[9], vd tr, vd rho, vd sound)
{
    const vd xx = L[0] * L[0], yy = L[4] * L[4], zz = L[8] * L[8];
    const double *h = step->h;
    const vd size = vd_sqrt((xx * (h[0] * h[0]) + yy * (h[1] * h[1]) + zz * (h[2] * h[2])) / (xx + yy + zz + 1e-300));
    const vd squeeze = vd_max(-tr, vd_set(0)) * size;
    return rho * squeeze * (k->q1 * sound + k->q2 * squeeze);
}

/* Stress, energy and temperature of the part of a block that begins with `lane`, over a step.  The stress power is the mean
 * of its values at the start and at the end, each with the gradient and the volume there; the pressure is solved with the
 * energy it changes, and a failed point's tension is removed before that energy. */
LANE_INLINE void law_step(const law *k, const step_of *step, const motion *move, block *q, int lane, lane_sums *sum)
{
    const vd zero = vd_set(0), one = vd_set(1);
    const vd *L = move->middle, tr = trace(L);
    const double dt = step->dt;
    const vd rho0 = vd_load(&q->rho[0][lane]), p0 = vd_load(&q->p[0][lane]), ep0 = vd_load(&q->ep[0][lane]),
             damage0 = vd_load(&q->damage[0][lane]);
    const vm failed = ~vd_less(damage0, one);
    const vd wanted = rho0 / move->growth, rho = vd_min(vd_max(wanted, vd_set(k->rho_min)), vd_set(k->rho_max));
    vd s[6];
    for (int i = 0; i < 6; i++) s[i] = vd_load(&q->s[i][lane]);

    const vd power_before = (stress_power(s, move->start) - p0 * trace(move->start)) / rho0;
    predict(k, dt, L, s);
    const vd trial = vd_sqrt(1.5 * square_norm(s));
    const vd T_star = clamp01((vd_load(&q->T[0][lane]) - k->T_r) * k->inv_T_range);
    const vd log_rate = vd_log(vd_max(shear_rate(L, tr) * k->inv_rate0, one));
    const vd yield = vd_select(failed, zero, flow_stress(k, ep0, log_rate, T_star));
    const vd mises = vd_min(trial, yield), scale = mises / vd_max(trial, vd_set(1e-30));
    const vd plastic = vd_select(failed, zero, (trial - mises) * (1 / (3 * k->G)));
    for (int i = 0; i < 6; i++) {
        s[i] *= scale;
        vd_store(&q->s[i][lane], s[i]);
    }
    const vd mu = rho * (1 / k->rho0) - 1;
    const vd sound = sound_speed(k, rho, p0, failed);
    const vd q_v = viscosity(k, step, L, tr, rho, sound);
    const vd half = 0.5 * dt * trace(move->end) / rho;
    const vd slope = k->g * vd_min(rho, vd_set(k->rho0));
    vd e =
        vd_load(&q->e[0][lane]) + sum->heat + 0.5 * dt * (power_before + stress_power(s, move->end) / rho) - half * q_v;
    const vd p_free = (hugoniot_pressure(k, mu) + slope * e) / (1 + slope * half);
    const vm torn = failed & vd_less(p_free, zero);
    const vd p = vd_select(torn, zero, p_free);
    e -= half * p;

    if (k->D1 >= 0) {
        const vd e_f = failure_strain(k, -p / (mises + 1e3), log_rate, T_star);
        vd_store(&q->damage[0][lane], vd_min(damage0 + plastic / e_f, one));
    }
    const vd stored = square_norm(s) / (4 * k->G * rho);
    const vd T = k->plastic_heat ? vd_load(&q->T[0][lane]) + k->chi * mises * plastic / rho * k->inv_c
                                 : temperature(k, e, vd_select(failed, vd_max(mu, zero), mu),
                                               stored); /* dust was stretched at no cost */
    vd_store(&q->T[0][lane], T);
    vd_store(&q->ep[0][lane], ep0 + plastic);
    vd_store(&q->flow[0][lane], yield);
    vd_store(&q->e[0][lane], e);
    vd_store(&q->rho[0][lane], rho);
    vd_store(&q->p[0][lane], p + q_v);
    vd rate = zero;
    for (int i = 0; i < 3; i++) {
        const vd v = vd_load(&q->v[i][lane]);
        rate = vd_max(rate, (sound + vd_max(v, -v)) * (1 / step->h[i]));
    }
    sum->rate = rate;
    sum->mises = mises;
    sum->heat_viscous = -dt * tr / rho * q_v;
    sum->clamp_p = vd_select(torn, one, zero);
    sum->clamp_rho = vd_select(vd_less(wanted, rho) | vd_less(rho, wanted), one, zero);
}

#endif

/* The material law of eight particles of one body over one step: strength (M-1), damage (M-2), pressure (M-3), temperature
 * (M-4), viscosity (M-5).  Constants are derived in law.c; the kernels include this once an instruction set.
 * To change a law: its function here, its constants in law.h and law.c, its closed answer in tests/test_mpm_material.c. */
#ifndef BREECH_MPM_LAW_LANES_H
#define BREECH_MPM_LAW_LANES_H

#include "mpm/law.h"
#include "mpm/store.h"

typedef struct {
    double dt, h[3]; /* cell [m] */
    double force[3]; /* body force [m/s2] */
    double traction[3];
} step_of;

/* What a block books, a lane a particle. */
typedef struct {
    v8 heat, heat_viscous, work_external, rate, mises, clamp_p, clamp_rho;
} lane_sums;

LANE_INLINE v8 clamp01(v8 x)
{
    return v8_min(v8_max(x, v8_set(0)), v8_set(1));
}

/* x^n, zero at zero */
LANE_INLINE v8 power(v8 x, double n)
{
    const v8 tiny = v8_set(1e-14), y = v8_exp(n * v8_log(v8_max(x, tiny)));
    return v8_select(v8_less(tiny, x), y, v8_set(0));
}

/*   sigma_y = (A + B e^n) (1 + C ln max(edot/edot0, 1)) (1 - T*^m)                  (M-1) [Pa]; zero when molten */
LANE_INLINE v8 flow_stress(const law *k, v8 e, v8 log_rate, v8 T_star)
{
    return (k->A + k->B * power(e, k->n)) * (1 + k->C * log_rate) * (1 - power(T_star, k->m));
}

/*   e_f = (D1 + D2 exp(D3 s*)) (1 + D4 ln e*) (1 + D5 T*)                            (M-2); s* capped at 1.5, e_f floored */
LANE_INLINE v8 failure_strain(const law *k, v8 triaxiality, v8 log_rate, v8 T_star)
{
    const v8 x = v8_max(v8_min(triaxiality, v8_set(1.5)), v8_set(-5));
    const v8 f = (k->D1 + k->D2 * v8_exp(k->D3 * x)) * (1 + k->D4 * log_rate) * (1 + k->D5 * T_star);
    return v8_max(f, v8_set(0.01));
}

/*   T = T_r + (e - e_cold - stored)/c_v, with a plateau while melting                (M-4) [K] */
LANE_INLINE v8 temperature(const law *k, v8 e, v8 mu, v8 stored)
{
    const v8 zero = v8_set(0), x = v8_max(mu, zero);
    const v8 squeezed = x * x * (k->cold[0] + x * (k->cold[1] + x * (k->cold[2] + x * (k->cold[3] + x * k->cold[4]))));
    const v8 cold = v8_select(v8_less(zero, mu), squeezed, 0.5 * k->c0 * k->c0 * mu * mu);
    const double melt = k->c_v * (k->T_m - k->T_r);
    const v8 thermal = e - cold - stored;
    const v8 beyond = v8_max(thermal - melt - k->latent, zero);
    return v8_max(k->T_r + (v8_min(thermal, v8_set(melt)) + beyond) * k->inv_c, v8_set(1));
}

/*   p_H = rho0 c0^2 mu [1 + (1 - g0/2) mu] / [1 - (s-1) mu]^2, mu >= 0;   rho0 c0^2 mu below;   p = p_H + g0 rho_e e   (M-3)
 * rho_e = rho0 in compression, rho in expansion: with rho0 there too, hot debris would keep its full thermal pressure
 * however thin it has become, and burst. */
LANE_INLINE v8 hugoniot_pressure(const law *k, v8 mu)
{
    const v8 d = 1 - k->s1 * mu, zero = v8_set(0);
    const v8 compressed = mu * (1 + (1 - 0.5 * k->g) * mu) / (d * d);
    return k->K0 * v8_select(v8_less(zero, mu), compressed, mu);
}

/* Longitudinal wave speed: K = K0 + K' p in compression, c0 in expansion; a failed point has no shear stiffness [m/s] */
LANE_INLINE v8 sound_speed(const law *k, v8 rho, v8 p, m8 failed)
{
    const v8 zero = v8_set(0);
    const v8 bulk = (k->K0 + k->K_slope * v8_max(p, zero)) / v8_max(rho, v8_set(k->rho0));
    return v8_sqrt(bulk + v8_select(failed, zero, 4.0 / 3.0 * k->G / rho));
}

/* Elastic predictor with the Jaumann rate:  s' = W s - s W + 2 G dev D  */
LANE_INLINE void predict(const law *k, double dt, const v8 L[9], v8 tr, v8 s[6])
{
    const v8 w_xy = 0.5 * (L[1] - L[3]), w_xz = 0.5 * (L[2] - L[6]), w_yz = 0.5 * (L[5] - L[7]), third = tr / 3.0;
    const v8 xx = s[0], yy = s[1], zz = s[2], xy = s[3], xz = s[4], yz = s[5];
    const double G2 = 2 * k->G;
    s[0] = xx + dt * (2 * (w_xy * xy + w_xz * xz) + G2 * (L[0] - third));
    s[1] = yy + dt * (2 * (w_yz * yz - w_xy * xy) + G2 * (L[4] - third));
    s[2] = zz + dt * (G2 * (L[8] - third) - 2 * (w_xz * xz + w_yz * yz));
    s[3] = xy + dt * (w_xy * (yy - xx) + w_xz * yz + w_yz * xz + k->G * (L[1] + L[3]));
    s[4] = xz + dt * (w_xz * (zz - xx) + w_xy * yz - w_yz * xy + k->G * (L[2] + L[6]));
    s[5] = yz + dt * (w_yz * (zz - yy) - w_xy * xz - w_xz * xy + k->G * (L[5] + L[7]));
}

LANE_INLINE v8 stress_power(const v8 s[6], const v8 L[9])
{
    return s[0] * L[0] + s[1] * L[4] + s[2] * L[8] + s[3] * (L[1] + L[3]) + s[4] * (L[2] + L[6]) + s[5] * (L[5] + L[7]);
}

LANE_INLINE v8 square_norm(const v8 s[6])
{
    return s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
}

/* sqrt(2/3 dev D : dev D) [1/s] */
LANE_INLINE v8 shear_rate(const v8 L[9], v8 tr)
{
    const v8 a = L[1] + L[3], b = L[2] + L[6], c = L[5] + L[7];
    const v8 D2 = L[0] * L[0] + L[4] * L[4] + L[8] * L[8] + 0.5 * (a * a + b * b + c * c) - tr * tr / 3.0;
    return v8_sqrt(2.0 / 3.0 * v8_max(D2, v8_set(0)));
}

/* (M-5)  q = rho l |tr D| (q1 c + q2 l |tr D|) in compression, l the cell's size in the direction that is compressed */
LANE_INLINE v8 viscosity(const law *k, const step_of *step, const v8 L[9], v8 tr, v8 rho, v8 sound)
{
    const v8 xx = L[0] * L[0], yy = L[4] * L[4], zz = L[8] * L[8];
    const double *h = step->h;
    const v8 size = v8_sqrt((xx * (h[0] * h[0]) + yy * (h[1] * h[1]) + zz * (h[2] * h[2])) / (xx + yy + zz + 1e-300));
    const v8 squeeze = v8_max(-tr, v8_set(0)) * size;
    return rho * squeeze * (k->q1 * sound + k->q2 * squeeze);
}

/* Stress, energy and temperature over a step.  The stress power is the mean of its values before and after, the
 * pressure is solved with the energy it changes, and a failed point's tension is removed before that energy. */
LANE_INLINE void law_step(const law *k, const step_of *step, const v8 L[9], v8 tr, block *q, lane_sums *sum)
{
    const v8 zero = v8_set(0), one = v8_set(1);
    const double dt = step->dt;
    const v8 rho0 = v8_load(q->rho[0]), p0 = v8_load(q->p[0]), ep0 = v8_load(q->ep[0]), damage0 = v8_load(q->damage[0]);
    const m8 failed = v8_at_least(damage0, one);
    const v8 wanted = rho0 / (1 + dt * tr), rho = v8_min(v8_max(wanted, v8_set(k->rho_min)), v8_set(k->rho_max));
    v8 s[6];
    for (int i = 0; i < 6; i++) s[i] = v8_load(q->s[i]);

    const v8 power_before = (stress_power(s, L) - p0 * tr) / rho0;
    predict(k, dt, L, tr, s);
    const v8 trial = v8_sqrt(1.5 * square_norm(s));
    const v8 T_star = clamp01((v8_load(q->T[0]) - k->T_r) * k->inv_T_range);
    const v8 log_rate = v8_log(v8_max(shear_rate(L, tr) * k->inv_rate0, one));
    const v8 yield = v8_select(failed, zero, flow_stress(k, ep0, log_rate, T_star));
    const v8 mises = v8_min(trial, yield), scale = mises / v8_max(trial, v8_set(1e-30));
    const v8 plastic = v8_select(failed, zero, (trial - mises) * (1 / (3 * k->G)));
    for (int i = 0; i < 6; i++) {
        s[i] *= scale;
        v8_store(q->s[i], s[i]);
    }
    const v8 mu = rho * (1 / k->rho0) - 1;
    const v8 sound = sound_speed(k, rho, p0, failed);
    const v8 q_v = viscosity(k, step, L, tr, rho, sound);
    const v8 half = 0.5 * dt * tr / rho;
    const v8 slope = k->g * v8_min(rho, v8_set(k->rho0));
    v8 e = v8_load(q->e[0]) + sum->heat + 0.5 * dt * (power_before + stress_power(s, L) / rho) - half * q_v;
    const v8 p_free = (hugoniot_pressure(k, mu) + slope * e) / (1 + slope * half);
    const m8 torn = m8_and(failed, v8_less(p_free, zero));
    const v8 p = v8_select(torn, zero, p_free);
    e -= half * p;

    if (k->D1 >= 0) {
        const v8 e_f = failure_strain(k, -p / (mises + 1e3), log_rate, T_star);
        v8_store(q->damage[0], v8_min(damage0 + plastic / e_f, one));
    }
    const v8 stored = square_norm(s) / (4 * k->G * rho);
    const v8 T = k->plastic_heat ? v8_load(q->T[0]) + k->chi * mises * plastic / rho * k->inv_c
                                 : temperature(k, e, v8_select(failed, v8_max(mu, zero), mu),
                                               stored); /* dust was stretched at no cost */
    v8_store(q->T[0], T);
    v8_store(q->ep[0], ep0 + plastic);
    v8_store(q->flow[0], yield);
    v8_store(q->e[0], e);
    v8_store(q->rho[0], rho);
    v8_store(q->p[0], p + q_v);
    v8 rate = zero;
    for (int i = 0; i < 3; i++) {
        const v8 v = v8_load(q->v[i]);
        rate = v8_max(rate, (sound + v8_max(v, -v)) * (1 / step->h[i]));
    }
    sum->rate = rate;
    sum->mises = mises;
    sum->heat_viscous = -dt * tr / rho * q_v;
    sum->clamp_p = v8_select(torn, one, zero);
    sum->clamp_rho = v8_select(m8_or(v8_less(wanted, rho), v8_less(rho, wanted)), one, zero);
}

#endif

/* The material law of some particles of one body over one step: the laws that its material chose, put together, with
 * temperature (M-4) and viscosity (M-5).  Constants are derived in law.c; the kernels include this once an instruction
 * set.  A block holds one body, so which law it is, is asked once for all its lanes. */
#ifndef BREECH_MPM_LAW_LANES_H
#define BREECH_MPM_LAW_LANES_H

#include "mpm/kernel/motion_lanes.h"
#include "mpm/law/law.h"
#include "mpm/memory/store.h"

typedef struct {
    double dt, h[3], inv_h[3]; /* cell [m] */
    double force[3];           /* body force [m/s2] */
    double traction[3];
} step_of;

/* What is booked of some particles, a lane each. */
typedef struct {
    vd heat, heat_viscous, work_external, rate, mises_square, clamp_p, clamp_rho;
} lane_sums;

LANE_INLINE vd clamp01(vd x)
{
    return vd_min(vd_max(x, vd_set(0)), vd_set(1));
}

/* x^n, zero at zero */
LANE_INLINE vd power(vd x, double n)
{
    const vd tiny = vd_set(1e-14);
    const vm some = vd_less(tiny, x);
    if (!vm_bits(some)) return vd_set(0);
    return vd_where(some, vd_exp(n * vd_log(vd_max(x, tiny))));
}

/* What a law of strength may look at. */
typedef struct {
    vd strain;    /* equivalent plastic strain [1] */
    vd log_rate;  /* ln(edot/edot0), at least 0 */
    vd T, T_star; /* [K]; (T - T_r)/(T_m - T_r) in 0 .. 1 */
} flow_state;

/* What a law of failure may look at. */
typedef struct {
    vd plastic;          /* what the step adds to the equivalent plastic strain [1] */
    vd triaxiality;      /* mean stress / von Mises stress, tension positive [1] */
    vd log_rate, T_star; /* as above */
} failure_state;

/* Of a law that few bodies have: a call, so that the kernel of the others stays as it is. */
#define LAW_CALL static __attribute__((noinline))

#define LAW_LANES
#include "mpm/law/eos.def"
#include "mpm/law/failure.def"
#include "mpm/law/strength.def"
#undef LAW_LANES

LANE_INLINE vd flow_stress(const law *k, vd strain, vd log_rate, vd T, vd T_star)
{
#define STRENGTH(name, shear, text)          \
    if (k->strength.kind == STRENGTH_##name) \
        return strength_##name##_flow(&k->strength.name, &(flow_state){ strain, log_rate, T, T_star });
#include "mpm/law/strength.def"
    return vd_set(0);
}

LANE_INLINE vd pressure(const law *k, vd mu, vd rho, vd e, vd half)
{
#define EOS(name, text) \
    if (k->eos.kind == EOS_##name) return eos_##name##_pressure(k, mu, rho, e, half);
#include "mpm/law/eos.def"
    return vd_set(0);
}

LANE_INLINE vd reference_energy(const law *k, vd mu)
{
#define EOS(name, text) \
    if (k->eos.kind == EOS_##name) return eos_##name##_reference(k, mu);
#include "mpm/law/eos.def"
    return vd_set(0);
}

/* The sum is the equation of state's, not made here: a compiler joins the product in it and the sum to one operation
 * only where no branch lies between. */
LANE_INLINE vd wave_speed_square(const law *k, vd volume, vd p, vd shear)
{
#define EOS(name, text) \
    if (k->eos.kind == EOS_##name) return eos_##name##_wave(k, volume, p, shear);
#include "mpm/law/eos.def"
    return shear;
}

LANE_INLINE vd damage_growth(const law *k, vd plastic, vd triaxiality, vd log_rate, vd T_star)
{
#define FAILURE(name, text)                \
    if (k->failure.kind == FAILURE_##name) \
        return failure_##name##_grow(&k->failure.name, &(failure_state){ plastic, triaxiality, log_rate, T_star });
#include "mpm/law/failure.def"
    return vd_set(0);
}

/*   T = T_s + (e - e_s - stored)/c_v = T_r + (e - e_r - stored)/c_v, with a plateau while melting         (M-4) [K] */
LANE_INLINE vd temperature(const law *k, vd e, vd reference, vd stored)
{
    const vd zero = vd_set(0);
    const double melt = k->c_v * (k->T_m - k->T_r);
    const vd thermal = e - reference - stored;
    const vd beyond = vd_max(thermal - melt - k->latent, zero);
    return vd_max(k->T_r + (vd_min(thermal, vd_set(melt)) + beyond) * k->inv_c, vd_set(1));
}

/* Longitudinal wave speed; a failed point has no shear stiffness [m/s] */
LANE_INLINE vd sound_speed(const law *k, vd volume, vd p, vm failed)
{
    return vd_sqrt(wave_speed_square(k, volume, p, vd_where(~failed, 4.0 / 3.0 * k->G * volume)));
}

/* Jaumann rate  s' = W s - s W + 2 G dev D */
LANE_INLINE void stress_rate(const law *k, const vd L[9], const vd s[6], vd r[6])
{
    const vd w_xy = 0.5 * (L[1] - L[3]), w_xz = 0.5 * (L[2] - L[6]), w_yz = 0.5 * (L[5] - L[7]);
    const vd third = (1 / 3.0) * trace(L);
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

/* 2/3 dev D : dev D, the square of the equivalent rate [1/s2] */
LANE_INLINE vd rate_square(const vd L[9], vd tr)
{
    const vd a = L[1] + L[3], b = L[2] + L[6], c = L[5] + L[7];
    const vd D2 = L[0] * L[0] + L[4] * L[4] + L[8] * L[8] + 0.5 * (a * a + b * b + c * c) - (1 / 3.0) * tr * tr;
    return 2.0 / 3.0 * D2;
}

/* (M-5)  q = rho l |tr D| (q1 c + q2 l |tr D|) in compression, l the cell's size in the direction that is compressed */
LANE_INLINE vd viscosity(const law *k, const step_of *step, const vd L[9], vd tr, vd rho, vd sound)
{
    const vd rest = vd_set(0), xx = L[0] * L[0], yy = L[4] * L[4], zz = L[8] * L[8];
    const double *h = step->h;
    if (!vm_bits(vd_less(tr, rest))) return rest;
    const vd size = vd_sqrt((xx * (h[0] * h[0]) + yy * (h[1] * h[1]) + zz * (h[2] * h[2])) / (xx + yy + zz + 1e-300));
    const vd squeeze = vd_max(-tr, rest) * size;
    return rho * squeeze * (k->q1 * sound + k->q2 * squeeze);
}

/* What plastic flow did to some particles. */
typedef struct {
    bool any;               /* did one flow or has one failed? If not, only mises_square holds something */
    vd mises_square, mises; /* von Mises stress after it, squared and plain [Pa^2, Pa] */
    vd plastic;             /* increment of the equivalent plastic strain */
    vd log_rate, T_star;    /* ln(edot/edot0) and homologous temperature */
} yielding;

/* Radial return of the trial deviator s.  Where all particles lie below the least stress at which their metal could
 * flow,
 *   sigma_y >= least (1 - T*),   least known to the law of strength, zero where it has no such bound,
 * there is nothing to do; their flow stress stays that of the step in which it was last needed, unless a contact asks.
 * (By a tenth below: where the fine zone goes is decided by what comes within a tenth of yielding, zone.c.) */
LANE_INLINE yielding radial_return(const law *k, const vd L[9], vd tr, block *q, int lane, bool contact, vd s[6])
{
    const vd zero = vd_set(0), square = 1.5 * square_norm(s);
    const vm failed = ~vd_less(vd_load(&q->damage[0][lane]), vd_set(1));
    yielding y = { .mises_square = square };
    y.T_star = clamp01((vd_load(&q->T[0][lane]) - k->T_r) * k->inv_T_range);
    const vd least = 0.9 * k->least_flow * (1 - y.T_star);
    y.any = contact || vm_bits(failed | ~vd_less(square, least * least));
    if (!y.any) return y;
    y.log_rate = 0.5 * vd_log(vd_max(rate_square(L, tr) * (k->inv_rate0 * k->inv_rate0), vd_set(1)));
    const vd ep = vd_load(&q->ep[0][lane]), trial = vd_sqrt(square);
    const vd flow = flow_stress(k, ep, y.log_rate, vd_load(&q->T[0][lane]), y.T_star);
    const vd yield = vd_where(~failed, flow);
    y.mises = vd_min(trial, yield);
    y.mises_square = y.mises * y.mises;
    y.plastic = vd_where(~failed, (trial - y.mises) * (1 / (3 * k->G)));
    vd_store(&q->flow[0][lane], yield);
    vd_store(&q->ep[0][lane], ep + y.plastic);
    const vd scale = y.mises / vd_max(trial, vd_set(1e-30));
    for (int i = 0; i < 6; i++) s[i] *= scale;
    y.any = vm_bits(vd_less(zero, y.plastic));
    return y;
}

LANE_INLINE void damage(const law *k, const yielding *y, vd p, block *q, int lane)
{
    const vd growth = damage_growth(k, y->plastic, -p / (y->mises + 1e3), y->log_rate, y->T_star);
    vd_store(&q->damage[0][lane], vd_min(vd_load(&q->damage[0][lane]) + growth, vd_set(1)));
}

/* Failed or molten: no deviator, no tension. */
LANE_INLINE vm loose_points(const law *k, const block *q, int lane)
{
    return ~(vd_less(vd_load(&q->damage[0][lane]), vd_set(1)) & vd_less(vd_load(&q->T[0][lane]), vd_set(k->T_m)));
}

/* A melt torn further apart than this share of K0 would hold has failed: were it to freeze again, it would pull with
 * what nothing had stored. */
#define LAW_MELT_TENSION 1e-4

/* Stress, energy and temperature of the part of a block that begins with `lane`, over a step.  The stress power is the
 * mean of its values at the start and at the end, each with the gradient and the volume there; the pressure is solved
 * with the energy it changes, and a loose point's tension is removed before that energy.  `contact`: the flow stress is
 * needed even where nothing flows. */
LANE_INLINE void law_step(const law *k, const step_of *step, const motion *move, block *q, int lane, bool contact,
                          lane_sums *sum)
{
    const vd zero = vd_set(0), one = vd_set(1), *L = move->middle, tr = trace(L);
    const double dt = step->dt;
    const vd p0 = vd_load(&q->p[0][lane]), volume0 = 1 / vd_load(&q->rho[0][lane]);
    const vm failed = ~vd_less(vd_load(&q->damage[0][lane]), one), loose = loose_points(k, q, lane);
    const vd wanted = volume0 * move->growth;
    const vd volume = vd_min(vd_max(wanted, vd_set(k->volume_min)), vd_set(k->volume_max)), rho = 1 / volume;
    vd s[6];
    for (int i = 0; i < 6; i++) s[i] = vd_load(&q->s[i][lane]);

    const vd mu = rho * k->volume0 - 1, reference = reference_energy(k, mu);
    const vd sound = sound_speed(k, volume, p0, failed);
    const vd q_v = viscosity(k, step, L, tr, rho, sound);
    const vd power_before = (stress_power(s, move->start) - p0 * trace(move->start)) * volume0;
    predict(k, dt, L, s);
    const yielding y = radial_return(k, L, tr, q, lane, contact, s);
    for (int i = 0; i < 6; i++) vd_store(&q->s[i][lane], s[i]);

    const vd half = 0.5 * dt * trace(move->end) * volume;
    vd e = vd_load(&q->e[0][lane]) + sum->heat + 0.5 * dt * (power_before + stress_power(s, move->end) * volume) -
           half * q_v;
    const vd p_free = pressure(k, mu, rho, e, half);
    const vm torn = loose & vd_less(p_free, zero), parted = loose & vd_less(p_free, vd_set(-LAW_MELT_TENSION * k->K0));
    const vd p = vd_select(torn, zero, p_free);
    e -= half * p;
    if (k->failure.kind != FAILURE_none && y.any) damage(k, &y, p, q, lane);
    if (vm_bits(parted & ~failed)) vd_store(&q->damage[0][lane], vd_select(parted, one, vd_load(&q->damage[0][lane])));

    const vd stored = y.mises_square * volume * (1 / (6 * k->G)); /* s:s/(4 G rho) */
    vd T = vd_load(&q->T[0][lane]);
    const vm dust = (failed | parted) & vd_less(mu, zero); /* was stretched at no cost */
    if (!k->plastic_heat)
        T = temperature(k, e, vd_where(~dust, reference), stored);
    else if (y.any)
        T += k->chi * y.mises * y.plastic * volume * k->inv_c;
    vd_store(&q->T[0][lane], T);
    vd_store(&q->e[0][lane], e);
    vd_store(&q->rho[0][lane], rho);
    vd_store(&q->p[0][lane], p + q_v);
    sum->rate = zero;
    for (int i = 0; i < 3; i++) {
        const vd v = vd_load(&q->v[i][lane]);
        sum->rate = vd_max(sum->rate, (sound + vd_max(v, -v)) * step->inv_h[i]);
    }
    sum->mises_square = y.mises_square;
    sum->heat_viscous = -dt * tr * volume * q_v;
    sum->clamp_p = vd_where(torn, one);
    sum->clamp_rho = vd_where(vd_less(wanted, volume) | vd_less(volume, wanted), one);
}

#endif

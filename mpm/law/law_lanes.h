/* SPDX-License-Identifier: BSD-3-Clause */
/* The material law of some points of one body over one step: the strength, equation of state and failure that its
 * material names, with temperature (M-4) and viscosity (M-5).  Constants are derived in law.c; the kernels include this
 * file once for every instruction set.  A block holds one body, so the law is chosen once for all its lanes; for the
 * most frequent combinations (law_form) it is chosen when the kernel is compiled. */
#ifndef BREECH_MPM_LAW_LANES_H
#define BREECH_MPM_LAW_LANES_H

#include "mpm/kernel/motion_lanes.h"
#include "mpm/law/law.h"
#include "mpm/memory/store.h"

typedef struct {
    double dt, h[3], inv_h[3]; /* cell [m] */
    double force[3];           /* body force [m/s2] */
    double traction[3];
    wave_load wave; /* of a fluid */
} step_of;

/* Sums for the ledger, a lane for each point. */
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

/* Arguments of a law of strength. */
typedef struct {
    vd strain;    /* equivalent plastic strain, a law of strength gets it with the cold work before the scene [1] */
    vd log_rate;  /* ln(edot/edot0), at least 0 */
    vd T, T_star; /* [K]; (T - T_r)/(T_m - T_r) in 0 .. 1, which is 1 of every molten point */
    vd p, rho;    /* without viscosity [Pa], [kg/m3]; only for a law whose shear VARIES */
} flow_state;

/* Arguments of a law of failure. */
typedef struct {
    vd plastic, strain;  /* what the step adds to the equivalent plastic strain, and that after it [1] */
    vd triaxiality;      /* mean stress / von Mises stress, tension positive [1] */
    vd rate_square;      /* (edot/edot0)^2 [1] */
    vd log_rate, T_star; /* as above */
} failure_state;

/* For rarely used laws: a function call, which leaves the code of the other kernels unchanged. */
#define LAW_CALL static __attribute__((noinline))

#define LAW_LANES
#include "mpm/law/eos.def"
#include "mpm/law/failure.def"
#include "mpm/law/strength.def"
#undef LAW_LANES

/* The laws of a kernel: constants at compile time where it is made for one combination, else the body's. */
typedef struct {
    int shear; /* mpm_shear_kind */
    int eos;   /* mpm_material_eos */
} law_form;

LANE_INLINE law_form law_form_of(const law *k, int kernel)
{
    if (kernel == LAW_FLUID) return (law_form){ MPM_SHEAR_NONE, k->eos.kind };
    if (kernel == LAW_METAL) return (law_form){ MPM_SHEAR_FIXED, MPM_EOS_mie_gruneisen };
    return (law_form){ k->shear, k->eos.kind };
}

LANE_INLINE vd flow_stress(const law *k, law_form f, const flow_state *s)
{
    const vd strain = s->strain + k->cold_work;
#define STRENGTH(name, shear_, text)                                              \
    if (f.shear == MPM_SHEAR_##shear_ && k->strength.kind == MPM_STRENGTH_##name) \
        return strength_##name##_flow(&k->strength.name,                          \
                                      &(flow_state){ strain, s->log_rate, s->T, s->T_star, s->p, s->rho });
#include "mpm/law/strength.def"
    return vd_set(0);
}

/* Of a law whose shear VARIES */
LANE_INLINE vd shear_modulus(const law *k, vd p, vd rho, vd T)
{
#define SHEAR_OF_NONE(name)
#define SHEAR_OF_FIXED(name)
#define SHEAR_OF_VARIES(name) \
    if (k->strength.kind == MPM_STRENGTH_##name) return strength_##name##_shear(&k->strength.name, p, rho, T);
#define STRENGTH(name, shear, text) SHEAR_OF_##shear(name)
#include "mpm/law/strength.def"
    return vd_set(k->G);
}

LANE_INLINE vd pressure(const law *k, law_form f, vd mu, vd rho, vd e, vd half)
{
#define EOS(name, text) \
    if (f.eos == MPM_EOS_##name) return eos_##name##_pressure(k, mu, rho, e, half);
#include "mpm/law/eos.def"
    return vd_set(0);
}

LANE_INLINE vd reference_energy(const law *k, law_form f, vd mu)
{
#define EOS(name, text) \
    if (f.eos == MPM_EOS_##name) return eos_##name##_reference(k, mu);
#include "mpm/law/eos.def"
    return vd_set(0);
}

/* The equation of state adds `shear` itself: the compiler contracts its last product and this sum to one operation
 * (FMA) only where no branch lies between them. */
LANE_INLINE vd wave_speed_square(const law *k, law_form f, vd volume, vd p, vd shear)
{
#define EOS(name, text) \
    if (f.eos == MPM_EOS_##name) return eos_##name##_wave(k, volume, p, shear);
#include "mpm/law/eos.def"
    return shear;
}

LANE_INLINE vd damage_growth(const law *k, const failure_state *s)
{
#define FAILURE(name, text) \
    if (k->failure.kind == MPM_FAILURE_##name) return failure_##name##_grow(&k->failure.name, s);
#include "mpm/law/failure.def"
    return vd_set(0);
}

/* T* of molten points is 1 exactly, whatever (T - T_r)/(T_m - T_r) rounds to. */
LANE_INLINE vd homologous(const law *k, vd T)
{
    return vd_select(vd_less(T, vd_set(k->T_m)), clamp01((T - k->T_r) * k->inv_T_range), vd_set(1));
}

/*   T = T_s + (e - e_s - stored)/c_v = T_r + (e - e_r - stored)/c_v, with a plateau while melting         (M-4) [K]
 * The plateau is T_m itself: T_r + c_v (T_m - T_r)/c_v may round to less, which would count as solid. */
LANE_INLINE vd temperature(const law *k, vd e, vd reference, vd stored)
{
    const vd zero = vd_set(0);
    const double melt = k->c_v * (k->T_m - k->T_r);
    const vd thermal = e - reference - stored;
    const vd beyond = vd_max(thermal - melt - k->latent, zero);
    const vd least = vd_select(vd_less(thermal, vd_set(melt)), vd_set(1), vd_set(k->T_m));
    return vd_max(k->T_r + (vd_min(thermal, vd_set(melt)) + beyond) * k->inv_c, least);
}

/* Elastic moduli: the body's, or each point's own where the law's shear VARIES. */
typedef struct {
    vd G, inv_3G, inv_6G; /* shear modulus [Pa], 1/(3 G), 1/(6 G) [1/Pa] */
    vd p, rho;            /* at which it was computed [Pa, kg/m3]; 0 where it does not vary */
} elastic;

LANE_INLINE elastic elastic_of(const law *k, law_form f, const block *q, int lane, vd mu, vd rho)
{
    const vd zero = vd_set(0);
    if (f.shear != MPM_SHEAR_VARIES)
        return (elastic){ vd_set(k->G), vd_set(1 / (3 * k->G)), vd_set(1 / (6 * k->G)), zero, zero };
    const vd p = pressure(k, f, mu, rho, vd_load(&q->e[0][lane]), zero);
    const vd G = shear_modulus(k, p, rho, vd_load(&q->T[0][lane]));
    return (elastic){ G, 1 / (3 * G), 1 / (6 * G), p, rho };
}

/* Longitudinal wave speed; a failed point has no shear stiffness [m/s] */
LANE_INLINE vd sound_speed(const law *k, law_form f, vd G, vd volume, vd p, vm failed)
{
    return vd_sqrt(wave_speed_square(k, f, volume, p, vd_where(~failed, 4.0 / 3.0 * G * volume)));
}

/* Jaumann rate  s' = W s - s W + 2 G dev D */
LANE_INLINE void stress_rate(vd G, const vd L[9], const vd s[6], vd r[6])
{
    const vd w_xy = 0.5 * (L[1] - L[3]), w_xz = 0.5 * (L[2] - L[6]), w_yz = 0.5 * (L[5] - L[7]);
    const vd third = (1 / 3.0) * trace(L), G2 = 2 * G;
    r[0] = 2 * (w_xy * s[3] + w_xz * s[4]) + G2 * (L[0] - third);
    r[1] = 2 * (w_yz * s[5] - w_xy * s[3]) + G2 * (L[4] - third);
    r[2] = G2 * (L[8] - third) - 2 * (w_xz * s[4] + w_yz * s[5]);
    r[3] = w_xy * (s[1] - s[0]) + w_xz * s[5] + w_yz * s[4] + G * (L[1] + L[3]);
    r[4] = w_xz * (s[2] - s[0]) + w_xy * s[5] - w_yz * s[3] + G * (L[2] + L[6]);
    r[5] = w_yz * (s[2] - s[1]) - w_xy * s[4] - w_xz * s[3] + G * (L[5] + L[7]);
}

/* Elastic predictor by the midpoint rule */
LANE_INLINE void predict(vd G, double dt, const vd L[9], vd s[6])
{
    vd rate[6], middle[6];
    stress_rate(G, L, s, rate);
    for (int i = 0; i < 6; i++) middle[i] = s[i] + 0.5 * dt * rate[i];
    stress_rate(G, L, middle, rate);
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

/* Result of the plastic corrector. */
typedef struct {
    bool any;               /* has any point yielded or failed? If not, only mises_square is set */
    vd mises_square, mises; /* von Mises stress after it: its square, and itself [Pa^2, Pa] */
    vd plastic;             /* increment of the equivalent plastic strain */
    vd rate_square;         /* (edot/edot0)^2 */
    vd log_rate, T_star;    /* ln(edot/edot0), at least 0, and homologous temperature */
} yielding;

/* Radial return of the trial deviator s.  The law of strength may give a lower bound of the flow stress,
 *   sigma_y >= least (1 - T*),   least = 0: no bound.
 * Where all points of the block stay a tenth below it, none can yield: the flow stress is not computed and keeps its
 * last value, unless a contact needs it.  (A tenth, because refine_plastic.c counts points within a tenth of yielding.)
 */
LANE_INLINE yielding radial_return(const law *k, law_form f, const elastic *m, const vd L[9], vd tr, block *q, int lane,
                                   bool contact, vd s[6])
{
    const vd zero = vd_set(0), square = 1.5 * square_norm(s);
    const vm failed = ~vd_less(vd_load(&q->damage[0][lane]), vd_set(1));
    yielding y = { .mises_square = square };
    y.T_star = homologous(k, vd_load(&q->T[0][lane]));
    const vd least = 0.9 * k->least_flow * (1 - y.T_star);
    y.any = contact || vm_bits(failed | ~vd_less(square, least * least));
    if (!y.any) return y;
    y.rate_square = rate_square(L, tr) * (k->inv_rate0 * k->inv_rate0);
    y.log_rate = 0.5 * vd_log(vd_max(y.rate_square, vd_set(1)));
    const vd ep = vd_load(&q->ep[0][lane]), trial = vd_sqrt(square);
    const flow_state at = { ep, y.log_rate, vd_load(&q->T[0][lane]), y.T_star, m->p, m->rho };
    vd flow = flow_stress(k, f, &at);
    if (k->softening > 0) flow *= 1 - k->softening * vd_load(&q->damage[0][lane]);
    const vd yield = vd_where(~failed, flow);
    y.mises = vd_min(trial, yield);
    y.mises_square = y.mises * y.mises;
    y.plastic = vd_where(~failed, (trial - y.mises) * m->inv_3G);
    vd_store(&q->flow[0][lane], yield);
    vd_store(&q->ep[0][lane], ep + y.plastic);
    const vd scale = y.mises / vd_max(trial, vd_set(1e-30));
    for (int i = 0; i < 6; i++) s[i] *= scale;
    y.any = vm_bits(vd_less(zero, y.plastic));
    return y;
}

LANE_INLINE void damage(const law *k, const yielding *y, vd p, block *q, int lane)
{
    const failure_state state = { .plastic = y->plastic,
                                  .strain = vd_load(&q->ep[0][lane]),
                                  .triaxiality = -p / (y->mises + 1e3),
                                  .rate_square = y->rate_square,
                                  .log_rate = y->log_rate,
                                  .T_star = y->T_star };
    const vd grown = vd_load(&q->damage[0][lane]) + damage_growth(k, &state);
    vd_store(&q->damage[0][lane], vd_min(grown, vd_set(1)));
}

/* Failed or molten points carry no deviator and no tension. */
LANE_INLINE vm loose_points(const law *k, const block *q, int lane)
{
    return ~(vd_less(vd_load(&q->damage[0][lane]), vd_set(1)) & vd_less(vd_load(&q->T[0][lane]), vd_set(k->T_m)));
}

/* A melt whose tension would exceed this fraction of K0 counts as failed.  Else it could freeze again in the stretched
 * state and pull with an energy that was never stored. */
#define LAW_MELT_TENSION 1e-4

/* State of the points at the end of the step. */
typedef struct {
    vd e, T, rho, volume, p, q_v, sound; /* q_v: viscosity [Pa] */
    vd wanted;                           /* volume that the motion gives [m3/kg] */
    vm torn;                             /* tension was removed */
} step_end;

LANE_INLINE void step_store(const step_of *step, vd tr, const step_end *r, block *q, int lane, lane_sums *sum)
{
    const vd one = vd_set(1);
    vd_store(&q->T[0][lane], r->T);
    vd_store(&q->e[0][lane], r->e);
    vd_store(&q->rho[0][lane], r->rho);
    vd_store(&q->p[0][lane], r->p + r->q_v);
    sum->rate = vd_set(0);
    for (int i = 0; i < 3; i++) {
        const vd v = vd_load(&q->v[i][lane]);
        sum->rate = vd_max(sum->rate, (r->sound + vd_max(v, -v)) * step->inv_h[i]);
    }
    sum->heat_viscous = -step->dt * tr * r->volume * r->q_v;
    sum->clamp_p = vd_where(r->torn, one);
    sum->clamp_rho = vd_where(vd_less(r->wanted, r->volume) | vd_less(r->volume, r->wanted), one);
}

/* A fluid carries pressure alone.  Where its equation of state gives less than the cavitation pressure, it cavitates:
 * further stretching does no work, and its temperature follows from its energy at the density of rest. */
LANE_INLINE void fluid_step(const law *k, law_form f, const step_of *step, const motion *move, block *q, int lane,
                            lane_sums *sum)
{
    const vd *L = move->middle, tr = trace(L), volume0 = 1 / vd_load(&q->rho[0][lane]);
    const vd p0 = vd_load(&q->p[0][lane]), least = vd_set(k->strength.none.least_pressure);
    const double dt = step->dt;
    step_end r = { .wanted = volume0 * move->growth };
    r.volume = vd_min(vd_max(r.wanted, vd_set(k->volume_min)), vd_set(k->volume_max)), r.rho = 1 / r.volume;
    const vd mu = r.rho * k->volume0 - 1, half = 0.5 * dt * trace(move->end) * r.volume;
    r.sound = vd_sqrt(wave_speed_square(k, f, r.volume, p0, vd_set(0)));
    r.q_v = viscosity(k, step, L, tr, r.rho, r.sound);
    r.e = vd_load(&q->e[0][lane]) + sum->heat - 0.5 * dt * p0 * trace(move->start) * volume0 - half * r.q_v;
    const vd p_free = pressure(k, f, mu, r.rho, r.e, half);
    r.torn = vd_less(p_free, least);
    r.p = vd_max(p_free, least);
    r.e -= half * r.p;
    r.T = temperature(k, r.e, vd_where(~(r.torn & vd_less(mu, vd_set(0))), reference_energy(k, f, mu)), vd_set(0));
    sum->mises_square = vd_set(0);
    step_store(step, tr, &r, q, lane, sum);
}

/* A solid, which may melt or fail.  The stress power is the mean of its values at the start and at the end of the step,
 * each with its own velocity gradient and volume.  Pressure and energy are solved together.  Tension of loose points,
 * and the tension at which a point spalls, is removed before the energy is computed. */
LANE_INLINE void solid_step(const law *k, law_form f, const step_of *step, const motion *move, block *q, int lane,
                            bool contact, lane_sums *sum)
{
    const vd zero = vd_set(0), one = vd_set(1), *L = move->middle, tr = trace(L);
    const double dt = step->dt;
    const vd p0 = vd_load(&q->p[0][lane]), volume0 = 1 / vd_load(&q->rho[0][lane]);
    const vm failed = ~vd_less(vd_load(&q->damage[0][lane]), one), loose = loose_points(k, q, lane);
    step_end r = { .wanted = volume0 * move->growth };
    r.volume = vd_min(vd_max(r.wanted, vd_set(k->volume_min)), vd_set(k->volume_max)), r.rho = 1 / r.volume;
    vd s[6];
    for (int i = 0; i < 6; i++) s[i] = vd_load(&q->s[i][lane]);

    const vd mu = r.rho * k->volume0 - 1, reference = reference_energy(k, f, mu);
    const elastic m = elastic_of(k, f, q, lane, mu, r.rho);
    r.sound = sound_speed(k, f, m.G, r.volume, p0, failed);
    r.q_v = viscosity(k, step, L, tr, r.rho, r.sound);
    const vd power_before = (stress_power(s, move->start) - p0 * trace(move->start)) * volume0;
    predict(m.G, dt, L, s);
    const yielding y = radial_return(k, f, &m, L, tr, q, lane, contact, s);
    for (int i = 0; i < 6; i++) vd_store(&q->s[i][lane], s[i]);

    const vd half = 0.5 * dt * trace(move->end) * r.volume;
    r.e = vd_load(&q->e[0][lane]) + sum->heat + 0.5 * dt * (power_before + stress_power(s, move->end) * r.volume) -
          half * r.q_v;
    const vd p_free = pressure(k, f, mu, r.rho, r.e, half);
    const vm spalls = vd_less(p_free, vd_set(-k->spall));
    const vm parted = (loose & vd_less(p_free, vd_set(-LAW_MELT_TENSION * k->K0))) | spalls;
    r.torn = (loose & vd_less(p_free, zero)) | spalls;
    r.p = vd_select(r.torn, zero, p_free);
    r.e -= half * r.p;
    if (k->failure.kind != MPM_FAILURE_none && y.any) damage(k, &y, r.p, q, lane);
    if (vm_bits(parted & ~failed)) vd_store(&q->damage[0][lane], vd_select(parted, one, vd_load(&q->damage[0][lane])));

    const vd stored = y.mises_square * r.volume * m.inv_6G; /* s:s/(4 G rho) */
    const vm dust = (failed | parted) & vd_less(mu, zero);  /* was stretched at no cost */
    r.T = vd_load(&q->T[0][lane]);
    if (!k->plastic_heat)
        r.T = temperature(k, r.e, vd_where(~dust, reference), stored);
    else if (y.any)
        r.T += k->chi * y.mises * y.plastic * r.volume * k->inv_c;
    sum->mises_square = y.mises_square;
    step_store(step, tr, &r, q, lane, sum);
}

/* Stress, energy and temperature of the part of a block that begins with `lane`, over a step.  `contact`: the flow
 * stress is needed even where nothing flows.  `f`: law_form_of(k, k->kernel). */
LANE_INLINE void law_step(const law *k, law_form f, const step_of *step, const motion *move, block *q, int lane,
                          bool contact, lane_sums *sum)
{
    if (f.shear == MPM_SHEAR_NONE)
        fluid_step(k, f, step, move, q, lane, sum);
    else
        solid_step(k, f, step, move, q, lane, contact, sum);
}

#endif

/* Grid to particles, and the material law: one brick, eight particles of a cell at a time.
 *
 *   v = sum S_i v_i,   L = sum v_i grad S_i,   de = sum S_i (v_i^2/2 + Q_i/m_i) - v^2/2 - ka     (transfer and contact heat)
 *   ka = 1/2 sum_k D_k |L e_k|^2,  D_k = sum S_i (x_i - x_p)_k^2                                  (TPIC's gradient part)   */
#include "mpm/kernels.h"

#include <math.h>
#include <string.h>

typedef double halo_nodes[HALO_NODES][NODE] __attribute__((aligned(64)));

static void rows(int d, int *there, int *here, int *count)
{
    *here = d < 0 ? 0 : d > 0 ? HALO - 1 : 1;
    *there = d < 0 ? BRICK - 1 : 0;
    *count = d == 0 ? BRICK : 1;
}

static void gather_halo(const mpm *m, const brick *b, halo_nodes halo)
{
    for (int step = 0; step < NEIGHBOURS; step++) {
        int t[3], h[3], n[3];
        rows(step % 3 - 1, &t[0], &h[0], &n[0]);
        rows(step / 3 % 3 - 1, &t[1], &h[1], &n[1]);
        rows(step / 9 - 1, &t[2], &h[2], &n[2]);
        const brick *from = b->neighbour[step] >= 0 ? &m->bricks[b->neighbour[step]] : NULL;
        for (int k = 0; k < n[2]; k++)
            for (int j = 0; j < n[1]; j++) {
                double(*to)[NODE] = &halo[((h[2] + k) * HALO + h[1] + j) * HALO + h[0]];
                if (from)
                    memcpy(to, from->node[cell_index(t[0], t[1] + j, t[2] + k)], (size_t)n[0] * sizeof *to);
                else
                    memset(to, 0, (size_t)n[0] * sizeof *to);
            }
    }
}

/* Ghost velocities.  A ghost gives its particles the mirror of what its node holds: the difference is the mirror's
 * impulse, with the ghost's own mass from P2G.  A ghost of several mirrors counts in the first; the others find its mass
 * where fold() has put it. */
static void mirror_ghosts(const mpm *m, brick *b, halo_nodes halo)
{
    mirror_plane plane[6];
    const int planes = mirror_planes(m, b, plane);
    for (int i = 0; i < planes; i++)
        for (int n = 0; n < HALO * HALO; n++) {
            const int k = plane[i].axis;
            int ghost[3], mirror[3];
            plane_point(k, plane[i].ghost, n, ghost);
            plane_point(k, plane[i].mirror, n, mirror);
            double *to = halo[halo_at(ghost)];
            memcpy(to, halo[halo_at(mirror)], NODE * sizeof *to);
            to[k] = -to[k];
        }
    for (int i = 0; i < planes; i++)
        for (int n = 0; n < HALO * HALO; n++) {
            const int k = plane[i].axis;
            int ghost[3];
            plane_point(k, plane[i].ghost, n, ghost);
            if (mirror_shared(plane, i, ghost)) continue;
            b->sum.impulse_boundary[k] += 2 * b->out[halo_at(ghost)][0] * halo[halo_at(ghost)][k];
        }
}

typedef struct {
    v8 v[3], L[9], E, ka;
} gathered;

LANE_INLINE v8 spread(const weights *w)
{
    return w->w[0] * w->d[0] * w->d[0] + w->w[1] * w->d[1] * w->d[1] + w->w[2] * w->d[2] * w->d[2];
}

LANE_INLINE void gather(const weights w[3], double (*const node)[NODE], gathered *r)
{
    const v8 zero = v8_set(0);
    v8 v[3] = { zero, zero, zero }, Lx[3] = { zero, zero, zero }, Ly[3] = { zero, zero, zero },
       Lz[3] = { zero, zero, zero };
    v8 E = zero;
#pragma GCC unroll 3
    for (int c = 0; c < 3; c++) {
        v8 tv[3] = { zero, zero, zero }, tx[3] = { zero, zero, zero }, ty[3] = { zero, zero, zero }, tE = zero;
#pragma GCC unroll 3
        for (int b = 0; b < 3; b++) {
            const double *n = node[(c * HALO + b) * HALO];
#pragma GCC unroll 3
            for (int q = 0; q < 3; q++) {
                const v8 s = w[0].w[0] * n[q] + w[0].w[1] * n[NODE + q] + w[0].w[2] * n[2 * NODE + q];
                const v8 d = w[0].g[0] * n[q] + w[0].g[1] * n[NODE + q] + w[0].g[2] * n[2 * NODE + q];
                tv[q] += w[1].w[b] * s;
                tx[q] += w[1].w[b] * d;
                ty[q] += w[1].g[b] * s;
            }
            tE += w[1].w[b] * (w[0].w[0] * n[3] + w[0].w[1] * n[NODE + 3] + w[0].w[2] * n[2 * NODE + 3]);
        }
#pragma GCC unroll 3
        for (int q = 0; q < 3; q++) {
            v[q] += w[2].w[c] * tv[q];
            Lx[q] += w[2].w[c] * tx[q];
            Ly[q] += w[2].w[c] * ty[q];
            Lz[q] += w[2].g[c] * tv[q];
        }
        E += w[2].w[c] * tE;
    }
    const v8 D[3] = { spread(&w[0]), spread(&w[1]), spread(&w[2]) };
    v8 ka = zero;
    for (int q = 0; q < 3; q++) {
        r->v[q] = v[q];
        r->L[3 * q] = Lx[q];
        r->L[3 * q + 1] = Ly[q];
        r->L[3 * q + 2] = Lz[q];
        ka += D[0] * Lx[q] * Lx[q] + D[1] * Ly[q] * Ly[q] + D[2] * Lz[q] * Lz[q];
    }
    r->E = E;
    r->ka = v8_set(0.5) * ka;
}

/* ---- the material law, eight lanes ---- */

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

/* ---- a block ---- */

LANE_INLINE v8 block_move(block *q, const gathered *r, const step_of *step)
{
    const v8 dt = v8_set(step->dt);
    v8 work = v8_set(0);
    const v8 area = v8_load(q->area[0]), m = v8_load(q->mass[0]);
    for (int k = 0; k < 3; k++) {
        work += (m * step->force[k] + area * step->traction[k]) * dt * v8_set(0.5) * (r->v[k] + v8_load(q->v[k]));
        v8_store(q->v[k], r->v[k]);
        v8_store(q->x[k], v8_load(q->x[k]) + dt * r->v[k]);
        const v8 grown = v8_load(q->half[k]) * (v8_set(1) + dt * r->L[4 * k]);
        v8_store(q->half[k], v8_min(v8_max(grown, v8_set(0.02 * step->h[k])), v8_set(step->h[k])));
    }
    return work;
}

/* Lanes to take out of the block: those that left the cell, that outgrew it (to be split, unless failed), that may be
 * eroded; movers.c looks at each. */
static int leaving_lanes(const mpm *m, const brick *b, int cell, int index, const cell_grid *g)
{
    const int at[3] = { cell % BRICK, cell / BRICK % BRICK, cell / (BRICK * BRICK) };
    const block *q = &m->blocks[index];
    const law *law_of = &m->laws[m->links[index].body];
    const m8 whole = v8_less(v8_load(q->damage[0]), v8_set(1));
    m8 leave = { 0 };
    for (int k = 0; k < 3; k++) {
        const double *edge = &m->axes[k].edge[BRICK * b->at[k] + at[k]];
        const v8 x = v8_load(q->x[k]), half = v8_load(q->half[k]);
        leave = m8_or(leave, m8_or(v8_less(x, v8_set(edge[0])), v8_at_least(x, v8_set(edge[1]))));
        leave = m8_or(leave, m8_and(v8_less(v8_set(0.4 * g->axis[k].cell), half), whole));
    }
    leave = m8_or(leave, v8_less(v8_set(law_of->e_vapour), v8_load(q->e[0])));
    leave = m8_or(leave, v8_less(v8_load(q->rho[0]), v8_set(law_of->rho_dust)));
    int lanes = 0;
    for (int l = 0; l < LANES; l++) lanes |= leave[l] ? 1 << l : 0;
    return lanes & m->links[index].mask;
}

static void book(brick *b, const block *q, const lane_sums *w, const step_of *step, int body, int index)
{
    tally *t = &b->sum;
    const v8 m = v8_load(q->mass[0]), zero = v8_set(0), area = v8_load(q->area[0]);
    const m8 here = v8_less(zero, m), intact = m8_and(here, v8_less(v8_load(q->damage[0]), v8_set(1)));
    t->heat_transfer += v8_sum(m * w->heat);
    t->heat_viscous += v8_sum(m * w->heat_viscous);
    t->work_external += v8_sum(w->work_external);
    for (int k = 0; k < 3; k++)
        t->impulse_external[k] += step->dt * v8_sum(m * step->force[k] + area * step->traction[k]);
    t->rate = fmax(t->rate, v8_largest(v8_select(here, w->rate, zero)));
    t->peak_pressure_body[body] =
        fmax(t->peak_pressure_body[body], v8_largest(v8_select(intact, v8_load(q->p[0]), zero)));
    t->peak_mises[body] = fmax(t->peak_mises[body], v8_largest(v8_select(here, w->mises, zero)));
    t->peak_strain[body] = fmax(t->peak_strain[body], v8_largest(v8_select(here, v8_load(q->ep[0]), zero)));
    t->peak_temperature = fmax(t->peak_temperature, v8_largest(v8_select(intact, v8_load(q->T[0]), zero)));
    t->clamps_pressure += (uint64_t)v8_sum(v8_select(here, w->clamp_p, zero));
    t->clamps_compression += (uint64_t)v8_sum(v8_select(here, w->clamp_rho, zero));
    /* x - x is 0, or NaN where x is not finite */
    v8 bad = v8_load(q->x[0]) + v8_load(q->x[1]) + v8_load(q->x[2]) + v8_load(q->e[0]) + v8_load(q->p[0]) + w->rate;
    bad = v8_select(here, bad - bad, zero);
    if (t->bad_block < 0 && !(v8_sum(bad) == 0)) {
        t->bad_block = index;
        while (bad[t->bad_lane] == 0) t->bad_lane++;
    }
}

static void one_block(mpm *m, brick *b, int index, const cell_grid *g, double (*const node)[NODE])
{
    block *q = &m->blocks[index];
    const int body = m->links[index].body;
    const double affine = m->scene.transfer == TRANSFER_TPIC ? 1 : 0;
    step_of step = { .dt = m->dt };
    for (int i = 0; i < 3; i++) {
        step.h[i] = g->axis[i].cell;
        step.force[i] = m->scene.body[body].body_force[i];
        step.traction[i] = m->scene.body[body].traction[i];
    }
    const weights w[3] = { cell_weights(g, 0, q), cell_weights(g, 1, q), cell_weights(g, 2, q) };
    gathered r;
    gather(w, node, &r);
    const m8 here = v8_less(v8_set(0), v8_load(q->mass[0])); /* holes stay at rest */
    for (int i = 0; i < 3; i++) r.v[i] = v8_select(here, r.v[i], v8_set(0));
    for (int i = 0; i < 9; i++) r.L[i] = v8_select(here, r.L[i], v8_set(0));
    r.E = v8_select(here, r.E, v8_set(0));
    r.ka = v8_select(here, r.ka * affine, v8_set(0));
    lane_sums sum;
    sum.heat = r.E - 0.5 * (r.v[0] * r.v[0] + r.v[1] * r.v[1] + r.v[2] * r.v[2]) - r.ka;
    v8_store(q->ka[0], r.ka);
    for (int i = 0; i < 9; i++) v8_store(q->L[i], r.L[i]);
    sum.work_external = block_move(q, &r, &step);
    law_step(&m->laws[body], &step, r.L, r.L[0] + r.L[4] + r.L[8], q, &sum);
    book(b, q, &sum, &step, body, index);
}

void ISA(g2p)(mpm *m, brick *b, int thread)
{
    halo_nodes halo;
    gather_halo(m, b, halo);
    mirror_ghosts(m, b, halo);
    b->movers = 0, b->mover_steps = 0, b->movers_thread = thread, b->movers_first = m->movers[thread].count;
    for (int cell = 0; cell < BRICK_CELLS; cell++) {
        if (b->head[cell] < 0) continue;
        const cell_grid g = cell_grid_at(m, b, cell);
        double(*node)[NODE] = &halo[halo_index(cell)];
        for (int i = b->head[cell]; i >= 0; i = m->links[i].next) {
            prefetch_ahead(m, i);
            b->sum.particles += (uint64_t)__builtin_popcount(m->links[i].mask);
            one_block(m, b, i, &g, node);
            const int leaving = leaving_lanes(m, b, cell, i, &g);
            if (leaving && movers_reserve(&m->movers[thread], 2 * LANES)) movers_take(m, b, cell, i, leaving, thread);
        }
    }
}

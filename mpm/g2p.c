/* Grid to particles, and the material law: one brick, eight particles of a cell at a time.
 *
 *   v = sum S_i v_i,   L = sum v_i grad S_i,   de = sum S_i (v_i^2/2 + Q_i/m_i) - v^2/2 - ka     (transfer and contact heat)
 *   ka = 1/2 sum_k D_k |L e_k|^2,  D_k = sum S_i (x_i - x_p)_k^2                                  (TPIC's gradient part)   */
#include "mpm/kernels.h"
#include "mpm/law_lanes.h"

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

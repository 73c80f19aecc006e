/* SPDX-License-Identifier: BSD-3-Clause */
/* Grid to points, and the material law: one brick, the points of a cell a part of a block at a time.
 *
 *   v = sum S_i v_i,   L = sum v_i grad S_i,   de = sum S_i (v_i^2/2 + Q_i/m_i) - v^2/2 - ka - b (transfer and contact
 *   heat; b: heat_beyond)
 *   ka = 1/2 sum_k D_k |L e_k|^2,  D_k = sum S_i (x_i - x_p)_k^2                                  (TPIC's gradient
 *   part)   */
#include "mpm/kernel/kernels.h"
#include "mpm/law/law_lanes.h"

#include <math.h>
#include <string.h>

typedef double halo_nodes[HALO_NODES][NODE] __attribute__((aligned(64)));

/* The velocities of 6 x 6 x 6 nodes, row by row along x: one node of the brick before, four of its own or of one beside
 * it, one of the brick after; zero where there is none. */
static void gather_halo(const mpm *m, const brick *b, halo_nodes halo)
{
    static double none[BRICK_CELLS][NODE]; /* zero */
    for (int z = 0; z < HALO; z++)
        for (int y = 0; y < HALO; y++) {
            const int *there = &b->neighbour[3 * (HALO_SIDE(y) + 3 * HALO_SIDE(z))];
            double(*to)[NODE] = &halo[(z * HALO + y) * HALO], (*from[3])[NODE];
            const int row = cell_index(0, (y + BRICK - 1) % BRICK, (z + BRICK - 1) % BRICK);
            for (int i = 0; i < 3; i++) from[i] = (there[i] >= 0 ? m->nodes[there[i]] : none) + row;
            memcpy(to[0], from[0][BRICK - 1], sizeof *to);
            memcpy(to[1], from[1], BRICK * sizeof *to);
            memcpy(to[HALO - 1], from[2], sizeof *to);
        }
}

/* Ghost velocities.  A ghost gives its points the mirror of what its node holds: the difference is the mirror's
 * impulse, with the ghost's own mass from P2G.  A ghost of several mirrors counts in the first; the others find its
 * mass where fold() has put it. */
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
            b->sum.impulse_boundary[k] += 2 * b->out[halo_place[halo_at(ghost)]][0] * halo[halo_at(ghost)][k];
        }
}

/* ---- a cell's 27 nodes ---- */

/* Weights sum to one, their gradients to zero, so along an axis
 *   sum w f = f_1 + w_0 (f_0 - f_1) + w_2 (f_2 - f_1),   sum g f = g_0 (f_0 - f_1) + g_2 (f_2 - f_1):
 * the nodes of a cell, with such differences in the places of the first and the last along each axis. */
typedef double node_values __attribute__((vector_size(8 * NODE)));
typedef node_values cell_nodes[27];

LANE_INLINE void difference(node_values *first, const node_values *middle, node_values *last)
{
    *first -= *middle;
    *last -= *middle;
}

static void gather_cell(const halo_nodes halo, int first, cell_nodes n)
{
#pragma GCC unroll 27
    for (int i = 0; i < 27; i++)
        n[i] = *(const node_values *)(const void *)halo[first + (i / 9 * HALO + i / 3 % 3) * HALO + i % 3];
#pragma GCC unroll 9
    for (int i = 0; i < 9; i++) difference(&n[3 * i], &n[3 * i + 1], &n[3 * i + 2]);
#pragma GCC unroll 9
    for (int i = 0; i < 9; i++) {
        node_values *row = &n[9 * (i / 3) + i % 3];
        difference(row, row + 3, row + 6);
    }
#pragma GCC unroll 9
    for (int i = 0; i < 9; i++) difference(&n[i], &n[9 + i], &n[18 + i]);
}

typedef struct {
    vd v[3], L[9], E, ka;
} gathered;

/* f + w_0 first + w_2 last */
LANE_INLINE vd along(const vd f[3], const vd w[3])
{
    return f[1] + w[0] * f[0] + w[2] * f[2];
}

LANE_INLINE vd slope(const vd f[3], const vd g[3])
{
    return g[0] * f[0] + g[2] * f[2];
}

/* sum S f and, where `grad` is asked for, sum f grad S, of number q of the nodes. */
LANE_INLINE vd interpolate(const weights w[3], const cell_nodes n, int q, vd grad[3])
{
    vd plane[3], plane_x[3], plane_y[3];
#pragma GCC unroll 3
    for (int c = 0; c < 3; c++) {
        vd row[3], row_x[3];
#pragma GCC unroll 3
        for (int b = 0; b < 3; b++) {
            const double *f = (const double *)&n[9 * c + 3 * b] + q;
            row[b] = f[NODE] + w[0].w[0] * f[0] + w[0].w[2] * f[2 * NODE];
            if (grad) row_x[b] = w[0].g[0] * f[0] + w[0].g[2] * f[2 * NODE];
        }
        plane[c] = along(row, w[1].w);
        if (grad) plane_x[c] = along(row_x, w[1].w), plane_y[c] = slope(row, w[1].g);
    }
    if (grad) {
        grad[0] = along(plane_x, w[2].w);
        grad[1] = along(plane_y, w[2].w);
        grad[2] = slope(plane, w[2].g);
    }
    return along(plane, w[2].w);
}

/* D = sum w (x_i - x_p)^2 */
LANE_INLINE vd spread(const weights *w)
{
    return w->w[0] * w->d[0] * w->d[0] + w->w[1] * w->d[1] * w->d[1] + w->w[2] * w->d[2] * w->d[2];
}

LANE_INLINE void gather(const weights w[3], const cell_nodes n, gathered *r, ahead *next)
{
    for (int q = 0; q < 3; q++) {
        prefetch_share(next);
        r->v[q] = interpolate(w, n, q, &r->L[3 * q]);
    }
    r->E = interpolate(w, n, 3, NULL);
    r->ka = vd_set(0);
    for (int k = 0; k < 3; k++) {
        const vd x = r->L[k], y = r->L[3 + k], z = r->L[6 + k];
        r->ka += 0.5 * spread(&w[k]) * (x * x + y * y + z * z);
    }
}

/* Of the faces that a load acts on, across axis k. */
LANE_INLINE void face_velocity(const weights w[3], weights across, int k, const cell_nodes n, vd v[3])
{
    weights at[3] = { w[0], w[1], w[2] };
    at[k] = across;
    for (int q = 0; q < 3; q++) v[q] = interpolate(at, n, q, NULL);
}

/* ---- the part of a block that begins with `lane` ---- */

/* Holes stay at rest. */
LANE_INLINE void leave_holes(gathered *r, vm here)
{
    for (int i = 0; i < 3; i++) r->v[i] = vd_where(here, r->v[i]);
    for (int i = 0; i < 9; i++) r->L[i] = vd_where(here, r->L[i]);
    r->E = vd_where(here, r->E);
    r->ka = vd_where(here, r->ka);
}

/* A fluid, failed or molten point has nothing that resists its gradient: lone debris that is drawn out steepens it
 * without bound (F^-1, motion_lanes.h), and what that motion needs came out of its heat, far below none.  So such a
 * point's gradient part holds no more than the mixing has left, `budget` [J/kg].  Returns the factor on the gradient
 * that this leaves. */
LANE_INLINE vd bound_gradient(const law *k, law_form f, const block *q, int lane, vd budget, vd *ka)
{
    const vm large = vd_less(budget, *ka), over = f.shear == MPM_SHEAR_NONE ? large : loose_points(k, q, lane) & large;
    if (!vm_bits(over)) return vd_set(1);
    const vd wanted = *ka, kept = vd_select(over, vd_max(budget, vd_set(0)), wanted);
    *ka = kept;
    return vd_sqrt(vd_select(over, kept / vd_max(wanted, vd_set(1e-300)), vd_set(1)));
}

/* Moves and stretches; the work of the loads, those on a face at its velocity. */
LANE_INLINE vd move(block *q, int lane, const gathered *r, const vd face[3], const step_of *step)
{
    const vd area = vd_load(&q->area[0][lane]), m = vd_load(&q->mass[0][lane]);
    vd work = vd_set(0);
    for (int k = 0; k < 3; k++) {
        double *v = &q->v[k][lane], *x = &q->x[k][lane], *half = &q->half[k][lane];
        work += (0.5 * step->dt) *
                (m * step->force[k] * (r->v[k] + vd_load(v)) + area * step->traction[k] * (face[k] + vd_load(v)));
        vd_store(v, r->v[k]);
        vd_store(x, vd_load(x) + step->dt * r->v[k]);
        const vd grown = vd_load(half) * (1 + step->dt * r->L[4 * k]);
        vd_store(half, vd_min(vd_max(grown, vd_set(0.02 * step->h[k])), vd_set(step->h[k])));
    }
    return work;
}

/* ---- what is booked ---- */

/* Sums over the blocks of one body, a lane each until they are added to the brick's tally. */
typedef struct {
    vd heat_transfer, heat_viscous, work_external, mass, area, push;
    vd rate, pressure, mises_square, strain, temperature, clamp_p, clamp_rho;
} books;

LANE_INLINE void book(books *t, const block *q, int lane, const lane_sums *w)
{
    const vd m = vd_load(&q->mass[0][lane]);
    const vm here = vd_less(vd_set(0), m), intact = here & vd_less(vd_load(&q->damage[0][lane]), vd_set(1));
    t->heat_transfer += m * w->heat;
    t->heat_viscous += m * w->heat_viscous;
    t->work_external += w->work_external;
    t->mass += m;
    t->area += vd_load(&q->area[0][lane]);
    t->rate = vd_max(t->rate, vd_where(here, w->rate));
    t->pressure = vd_max(t->pressure, vd_where(intact, vd_load(&q->p[0][lane])));
    t->mises_square = vd_max(t->mises_square, vd_where(here, w->mises_square));
    t->strain = vd_max(t->strain, vd_where(here, vd_load(&q->ep[0][lane])));
    t->temperature = vd_max(t->temperature, vd_where(intact, vd_load(&q->T[0][lane])));
    t->clamp_p += vd_where(here, w->clamp_p);
    t->clamp_rho += vd_where(here, w->clamp_rho);
}

/* Before the points move: their velocity at the step's start is that which p2g.c took. */
LANE_INLINE vd work_of_wave(const block *q, int lane, const vd face[3], const step_of *step, books *t)
{
    const wave_load *w = &step->wave;
    const vd v = vd_load(&q->v[w->axis][lane]), push = vd_load(&q->area[0][lane]) * wave_push(w, v);
    t->push += push;
    return push * (0.5 * step->dt) * (face[w->axis] + v);
}

/* A run of blocks of one body, in a cell: what their kernels need to know, and what is booked of them. */
typedef struct {
    int body;
    bool near; /* may other groups' points give to nodes of this cell, as points of its level do? */
    step_of step;
    books books;
} block_run;

/* `peaks`: of the run's body. */
static void add_books(tally *t, const block_run *run, body_peaks *peaks)
{
    const books *s = &run->books;
    const step_of *step = &run->step;
    t->heat_transfer += vd_sum(s->heat_transfer);
    t->heat_viscous += vd_sum(s->heat_viscous);
    t->work_external += vd_sum(s->work_external);
    for (int k = 0; k < 3; k++)
        t->impulse_external[k] += step->dt * (step->force[k] * vd_sum(s->mass) + step->traction[k] * vd_sum(s->area));
    if (step->wave.on) t->impulse_external[step->wave.axis] += step->dt * vd_sum(s->push);
    t->rate = fmax(t->rate, vd_largest(s->rate));
    peaks->pressure = fmax(peaks->pressure, vd_largest(s->pressure));
    peaks->mises = fmax(peaks->mises, sqrt(vd_largest(s->mises_square)));
    peaks->strain = fmax(peaks->strain, vd_largest(s->strain));
    t->peak_temperature = fmax(t->peak_temperature, vd_largest(s->temperature));
    t->clamps_pressure += (uint64_t)vd_sum(s->clamp_p);
    t->clamps_compression += (uint64_t)vd_sum(s->clamp_rho);
}

/* Notes the first point that is not finite: x - x is 0, or NaN. */
LANE_INLINE void find_bad(tally *t, const block *q, int lane, vd rate, int index)
{
    const vm here = vd_less(vd_set(0), vd_load(&q->mass[0][lane]));
    vd sum = rate + vd_load(&q->e[0][lane]) + vd_load(&q->p[0][lane]);
    for (int k = 0; k < 3; k++) sum += vd_load(&q->x[k][lane]);
    const int bad = vm_bits(here & (sum - sum != 0));
    if (!bad || t->bad_block >= 0) return;
    t->bad_block = index;
    t->bad_lane = lane + __builtin_ctz((unsigned)bad);
}

/* ---- a block ---- */

/* Lanes to take out of the part: those that left the cell, that outgrew it (to be split, unless failed), that may be
 * eroded; movers.c looks at each. */
typedef struct {
    double lo[3], hi[3], longest[3]; /* edges of the cell, half length of a domain to be split [m] */
    double node[3];                  /* between the cell's octants [m] */
    unsigned foreign;                /* brick.foreign */
} cell_limits;

/* Points in octants that another level has. */
LANE_INLINE vm in_foreign_octant(const cell_limits *c, const block *q, int lane)
{
    vm upper[3], in = vd_set(0) != vd_set(0);
    for (int k = 0; k < 3; k++) upper[k] = vd_load(&q->x[k][lane]) >= c->node[k];
    for (unsigned left = c->foreign; left; left &= left - 1) {
        const int o = __builtin_ctz(left);
        vm here = o & 1 ? upper[0] : ~upper[0];
        here &= o & 2 ? upper[1] : ~upper[1];
        here &= o & 4 ? upper[2] : ~upper[2];
        in |= here;
    }
    return in;
}

LANE_INLINE int leaving_lanes(const block *q, int lane, const cell_limits *c, const law *k)
{
    const vm whole = vd_less(vd_load(&q->damage[0][lane]), vd_set(1));
    vm leave = vd_less(vd_load(&q->rho[0][lane]), vd_set(k->rho_dust));
    for (int i = 0; i < 3; i++) {
        const vd x = vd_load(&q->x[i][lane]), half = vd_load(&q->half[i][lane]);
        leave |= (x < c->lo[i]) | (x >= c->hi[i]) | (whole & (half > c->longest[i]));
    }
    if (c->foreign) leave |= in_foreign_octant(c, q, lane);
    return vm_bits(leave) << lane;
}

static cell_limits limits_of(const mpm *m, const brick *b, int cell)
{
    const int at[3] = { cell % BRICK, cell / BRICK % BRICK, cell / (BRICK * BRICK) };
    cell_limits c = { .foreign = b->foreign[cell] };
    for (int k = 0; k < 3; k++) {
        const axis *a = &axes_of(m, b)[k];
        const double *edge = &a->edge[BRICK * b->at[k] + at[k]];
        c.lo[k] = edge[0], c.hi[k] = edge[1], c.node[k] = a->node[BRICK * b->at[k] + at[k]];
        c.longest[k] = 0.5 * a->longest[BRICK * b->at[k] + at[k]];
    }
    return c;
}

/* Of a body, without the cell's sizes. */
static step_of step_for(const mpm *m, const brick *b, int body)
{
    step_of step = { .dt = level_dt(m, b->level) };
    for (int i = 0; i < 3; i++) {
        step.force[i] = m->scene.body[body].body_force[i];
        step.traction[i] = m->scene.body[body].traction[i];
    }
    step.wave = m->load[b->level * m->scene.bodies + body];
    return step;
}

static void set_cell(step_of *step, const cell_grid *g)
{
    for (int i = 0; i < 3; i++) step->h[i] = g->axis[i]->cell, step->inv_h[i] = g->axis[i]->inv_cell;
}

/* Advances a block by a step; the lanes that leave it.  `kernel`: that of the body's law, a constant where this is
 * called, so that the compiler makes a kernel of each. */
LANE_INLINE int one_block(mpm *m, brick *b, int index, const cell_grid *g, const cell_limits *limits,
                          const cell_nodes nodes, block_run *run, int kernel)
{
    block *q = &m->blocks[index];
    const law *k = &m->laws[run->body];
    const law_form f = law_form_of(k, kernel);
    int leaving = 0;
    const mpm_body *of = &m->scene.body[run->body];
    const bool loaded = has_face_load(of, &run->step.wave);
    double least[3];
    least_domain(m, b, g, run->body, least);
    ahead next = ahead_of(m, index, FIRST_start, 1 + 5 * LANES / WIDTH);
    prefetch_share(&next);
    for (int lane = 0; lane < LANES; lane += WIDTH) {
        if (part_is_empty(m->links[index].mask, lane)) continue;
        const weights w[3] = { cell_weights(g, least, 0, q, lane), cell_weights(g, least, 1, q, lane),
                               cell_weights(g, least, 2, q, lane) };
        gathered r;
        lane_sums sum;
        gather(w, nodes, &r, &next);
        if (m->scene.transfer != MPM_TRANSFER_TPIC) r.ka = vd_set(0);
        leave_holes(&r, vd_less(vd_set(0), vd_load(&q->mass[0][lane])));
        const vd budget = r.E - 0.5 * (r.v[0] * r.v[0] + r.v[1] * r.v[1] + r.v[2] * r.v[2]) - heat_beyond(k, q, lane);
        const vd share = bound_gradient(k, f, q, lane, budget, &r.ka);
        sum.heat = budget - r.ka;
        vd_store(&q->ka[0][lane], r.ka);
        motion moved = motion_of(r.L, run->step.dt);
        for (int i = 0; i < 9; i++) {
            moved.end[i] *= share;
            vd_store(&q->L[i][lane], moved.end[i]);
        }
        prefetch_share(&next);
        const bool wave = kernel == LAW_FLUID && run->step.wave.on;
        vd face[3] = { r.v[0], r.v[1], r.v[2] };
        if (loaded)
            face_velocity(w, face_weights(g, least, of->traction_face, q, lane, &w[of->traction_face / 2]),
                          of->traction_face / 2, nodes, face);
        const vd work = wave ? work_of_wave(q, lane, face, &run->step, &run->books) : vd_set(0);
        sum.work_external = move(q, lane, &r, face, &run->step);
        if (wave) sum.work_external += work;
        law_step(k, f, &run->step, &moved, q, lane, run->near, &sum);
        prefetch_share(&next);
        book(&run->books, q, lane, &sum);
        find_bad(&b->sum, q, lane, sum.rate, index);
        leaving |= leaving_lanes(q, lane, limits, k);
    }
    return leaving & m->links[index].mask;
}

#define BLOCK_KERNEL(name, kernel)                                                                               \
    static __attribute__((noinline)) int name(mpm *m, brick *b, int index, const cell_grid *g,                   \
                                              const cell_limits *limits, const cell_nodes nodes, block_run *run) \
    {                                                                                                            \
        return one_block(m, b, index, g, limits, nodes, run, kernel);                                            \
    }
BLOCK_KERNEL(fluid_block, LAW_FLUID)
BLOCK_KERNEL(metal_block, LAW_METAL)
BLOCK_KERNEL(solid_block, LAW_SOLID)

typedef int block_kernel(mpm *, brick *, int, const cell_grid *, const cell_limits *, const cell_nodes, block_run *);
static block_kernel *const block_kernels[LAW_KERNELS] = { fluid_block, metal_block, solid_block };

static void one_cell(mpm *m, brick *b, int cell, const brick_grid *grid, const halo_nodes halo, block_run *run)
{
    cell_grid g;
    cell_grid_set(&g, grid, b, cell);
    const cell_limits limits = limits_of(m, b, cell);
    mover_list *movers = &m->movers[b->movers_thread];
    cell_nodes nodes;
    gather_cell(halo, halo_index(cell), nodes);
    set_cell(&run->step, &g);
    for (int i = b->head[cell]; i >= 0; i = m->links[i].next) {
        const int body = m->links[i].body;
        if (body != run->body) {
            add_books(&b->sum, run, &peaks_of_thread(m, b->movers_thread)[run->body]);
            *run = (block_run){ .body = body, .near = run->near, .step = step_for(m, b, body) };
            set_cell(&run->step, &g);
        }
        b->sum.particles += (uint64_t)__builtin_popcount(m->links[i].mask);
        const int leaving = block_kernels[m->laws[body].kernel](m, b, i, &g, &limits, nodes, run);
        if (!leaving) continue;
        if (mpm_movers_reserve(movers, 2 * LANES))
            mpm_movers_take(m, b, cell, i, leaving);
        else
            b->sum.stranded = true;
    }
}

/* ---- sleep ----
 *
 * Points whose nodes have been slow for two steps are laid to rest and left as they are: without motion the law gives
 * them the same stress again, and they give their nodes the same again (p2g.c).  They wake when one of these nodes is
 * no longer slow.  The head of a wave in the numbers goes on by a cell a step and grows manifold with each, so it is
 * slow for some steps; what points do not take in each of them is less than SLOW m c of momentum and SLOW m c^2 of
 * energy, a rounding error of what sends the wave.  Points at a mirror stay awake, for it books their impulse with
 * every step, and so do those of a group that a force acts on from outside. */

static const double SLOW = 1e-14; /* of the velocity of sound */

static bool nodes_are_slow(const mpm *m, const brick *b, const halo_nodes halo)
{
    const law *k = group_law(m, b->group);
    const double c2 = k->K0 / k->rho0, limit = SLOW * sqrt(c2);
    for (int n = 0; n < HALO_NODES; n++) {
        const double *v = halo[n];
        if (!(b->out[halo_place[n]][0] > 0)) continue;
        if (fabs(v[0]) > limit || fabs(v[1]) > limit || fabs(v[2]) > limit || fabs(v[3]) > SLOW * c2) return false;
    }
    return true;
}

static bool is_at_mirror(const mpm *m, const brick *b)
{
    mirror_plane plane[6];
    return mirror_planes(m, b, plane) > 0;
}

/* Does the brick hold a part of a face? */
static bool has_face(const mpm *m, const brick *b)
{
    for (int cell = 0; cell < BRICK_CELLS; cell++)
        for (int i = b->head[cell]; i >= 0; i = m->links[i].next)
            for (int l = 0; l < LANES; l++)
                if (m->blocks[i].area[0][l] > 0) return true;
    return false;
}

/* Does a force act on the group from outside, or a wave on the brick?  However small, it adds up. */
static bool is_loaded(const mpm *m, const brick *b)
{
    for (int i = 0; i < m->scene.bodies; i++) {
        const mpm_body *of = &m->scene.body[i];
        if (of->group != b->group) continue;
        for (int k = 0; k < 3; k++)
            if (of->body_force[k] != 0 || of->traction[k] != 0) return true;
        if (mpm_wave_is_wanted(of) && has_face(m, b)) return true;
    }
    return false;
}

static void lay_to_rest(mpm *m, const brick *b)
{
    for (int cell = 0; cell < BRICK_CELLS; cell++)
        for (int i = b->head[cell]; i >= 0; i = m->links[i].next) {
            block *q = &m->blocks[i];
            memset(q->v, 0, sizeof q->v), memset(q->L, 0, sizeof q->L), memset(q->ka, 0, sizeof q->ka);
        }
}

void ISA(g2p)(mpm *m, brick *b, int thread)
{
    const brick_grid grid = brick_grid_at(m, b);
    halo_nodes halo;
    gather_halo(m, b, halo);
    mirror_ghosts(m, b, halo);
    b->movers = 0, b->mover_steps = 0, b->movers_thread = thread, b->movers_first = m->movers[thread].count;
    const bool slow = nodes_are_slow(m, b, halo);
    if (slow && b->still == BRICK_ASLEEP) {
        b->sum.asleep = (uint64_t)b->particles, b->sum.rate = b->still_rate;
        return;
    }
    b->still = slow && !is_at_mirror(m, b) && !is_loaded(m, b) ? b->still + 1 : 0;
    b->given = false;
    block_run run = { .body = 0, .step = step_for(m, b, 0) };
    const uint64_t near = !b->contact ? 0 : b->across ? mpm_contact_cells(m, b) : b->meets;
    for (int cell = 0; cell < BRICK_CELLS; cell++) {
        if (b->head[cell] < 0) continue;
        run.near = near >> cell & 1;
        one_cell(m, b, cell, &grid, halo, &run);
    }
    add_books(&b->sum, &run, &peaks_of_thread(m, thread)[run.body]);
    b->sum.rate /= level_steps(m, b->level);
    b->still_rate = b->sum.rate;
    if (b->still == BRICK_ASLEEP) lay_to_rest(m, b);
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Points to grid: the node sums of one brick.
 *
 *   line_i = sum_p S_ip { m, m [v + L (x_i - x_p)], m [v^2/2 + ka + b + v . L (x_i - x_p)] },
 *   f_i = -sum_p V sigma grad S_ip,   b: heat_beyond
 *
 * and, with the energy, the other side of the work that the forces do before they change the nodes (nodes.c takes
 * dt/2 f_i . v_i from it): what they would do if the nodes moved as the points do, dt/2 sum_p f_ip . [v + L (x_i -
 * x_p)]. Its sum is what the points have booked at the end of the last step, dt/2 V sigma:L, so the two together are
 * the work that the transfer's smoothing takes or makes.  Of L only the parts along the axes are told apart by node:
 * those across sum to zero.
 *
 * With S = wx wy wz every term is a product over the axes, so a point's line at node (a, b, c) is
 *   wy_b wz_c A_a + wx_a B_bc,   A_a = wx_a base + qx_a CX,   B_bc = wz_c Y_b + wy_b Z_c,   Y_b = qy_b CY,   Z_c = qz_c
 *   CZ,
 * where q is w (x_i - x_p) in the lanes of momentum and energy and grad w in the lanes of force.
 *
 * Weights sum to one, the q to zero: instead of the middle one of an axis' three nodes the sum of all three is
 * accumulated, with w = 1 and q = 0, and the middle is what the other two leave of it.  That is a fifth less work. */
#include "mpm/kernel/kernels.h"
#include "mpm/memory/cavities.h"

#include <math.h>
#include <string.h>

enum { PARTS = (int)LINE / (int)WIDTH }; /* of a node line */

/* A part of the lines of nodes (a, b, c): place 9 c + 3 b + a; place 1 along an axis: of all three. */
typedef vd part_sums[27];

/* What a block's rows of three nodes along x are made of, [first or last node][point][lane of the line]. */
typedef struct {
    double base[LANES][LINE], A[2][LANES][LINE], Y[2][LANES][LINE], Z[2][LANES][LINE];
} __attribute__((aligned(64))) lines;

/* A block's factors, [axis][first or last node][point]. */
typedef struct {
    double w[3][2][LANES];  /* weight */
    double yz[2][2][LANES]; /* weights' product, [z][y] */
} __attribute__((aligned(64))) factors;

/* What a block gives to contact lines: V grad w, [axis][first or last node][point]; V; m flow stress; m effusivity, in
 * a group whose bodies differ in that. */
typedef struct {
    double gradient[3][2][LANES], volume[LANES], flow[LANES], heat[LANES];
} __attribute__((aligned(64))) contact_factors;

LANE_INLINE void store_factors(factors *f, const weights w[3], int lane)
{
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 2; a++) vd_store(&f->w[k][a][lane], w[k].w[2 * a]);
    for (int c = 0; c < 2; c++)
        for (int b = 0; b < 2; b++) vd_store(&f->yz[c][b][lane], w[1].w[2 * b] * w[2].w[2 * c]);
}

/* Rows (a line's lane each) of some points -> lines of those points. */
LANE_INLINE void store_lines(double (*to)[LINE], const vd row[LINE], int lane)
{
    for (int part = 0; part < PARTS; part++) {
        vd r[WIDTH];
        for (int i = 0; i < WIDTH; i++) r[i] = row[part * WIDTH + i];
        vd_transpose(r);
        for (int i = 0; i < WIDTH; i++) vd_store(&to[lane + i][part * WIDTH], r[i]);
    }
}

/* Lanes of a contact line, all bits set: V grad S along each axis, V, m flow stress, m effusivity. */
static const struct {
    int64_t gradient[3][LINE], volume[LINE], flow[LINE], heat[LINE];
} contact_kinds __attribute__((aligned(64))) = {
    { { -1 }, { 0, -1 }, { 0, 0, -1 } }, { 0, 0, 0, -1 }, { 0, 0, 0, 0, 0, 0, -1 }, { 0, 0, 0, 0, 0, 0, 0, -1 }
};

LANE_INLINE vm kind_at(const int64_t *kind, int part)
{
    return *(const vm *)(const void *)&kind[part];
}

/* Three nodes along x: sum += yz A + wx B */
LANE_INLINE void add_row(vd sum[3], const lines *n, int part, const factors *f, int l, double yz, vd B)
{
    sum[0] += yz * vd_load(&n->A[0][l][part]);
    sum[1] += yz * vd_load(&n->base[l][part]);
    sum[2] += yz * vd_load(&n->A[1][l][part]);
    sum[0] += f->w[0][0][l] * B;
    sum[1] += B;
    sum[2] += f->w[0][1][l] * B;
}

/* The nine nodes of all planes together. */
LANE_INLINE void add_whole(vd sum[9], const lines *n, int part, const factors *f, int l)
{
    sum[3] += vd_load(&n->A[0][l][part]);
    sum[4] += vd_load(&n->base[l][part]);
    sum[5] += vd_load(&n->A[1][l][part]);
    for (int b = 0; b < 2; b++) add_row(&sum[6 * b], n, part, f, l, f->w[1][b][l], vd_load(&n->Y[b][l][part]));
}

/* The nine nodes of the first or the last plane across z. */
LANE_INLINE void add_plane(vd sum[9], const lines *n, int part, const factors *f, int l, int c)
{
    const double wz = f->w[2][c][l];
    const vd Z = vd_load(&n->Z[c][l][part]);
    add_row(&sum[3], n, part, f, l, wz, Z);
    for (int b = 0; b < 2; b++)
        add_row(&sum[6 * b], n, part, f, l, f->yz[c][b][l], wz * vd_load(&n->Y[b][l][part]) + f->w[1][b][l] * Z);
}

/* Nine nodes of the points in `mask`, a part of their lines.  Nine sums at a time: they stay in registers. */
LANE_INLINE void accumulate_plane(vd to[9], const lines *n, int part, const factors *f, int mask, int plane, bool first)
{
    vd sum[9];
#pragma GCC unroll 9
    for (int i = 0; i < 9; i++) sum[i] = first ? vd_set(0) : to[i];
    for (int left = mask; left; left &= left - 1) {
        const int l = __builtin_ctz((unsigned)left);
        if (plane == 1)
            add_whole(sum, n, part, f, l);
        else
            add_plane(sum, n, part, f, l, plane / 2);
    }
#pragma GCC unroll 9
    for (int i = 0; i < 9; i++) to[i] = sum[i];
}

/* Adds a part of the lines of the points in `mask`. */
LANE_INLINE void accumulate(part_sums sum, const lines *n, int part, const factors *f, int mask, bool first,
                            ahead *next)
{
#pragma GCC unroll 3
    for (int plane = 0; plane < 3; plane++) {
        prefetch_share(next);
        accumulate_plane(&sum[9 * plane], n, part, f, mask, plane, first);
    }
}

/* Half the time steps that the work before the forces is a share of: of this step, and of the last [s]. */
typedef struct {
    double now, last;
} half_steps;

/* Apart from the other loads, so that those are computed as they are without a wave, to the last bit. */
LANE_INLINE void add_wave(const wave_load *w, vd area, const vd v[3], double half_step, vd base[LINE])
{
    const vd push = area * wave_push(w, v[w->axis]);
    base[4 + w->axis] += push;
    base[7] += half_step * push * v[w->axis];
}

/* Force on the points' faces, and its power at their velocity. */
LANE_INLINE void face_load(const mpm_body *body, const wave_load *wave, vd area, const vd v[3], vd load[3], vd *power)
{
    for (int i = 0; i < 3; i++) load[i] = area * body->traction[i];
    if (wave->on) load[wave->axis] += area * wave_push(wave, v[wave->axis]);
    *power = load[0] * v[0] + load[1] * v[1] + load[2] * v[2];
}

/* lanes: 0 m, 1-3 momentum, 4-6 force, 7 energy; `face`: weights of the load on a face, NULL without one */
LANE_INLINE void motion_lines(const block *q, int lane, const law *material, double affine, const mpm_body *body,
                              const wave_load *wave, half_steps dt, const weights w[3], const weights *face, lines *n)
{
    static const int column[3][3] = { { 0, 3, 4 }, { 3, 1, 5 }, { 4, 5, 2 } };
#define AT(field) vd_load(&q->field[lane])
    const vd m = AT(mass[0]), v[3] = { AT(v[0]), AT(v[1]), AT(v[2]) }, V = m / AT(rho[0]), mL = m * affine;
    const vd square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2], area = AT(area[0]);
    vd base[LINE] = { m, m * v[0], m * v[1], m * v[2] }, s[6] /* -V sigma */, load[3], stretch[3];
    for (int i = 0; i < 6; i++) s[i] = V * (i < 3 ? AT(p[0]) - AT(s[i]) : -AT(s[i]));
    base[7] = m * (0.5 * square + AT(ka[0]) + heat_beyond(material, q, lane));
    for (int i = 0; i < 3; i++) {
        const int *c = column[i];
        load[i] = m * body->body_force[i] + area * body->traction[i];
        stretch[i] = dt.last * (s[c[0]] * AT(L[i]) + s[c[1]] * AT(L[3 + i]) + s[c[2]] * AT(L[6 + i]));
        base[4 + i] = load[i];
        base[7] += dt.now * load[i] * v[i] + stretch[i];
    }
    if (wave->on) add_wave(wave, area, v, dt.now, base);
    store_lines(n->base, base, lane);
    vd on_face[3], power;
    if (face) face_load(body, wave, area, v, on_face, &power);
    for (int k = 0; k < 3; k++) {
        const int *c = column[k];
        const vd push = dt.now * (s[c[0]] * v[0] + s[c[1]] * v[1] + s[c[2]] * v[2]);
        vd turn[3], swing = vd_set(0);
        for (int i = 0; i < 3; i++) {
            turn[i] = mL * AT(L[3 * i + k]);
            swing += v[i] * turn[i];
        }
        for (int a = 0; a < 2; a++) {
            const vd weight = w[k].w[2 * a], grad = w[k].g[2 * a], d = w[k].d[2 * a], moment = weight * d;
            vd row[LINE] = { vd_set(0) };
            for (int i = 0; i < 3; i++) row[1 + i] = moment * turn[i], row[4 + i] = grad * s[c[i]];
            row[7] = moment * swing + grad * push + (grad * d - weight) * stretch[k];
            if (face && k == body->traction_face / 2) {
                const vd more = face->w[2 * a] - weight;
                for (int i = 0; i < 3; i++) row[4 + i] += more * on_face[i];
                row[7] += more * dt.now * power;
            }
            for (int i = 0; i < LINE && k == 0; i++) row[i] += weight * base[i];
            store_lines(k == 0 ? n->A[a] : k == 1 ? n->Y[a] : n->Z[a], row, lane);
        }
    }
}

LANE_INLINE void surface_of(const block *q, int lane, const weights w[3], contact_factors *n)
{
    const vd m = AT(mass[0]), V = m / AT(rho[0]);
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 2; a++) vd_store(&n->gradient[k][a][lane], V * w[k].g[2 * a]);
    vd_store(&n->volume[lane], V);
    vd_store(&n->flow[lane], m * AT(flow[0]));
#undef AT
}

/* A part of point l's contact lines: each lane is one number, so nothing need be transposed. */
LANE_INLINE void contact_lines(const contact_factors *s, const factors *f, int part, int l, bool mixed, lines *n)
{
    vd base = vd_where(kind_at(contact_kinds.flow, part), vd_set(s->flow[l]));
    base = vd_select(kind_at(contact_kinds.volume, part), vd_set(s->volume[l]), base);
    if (mixed) base = vd_select(kind_at(contact_kinds.heat, part), vd_set(s->heat[l]), base);
    vd_store(&n->base[l][part], base);
    for (int a = 0; a < 2; a++) {
        vd q[3];
        for (int k = 0; k < 3; k++)
            q[k] = vd_where(kind_at(contact_kinds.gradient[k], part), vd_set(s->gradient[k][a][l]));
        vd_store(&n->A[a][l][part], f->w[0][a][l] * base + q[0]);
        vd_store(&n->Y[a][l][part], q[1]);
        vd_store(&n->Z[a][l][part], q[2]);
    }
}

/* The middle of three is what the others leave of the sum that is in its place. */
LANE_INLINE void leave_middles(part_sums s)
{
#pragma GCC unroll 9
    for (int i = 0; i < 9; i++) s[3 * i + 1] -= s[3 * i] + s[3 * i + 2];
#pragma GCC unroll 9
    for (int i = 0; i < 9; i++) s[9 * (i / 3) + i % 3 + 3] -= s[9 * (i / 3) + i % 3] + s[9 * (i / 3) + i % 3 + 6];
#pragma GCC unroll 9
    for (int i = 0; i < 9; i++) s[9 + i] -= s[i] + s[18 + i];
}

LANE_INLINE void add_to_brick(double (*out)[LINE], int first, part_sums sum[PARTS])
{
#pragma GCC unroll 4
    for (int part = 0; part < PARTS; part++) {
        leave_middles(sum[part]);
#pragma GCC unroll 27
        for (int i = 0; i < 27; i++) {
            double *line = &out[halo_place[first + (i / 9 * HALO + i / 3 % 3) * HALO + i % 3]][part * WIDTH];
            vd_store(line, vd_load(line) + sum[part][i]);
        }
    }
}

/* What the kernel of a cell's blocks needs to know beside them. */
typedef struct {
    const cell_grid *grid;
    half_steps dt;
    double affine; /* 1, or 0 without the affine part */
    bool meets;    /* are contact lines wanted? */
    bool mixed;    /* group_info.mixed */
    int level;
} cell_work;

/* A block's lines into the sums of its cell, which begin with its `first`.  A call, not inlined: gcc then takes the
 * sums as begun. */
static __attribute__((noinline)) void one_block(const mpm *m, const brick *b, int index, const cell_work *c, bool first,
                                                part_sums momentum[PARTS], part_sums contact[PARTS])
{
    const block *q = &m->blocks[index];
    const int mask = m->links[index].mask;
    const mpm_body *body = &m->scene.body[m->links[index].body];
    const wave_load *wave = &m->load[c->level * m->scene.bodies + m->links[index].body];
    const cell_grid *g = c->grid;
    lines n;
    factors f;
    contact_factors s;
    ahead next = ahead_of(m, index, FIRST_ep, 1 + 3 * PARTS), none = { 0 };
    double least[3];
    least_domain(m, b, g, m->links[index].body, least);
    prefetch_share(&next);
    for (int lane = 0; lane < LANES; lane += WIDTH) {
        if (part_is_empty(mask, lane)) continue;
        const weights w[3] = { cell_weights(g, least, 0, q, lane), cell_weights(g, least, 1, q, lane),
                               cell_weights(g, least, 2, q, lane) };
        store_factors(&f, w, lane);
        const bool loaded = has_face_load(body, wave);
        weights face;
        if (loaded) face = face_weights(g, least, body->traction_face, q, lane, &w[body->traction_face / 2]);
        motion_lines(q, lane, &m->laws[m->links[index].body], c->affine, body, wave, c->dt, w, loaded ? &face : NULL,
                     &n);
        if (c->meets) surface_of(q, lane, w, &s);
        if (c->meets && c->mixed)
            vd_store(&s.heat[lane], vd_load(&q->mass[0][lane]) * m->effusivity[m->links[index].body]);
    }
#pragma GCC unroll 4
    for (int part = 0; part < PARTS; part++) {
        accumulate(momentum[part], &n, part * WIDTH, &f, mask, first, &next);
        if (!c->meets) continue;
        lines on_surface;
        for (int left = mask; left; left &= left - 1)
            contact_lines(&s, &f, part * WIDTH, __builtin_ctz((unsigned)left), c->mixed, &on_surface);
        accumulate(contact[part], &on_surface, part * WIDTH, &f, mask, first, &none);
    }
}

static void one_cell(const mpm *m, brick *b, int cell, const cell_work *c)
{
    part_sums momentum[PARTS], contact[PARTS];
    for (int i = b->head[cell]; i >= 0; i = m->links[i].next)
        one_block(m, b, i, c, i == b->head[cell], momentum, contact);
    add_to_brick(b->out, halo_index(cell), momentum);
    if (c->meets) add_to_brick(b->out_contact, halo_index(cell), contact);
}

/* Adds a ghost's line, mirrored across axis k, to the node it mirrors; the momentum that turns is the mirror's impulse.
 */
static void fold_line(brick *b, int k, const int ghost[3], const int mirror[3], double dt)
{
    const int source = halo_place[halo_at(ghost)], target = halo_place[halo_at(mirror)];
    const double *from = b->out[source];
    double *to = b->out[target];
    for (int i = 0; i < LINE; i++) to[i] += i == 1 + k || i == 4 + k ? -from[i] : from[i];
    b->sum.impulse_boundary[k] -= 2 * (from[1 + k] + dt * from[4 + k]);
    if (!b->meets) return;
    const double *surface = b->out_contact[source];
    for (int i = 0; i < LINE; i++) b->out_contact[target][i] += i == k ? -surface[i] : surface[i];
}

static void fold(const mpm *m, brick *b)
{
    mirror_plane plane[6];
    const int planes = mirror_planes(m, b, plane);
    for (int i = 0; i < planes; i++)
        for (int n = 0; n < HALO * HALO; n++) {
            int ghost[3], mirror[3];
            plane_point(plane[i].axis, plane[i].ghost, n, ghost);
            plane_point(plane[i].axis, plane[i].mirror, n, mirror);
            if (!mirror_shared(plane, i, ghost)) fold_line(b, plane[i].axis, ghost, mirror, level_dt(m, b->level));
        }
}

/* The next of the powers of 2^(1/16): a brick at rest need not give to its nodes anew with every change of the step. */
static inline double steady(double dt)
{
    return exp2(ceil(16 * log2(dt)) / 16);
}

/* What lies beyond a mirror is what lies before it. */
static inline void find_open_sides(const mpm *m, const brick *b, uint64_t open[3][2])
{
    for (int k = 0; k < 3; k++) mpm_cells_open(m, b, k, open[k]);
    mirror_plane p[6];
    for (int i = mirror_planes(m, b, p) - 1; i >= 0; i--) {
        const int k = p[i].axis, beyond = p[i].ghost > p[i].mirror;
        const uint64_t at = mpm_cells_of_layer(k, (p[i].ghost + p[i].mirror) / 2 - 1);
        open[k][beyond] = (open[k][beyond] & ~at) | (open[k][!beyond] & at);
    }
}

void ISA(p2g)(mpm *m, brick *b)
{
    const uint64_t meets = (b->across    ? ~0ull
                            : b->contact ? mpm_contact_cells(m, b)
                                         : 0) |
                           (m->cavities ? cavity_cells(m->cavities, b) : 0) |
                           (m->arrivals ? mpm_arrival_cells(m, b) : 0);
    uint64_t open[3][2];
    find_open_sides(m, b, open);
    const double steady_dt = steady(level_dt(m, b->level));
    const bool as_before = b->given && b->still == BRICK_ASLEEP && meets == b->meets && steady_dt == b->steady_dt &&
                           memcmp(open, b->open, sizeof open) == 0;
    memset(&b->sum, 0, sizeof b->sum);
    b->sum.bad_block = -1;
    if (as_before) return;
    memset(b->out, 0, HALO_NODES * sizeof *b->out);
    b->meets = meets, b->given = true;
    memcpy(b->open, open, sizeof open);
    b->steady_dt = steady_dt;
    if (b->meets) memset(b->out_contact, 0, HALO_NODES * sizeof *b->out_contact);
    const brick_grid grid = brick_grid_at(m, b);
    cell_grid at;
    cell_work work = { .grid = &at,
                       .dt = { 0.5 * level_dt(m, b->level), 0.5 * level_dt_last(m, b->level) },
                       .affine = m->scene.transfer == MPM_TRANSFER_TPIC ? 1 : 0,
                       .mixed = m->group[b->group].mixed,
                       .level = b->level };
    for (int cell = 0; cell < BRICK_CELLS; cell++) {
        if (b->head[cell] < 0) continue;
        cell_grid_set(&at, &grid, b, cell);
        work.meets = b->meets >> cell & 1;
        one_cell(m, b, cell, &work);
    }
    fold(m, b);
}

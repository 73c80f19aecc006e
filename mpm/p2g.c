/* Particles to grid: the node sums of one brick.
 *
 *   line_i = sum_p S_ip { m, m [v + L (x_i - x_p)], m [v^2/2 + ka + v . L (x_i - x_p)] },   f_i = -sum_p V sigma grad S_ip
 *
 * A node line is one vector of eight; the 27 lines of a cell stay in registers over all its particles.  With
 * S = wx wy wz every term is a product over the axes, so a particle's line at node (a, b, c) is
 *   wy_b wz_c A_a + wx_a B_bc,   A_a = wx_a base + kx_a CX,   B_bc = wz_c ky_b CY + wy_b kz_c CZ,
 * where k is w (x_i - x_p) in the lanes of momentum and energy and grad w in the lanes of force. */
#include "mpm/kernels.h"

#include <string.h>

typedef struct {
    v8 base[LANES], CX[LANES], CY[LANES], CZ[LANES]; /* a particle each: its line's parts */
} lines;

typedef struct {
    double w[3][3][LANES], g[3][3][LANES], wd[3][3][LANES]; /* axis, node, particle */
    double yz[9][LANES];
} factors;

LANE_INLINE void store_factors(factors *f, const weights w[3])
{
    for (int k = 0; k < 3; k++)
        for (int a = 0; a < 3; a++) {
            v8_store(f->w[k][a], w[k].w[a]);
            v8_store(f->g[k][a], w[k].g[a]);
            v8_store(f->wd[k][a], w[k].w[a] * w[k].d[a]);
        }
    for (int c = 0; c < 3; c++)
        for (int b = 0; b < 3; b++) v8_store(f->yz[3 * c + b], w[1].w[b] * w[2].w[c]);
}

/* Adds the lines of the particles in `mask` to the 27 sums.  `gradient`: the lanes that go with grad w. */
LANE_INLINE void accumulate(v8 sum[27], const lines *n, const factors *f, m8 gradient, int mask)
{
    for (; mask; mask &= mask - 1) {
        const int l = __builtin_ctz((unsigned)mask);
        v8 A[3], Y[3], Z[3];
        for (int a = 0; a < 3; a++) {
            A[a] = f->w[0][a][l] * n->base[l] +
                   v8_select(gradient, v8_set(f->g[0][a][l]), v8_set(f->wd[0][a][l])) * n->CX[l];
            Y[a] = v8_select(gradient, v8_set(f->g[1][a][l]), v8_set(f->wd[1][a][l])) * n->CY[l];
            Z[a] = v8_select(gradient, v8_set(f->g[2][a][l]), v8_set(f->wd[2][a][l])) * n->CZ[l];
        }
#pragma GCC unroll 3
        for (int c = 0; c < 3; c++)
#pragma GCC unroll 3
            for (int b = 0; b < 3; b++) {
                const v8 B = f->w[2][c][l] * Y[b] + f->w[1][b][l] * Z[c];
                const double yz = f->yz[3 * c + b][l];
#pragma GCC unroll 3
                for (int a = 0; a < 3; a++) {
                    sum[9 * c + 3 * b + a] += yz * A[a];
                    sum[9 * c + 3 * b + a] += f->w[0][a][l] * B;
                }
            }
    }
}

/* lanes: 0 m, 1-3 momentum, 4-6 force, 7 energy */
LANE_INLINE void motion_lines(const block *q, v8 affine, const mpm_body *body, lines *n)
{
    const double *load = body->traction, *pull = body->body_force;
    const v8 area = v8_load(q->area[0]);
    const v8 zero = v8_set(0), m = v8_load(q->mass[0]), v0 = v8_load(q->v[0]), v1 = v8_load(q->v[1]),
             v2 = v8_load(q->v[2]);
    const v8 V = m / v8_load(q->rho[0]), p = v8_load(q->p[0]);
    v8 s[6], L[9], mL = m * affine;
    for (int i = 0; i < 6; i++) s[i] = V * ((i < 3 ? p : zero) - v8_load(q->s[i])); /* -V sigma */
    for (int i = 0; i < 9; i++) L[i] = mL * v8_load(q->L[i]);
    const v8 square = v0 * v0 + v1 * v1 + v2 * v2;
    const v8 base[8] = { m,
                         m * v0,
                         m * v1,
                         m * v2,
                         m * pull[0] + area * load[0],
                         m * pull[1] + area * load[1],
                         m * pull[2] + area * load[2],
                         m * (0.5 * square + v8_load(q->ka[0])) };
    static const int column[3][3] = { { 0, 3, 4 }, { 3, 1, 5 }, { 4, 5, 2 } };
    memcpy(n->base, base, sizeof base);
    v8 *C[3] = { n->CX, n->CY, n->CZ };
    for (int k = 0; k < 3; k++) {
        const v8 part[8] = { zero,
                             L[k],
                             L[3 + k],
                             L[6 + k],
                             s[column[k][0]],
                             s[column[k][1]],
                             s[column[k][2]],
                             v0 * L[k] + v1 * L[3 + k] + v2 * L[6 + k] };
        memcpy(C[k], part, sizeof part);
        v8_transpose(C[k]);
    }
    v8_transpose(n->base);
}

/* lanes: 0-2 V grad S, 3-5 m (x_p - x_i), 6 m flow stress */
LANE_INLINE void contact_lines(const block *q, lines *n)
{
    const v8 zero = v8_set(0), m = v8_load(q->mass[0]), V = m / v8_load(q->rho[0]);
    memset(n->base, 0, sizeof n->base);
    n->base[6] = m * v8_load(q->flow[0]);
    v8_transpose(n->base);
    v8 *C[3] = { n->CX, n->CY, n->CZ };
    for (int k = 0; k < 3; k++) {
        const v8 part[8] = { k == 0 ? V : zero,
                             k == 1 ? V : zero,
                             k == 2 ? V : zero,
                             k == 0 ? -m : zero,
                             k == 1 ? -m : zero,
                             k == 2 ? -m : zero,
                             zero,
                             zero };
        memcpy(C[k], part, sizeof part);
        v8_transpose(C[k]);
    }
}

LANE_INLINE void add_to_brick(double (*out)[LINE], int first, const v8 sum[27])
{
    for (int c = 0; c < 3; c++)
        for (int b = 0; b < 3; b++)
            for (int a = 0; a < 3; a++) {
                double *line = out[first + (c * HALO + b) * HALO + a];
                v8_store(line, v8_load(line) + sum[9 * c + 3 * b + a]);
            }
}

static void cell_motion(const mpm *m, brick *b, int cell, const cell_grid *g)
{
    static const m8 force = { 0, 0, 0, 0, -1, -1, -1, 0 };
    const v8 affine = v8_set(m->scene.transfer == TRANSFER_TPIC ? 1 : 0);
    v8 sum[27];
    for (int i = 0; i < 27; i++) sum[i] = v8_set(0);
    for (int i = b->head[cell]; i >= 0; i = m->links[i].next) {
        const block *q = &m->blocks[i];
        prefetch_ahead(m, i);
        lines n;
        factors f;
        const weights w[3] = { cell_weights(g, 0, q), cell_weights(g, 1, q), cell_weights(g, 2, q) };
        store_factors(&f, w);
        motion_lines(q, affine, &m->scene.body[m->links[i].body], &n);
        accumulate(sum, &n, &f, force, m->links[i].mask);
    }
    add_to_brick(b->out, halo_index(cell), sum);
}

static void cell_contact(const mpm *m, brick *b, int cell, const cell_grid *g)
{
    static const m8 volume = { -1, -1, -1, 0, 0, 0, 0, 0 };
    v8 sum[27];
    for (int i = 0; i < 27; i++) sum[i] = v8_set(0);
    for (int i = b->head[cell]; i >= 0; i = m->links[i].next) {
        const block *q = &m->blocks[i];
        lines n;
        factors f;
        const weights w[3] = { cell_weights(g, 0, q), cell_weights(g, 1, q), cell_weights(g, 2, q) };
        store_factors(&f, w);
        contact_lines(q, &n);
        accumulate(sum, &n, &f, volume, m->links[i].mask);
    }
    add_to_brick(b->out_contact, halo_index(cell), sum);
}

/* Adds a ghost's line, mirrored across axis k, to the node it mirrors; the momentum that turns is the mirror's impulse. */
static void fold_line(brick *b, int k, const int ghost[3], const int mirror[3], double dt)
{
    const double *from = b->out[halo_at(ghost)];
    double *to = b->out[halo_at(mirror)];
    for (int i = 0; i < LINE; i++) to[i] += i == 1 + k || i == 4 + k ? -from[i] : from[i];
    b->sum.impulse_boundary[k] -= 2 * (from[1 + k] + dt * from[4 + k]);
    if (!b->contact) return;
    const double *surface = b->out_contact[halo_at(ghost)];
    for (int i = 0; i < 7; i++) b->out_contact[halo_at(mirror)][i] += i == k || i == 3 + k ? -surface[i] : surface[i];
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
            if (!mirror_shared(plane, i, ghost)) fold_line(b, plane[i].axis, ghost, mirror, m->dt);
        }
}

void ISA(p2g)(mpm *m, brick *b)
{
    memset(&b->sum, 0, sizeof b->sum);
    b->sum.bad_block = -1;
    memset(b->out, 0, HALO_NODES * sizeof *b->out);
    if (b->contact) memset(b->out_contact, 0, HALO_NODES * sizeof *b->out_contact);
    for (int cell = 0; cell < BRICK_CELLS; cell++) {
        if (b->head[cell] < 0) continue;
        const cell_grid g = cell_grid_at(m, b, cell);
        cell_motion(m, b, cell, &g);
        if (b->contact) cell_contact(m, b, cell, &g);
    }
    fold(m, b);
}

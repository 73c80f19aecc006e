/* SPDX-License-Identifier: BSD-3-Clause */
/* Shared by the files that are compiled once an instruction set: ISA(name) gives each its own symbol. */
#ifndef BREECH_MPM_KERNELS_H
#define BREECH_MPM_KERNELS_H

#include "mpm/law/law_lanes.h"
#include "mpm/memory/store.h"

#ifndef BREECH_ISA
#define BREECH_ISA portable
#endif
#define ISA_JOIN2(name, isa) mpm_##name##_##isa
#define ISA_JOIN(name, isa) ISA_JOIN2(name, isa)
#define ISA(name) ISA_JOIN(name, BREECH_ISA)

void ISA(p2g)(mpm *m, brick *b);
void ISA(gather)(mpm *m, int site);
void ISA(nodes)(mpm *m, int site, int thread);
void ISA(touch)(mpm *m, int site, int thread);
size_t ISA(node_bytes)(int groups);
void ISA(g2p)(mpm *m, brick *b, int thread);
void ISA(relax)(mpm *m, brick *b, relax_pass pass, int nth, double time);

/* The two elements beside the node of a cell along each axis. */
typedef struct {
    double x[3];                /* of the nodes before, at and after [m] */
    double inv_left, inv_right; /* one over the element sizes [1/m] */
    double narrowest, widest;   /* least and largest half length of a domain in the weights [m] */
    double cell, inv_cell;      /* size of the cell [m], one over it [1/m] */
} cell_axis;

LANE_INLINE cell_axis cell_axis_at(const axis *a, int i)
{
    const double left = axis_left(a, i), right = axis_right(a, i);
    return (cell_axis){ .x = { a->node[i - 1], a->node[i], a->node[i + 1] },
                        .inv_left = 1 / left,
                        .inv_right = 1 / right,
                        .narrowest = 0.025 * (left < right ? left : right),
                        .widest = 0.5 * (left < right ? left : right),
                        .cell = 0.5 * (left + right),
                        .inv_cell = 1 / (0.5 * (left + right)) };
}

/* Are all lanes of the part of a block that begins with `lane` holes? */
LANE_INLINE bool part_is_empty(int mask, int lane)
{
    return (int)WIDTH < (int)LANES && !(mask >> lane & ((1 << WIDTH) - 1));
}

typedef struct {
    vd w[3], g[3], d[3]; /* weights, their derivatives with the point's position [1/m], node minus point [m] */
} weights;

/* Generalized interpolation over the domain x - l .. x + l (Bardenhagen and Kober 2004), on unequal elements:
 *   w = 1/(2 l) int N dx,   g = [N(x + l) - N(x - l)]/(2 l),   N the hat functions of the three nodes            */
LANE_INLINE weights weights_gimp(const cell_axis *c, double narrowest, vd x, vd half)
{
    const vd zero = vd_set(0), l = vd_max(vd_min(half, vd_set(c->widest)), vd_set(narrowest));
    const vd t = x - c->x[1], a = t - l, b = t + l;
    const vd aL = vd_min(a, zero), bL = vd_min(b, zero), aR = vd_max(a, zero), bR = vd_max(b, zero);
    const vd scale = vd_set(0.5) / l, sL = scale * c->inv_left, sR = scale * c->inv_right;
    weights r;
    r.w[0] = vd_set(0.5) * sL * (aL * aL - bL * bL);
    r.w[2] = vd_set(0.5) * sR * (bR * bR - aR * aR);
    r.w[1] = vd_set(1) - r.w[0] - r.w[2];
    r.g[0] = sL * (aL - bL);
    r.g[2] = sR * (bR - aR);
    r.g[1] = zero - r.g[0] - r.g[2];
    for (int k = 0; k < 3; k++) r.d[k] = c->x[k] - x;
    return r;
}

/* Quadratic B-spline whose knots are the cell's edges, on unequal cells: the three functions that do not vanish
 * between the knots e1 < e2 (de Boor).  A function's place is the middle of its cell, not the node: then linear fields
 * are exact on any grading, sum w d = 0, and the affine part adds no momentum. */
typedef struct {
    double e[4];         /* knots around the cell: two below, two above [m] */
    double below, above; /* one over the cell's size times the distance of the knots around the function [1/m2] */
} knots;

LANE_INLINE knots knots_at(const axis *a, int i)
{
    const double *e = &a->edge[i - 1], h = e[2] - e[1];
    return (knots){ { e[0], e[1], e[2], e[3] }, 1 / (h * (e[2] - e[0])), 1 / (h * (e[3] - e[1])) };
}

LANE_INLINE weights weights_bspline(const knots *q, vd x)
{
    const vd from = x - q->e[1], to = q->e[2] - x;
    weights r;
    r.w[0] = to * to * q->below;
    r.w[2] = from * from * q->above;
    r.w[1] = vd_set(1) - r.w[0] - r.w[2];
    r.g[0] = to * (-2 * q->below);
    r.g[2] = from * (2 * q->above);
    r.g[1] = vd_set(0) - r.g[0] - r.g[2];
    for (int k = 0; k < 3; k++) r.d[k] = 0.5 * (q->e[k] + q->e[k + 1]) - x;
    return r;
}

/* Blocks lie in the order of cells (mpm_store_compact), so the one after next is most likely needed after next.  Its
 * first `fields` fields, a cache line each, are asked for a share at a time between the parts of a block's work: a core
 * keeps a dozen or so requests under way, and stands still where more are made at once. */
typedef struct {
    const char *next, *end;
    int share; /* lines */
} ahead;

LANE_INLINE ahead ahead_of(const mpm *m, int index, int fields, int shares)
{
    const char *p = (const char *)&m->blocks[index] + 2 * sizeof(block);
    return (ahead){ p, p + 64 * fields, (fields + shares - 1) / shares };
}

LANE_INLINE void prefetch_share(ahead *a)
{
    for (int i = 0; i < a->share && a->next < a->end; i++, a->next += 64) __builtin_prefetch(a->next);
}

/* Least half length of a domain that keeps a point stable, an open side of its cell, times the cell [m2].  Its forces
 * change its own velocity gradient by dt sigma/rho sum_i |grad S_i|^2 / S_i over nodes that it shares with no other.
 * Where its domain just reaches over its cell's node, those beyond n open sides give n/(l h).  With C = c dt/h and the
 * linear viscosity q the limit is l = n h C (C + 2 q)/4, that of an oscillator damped at the end of its step; what is
 * taken is a third more.  docs/notes/solver.md has the scenes that blew up with less.  Without the affine part the last
 * step's gradient is forgotten, which halves the limit. */
LANE_INLINE double stable_area(const mpm *m, const brick *b, int body, double cell)
{
    const law *k = &m->laws[body];
    const double way = k->sound * b->steady_dt;
    return (m->scene.transfer == MPM_TRANSFER_TPIC ? 1 : 2) / 3.0 * way * (way + 2 * k->q1 * cell);
}

/* The cells of a brick along each axis. */
typedef struct {
    cell_axis axis[3][BRICK];
    knots knots[3][BRICK];
    bool bspline;
} brick_grid;

/* (W-2) on a face that moves with v along the wave's axis: the force along that axis on its area [Pa]. */
LANE_INLINE vd wave_push(const wave_load *w, vd v)
{
    return w->inwards * vd_max(w->base - w->Z * w->inwards * v, vd_set(w->least));
}

/* Everything a cell's points need to know of the grid; borrowed from the brick's. */
typedef struct {
    const cell_axis *axis[3];
    const knots *knots[3];
    int sides[3]; /* open ones of the cell, where it has one along the axis; else 1 */
    bool bspline;
} cell_grid;

/* First of the 27 nodes of a cell in its brick's 6 x 6 x 6. */
LANE_INLINE int halo_index(int cell)
{
    return (cell / (BRICK * BRICK) * HALO + cell / BRICK % BRICK) * HALO + cell % BRICK;
}

/* ---- mirror planes: the ghost nodes beyond them, in a brick's 6 x 6 x 6 ---- */

typedef struct {
    int axis, ghost, mirror; /* halo indices along the axis */
} mirror_plane;

static inline int halo_at(const int at[3])
{
    return (at[2] * HALO + at[1]) * HALO + at[0];
}

/* Where the sums of a node of the 6 x 6 x 6 lie in brick.out: nodes that go to one neighbour lie together, in the order
 * of its cells, so that it reads them in one piece (nodes.c: add_lines).  First the six times six below along z, and so
 * on inwards. */
#define HALO_SIDE(i) ((i) == 0 ? 0 : (i) == HALO - 1 ? 2 : 1)
#define HALO_START(i, rest) ((i) == 0 ? 0 : (i) == HALO - 1 ? (HALO - 1) * (rest) : (rest))
#define HALO_COUNT(i) (HALO_SIDE(i) == 1 ? BRICK : 1)
#define HALO_WITHIN(i) (HALO_SIDE(i) == 1 ? (i)-1 : 0)
#define HALO_PLACE(x, y, z)                                                                                  \
    (HALO_START(z, HALO * HALO) + HALO_COUNT(z) * (HALO_START(y, HALO) + HALO_COUNT(y) * HALO_START(x, 1)) + \
     (HALO_WITHIN(z) * HALO_COUNT(y) + HALO_WITHIN(y)) * HALO_COUNT(x) + HALO_WITHIN(x))
#define HALO_ROW(y, z)                                                                                       \
    HALO_PLACE(0, y, z), HALO_PLACE(1, y, z), HALO_PLACE(2, y, z), HALO_PLACE(3, y, z), HALO_PLACE(4, y, z), \
        HALO_PLACE(5, y, z)
#define HALO_PLANE(z) HALO_ROW(0, z), HALO_ROW(1, z), HALO_ROW(2, z), HALO_ROW(3, z), HALO_ROW(4, z), HALO_ROW(5, z)
static const uint8_t halo_place[HALO_NODES] = { HALO_PLANE(0), HALO_PLANE(1), HALO_PLANE(2),
                                                HALO_PLANE(3), HALO_PLANE(4), HALO_PLANE(5) };

/* Point n (0 .. 35) of a plane across axis k. */
static inline void plane_point(int k, int plane, int n, int at[3])
{
    at[k] = plane;
    at[(k + 1) % 3] = n % HALO;
    at[(k + 2) % 3] = n / HALO;
}

/* Is this end of the brick's level a mirror to its group? */
static inline bool is_mirror(const mpm *m, const brick *b, int k, int side)
{
    const mpm_axis *s = &m->scene.axis[k];
    return s->boundary[side] == MPM_BOUNDARY_SYMMETRY && !m->group[b->group].passes[2 * k + side];
}

/* Mirror planes that the brick's points reach over; their number, by axis. */
static inline int mirror_planes(const mpm *m, const brick *b, mirror_plane p[6])
{
    int n = 0;
    for (int k = 0; k < 3; k++)
        for (int side = 0; side < 2; side++) {
            if (!is_mirror(m, b, k, side)) continue;
            const int at = (side ? axes_of(m, b)[k].last : 1) - BRICK * b->at[k] + 1;
            if (at < 1 || at > BRICK) continue;
            p[n++] = (mirror_plane){ k, side ? at + 1 : at - 1, side ? at - 1 : at + 1 };
        }
    return n;
}

/* Is this ghost of plane i a ghost of an earlier plane too, which it is folded over first? */
static inline bool mirror_shared(const mirror_plane *p, int i, const int at[3])
{
    for (int j = 0; j < i; j++)
        if (p[j].axis != p[i].axis && at[p[j].axis] == p[j].ghost) return true;
    return false;
}

LANE_INLINE brick_grid brick_grid_at(const mpm *m, const brick *b)
{
    brick_grid g;
    g.bspline = m->scene.basis == MPM_BASIS_BSPLINE;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < BRICK; i++) {
            const int node = BRICK * b->at[k] + i;
            const axis *from = &axes_of(m, b)[k];
            if (node < 1 || node > from->last) continue; /* no points there */
            cell_axis *a = &g.axis[k][i];
            *a = cell_axis_at(from, node);
            if (g.bspline) g.knots[k][i] = knots_at(from, node);
        }
    return g;
}

/* In its place: returned by value it is copied in wider pieces than it was written in, which a core waits for. */
LANE_INLINE void cell_grid_set(cell_grid *g, const brick_grid *from, const brick *b, int cell)
{
    const int at[3] = { cell % BRICK, cell / BRICK % BRICK, cell / (BRICK * BRICK) };
    int open[3], all = 0;
    for (int k = 0; k < 3; k++) all += open[k] = (int)(b->open[k][0] >> cell & 1) + (int)(b->open[k][1] >> cell & 1);
    for (int k = 0; k < 3; k++) {
        g->axis[k] = &from->axis[k][at[k]], g->knots[k] = &from->knots[k][at[k]];
        g->sides[k] = open[k] ? all : 1;
    }
    g->bspline = from->bspline;
}

/* Least half lengths of a body's domains along each axis [m]. */
LANE_INLINE void least_domain(const mpm *m, const brick *b, const cell_grid *g, int body, double narrowest[3])
{
    for (int k = 0; k < 3; k++) {
        const cell_axis *a = g->axis[k];
        const double cell = 2 * a->widest, stable = g->sides[k] * stable_area(m, b, body, cell) / cell;
        narrowest[k] = stable < a->narrowest ? a->narrowest : stable < a->widest ? stable : a->widest;
    }
}

/* Heat that a point holds beyond the hottest state of its law; what cold compression takes is none [J/kg].  It goes
 * with the energy of the point's motion to the nodes, and from them to all points around: heat is mixed in, as momentum
 * is.  Else a point that stays in a sheared layer, a cell thick whatever the cell, would be heated without bound. */
LANE_INLINE vd heat_beyond(const law *k, const block *q, int lane)
{
    const vd beyond = vd_load(&q->e[0][lane]) - k->e_hottest;
    if (!vm_bits(vd_less(vd_set(0), beyond))) return vd_set(0);
    const vd mu = vd_load(&q->rho[0][lane]) * k->volume0 - 1;
    const vd cold = vd_where(vd_less(vd_set(0), mu), reference_energy(k, law_form_of(k, k->kernel), mu));
    return vd_max(beyond - cold, vd_set(0));
}

/* Along axis k, for the part of the block that begins with `lane`. */
LANE_INLINE weights cell_weights(const cell_grid *g, const double narrowest[3], int k, const block *q, int lane)
{
    const vd x = vd_load(&q->x[k][lane]);
    return g->bspline ? weights_bspline(g->knots[k], x)
                      : weights_gimp(g->axis[k], narrowest[k], x, vd_load(&q->half[k][lane]));
}

/* Those of a load on a face of the points' domains (mpm_body.traction_face), across it: the stress in the domains adds
 * up to the hat functions at the face, so the load acts on the nodes by them.  A spline's points have no face. */
LANE_INLINE weights face_weights(const cell_grid *g, const double narrowest[3], int face, const block *q, int lane,
                                 const weights *of)
{
    const int k = face / 2;
    const cell_axis *c = g->axis[k];
    weights r = *of;
    if (g->bspline) return r;
    const vd l = vd_max(vd_min(vd_load(&q->half[k][lane]), vd_set(c->widest)), vd_set(narrowest[k]));
    const vd t = vd_load(&q->x[k][lane]) - c->x[1] + (face % 2 ? 1 : -1) * l;
    r.w[0] = (vd_set(0) - vd_min(t, vd_set(0))) * c->inv_left;
    r.w[2] = vd_max(t, vd_set(0)) * c->inv_right;
    r.w[1] = vd_set(1) - r.w[0] - r.w[2];
    return r;
}

LANE_INLINE bool has_face_load(const mpm_body *body, const wave_load *wave)
{
    return wave->on || body->traction[0] != 0 || body->traction[1] != 0 || body->traction[2] != 0;
}

#endif

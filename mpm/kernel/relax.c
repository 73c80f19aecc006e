/* SPDX-License-Identifier: BSD-3-Clause */
/* Pressure relaxation (M-7): what the points of an element between nodes carry beyond their mean, which no node feels.
 *
 * In passes over the bricks (relax_pass).  The sums lie in brick.out, which the next step writes anew; bricks at rest
 * keep theirs, and take no part, nor do those with nothing to relax in or beside them. */
#include "mpm/kernel/kernels.h"
#include "mpm/law/relax_lanes.h"

#include <math.h>
#include <string.h>

enum {
    OCTANTS = 8,         /* of a node's cell: each lies in another element */
    ELEMENTS = BRICK + 1 /* that a brick's points lie in, along an axis: the first ends with its first node */
};

/* Of a body's points in the cell of a node, their parts in the element of each octant. */
typedef struct {
    double room[OCTANTS], push[OCTANTS], loss[OCTANTS]; /* V/K, V p/K, V/K times what is lost [m3/Pa, m3, m3] */
    double softest, largest;                            /* largest 1/K, largest |loss|/K [1/Pa, 1] */
} cell_sums;

/* Of an element: sums of its octants, mean pressure; the share that is lost of what lies beyond it, and the mean of
 * what is lost [Pa, 1, Pa]. */
typedef struct {
    double room, push, softest, largest, P, share, mean;
} element;

typedef element brick_elements[ELEMENTS][ELEMENTS][ELEMENTS]; /* by z, y, x */

static cell_sums *sums_of(const brick *b)
{
    _Static_assert(sizeof(cell_sums[BRICK_CELLS]) <= sizeof(double[HALO_NODES][LINE]), "brick.out holds them");
    return (cell_sums *)(void *)b->out;
}

/* Number `nth` of the bodies of the brick's group, -1: there are fewer. */
static int nth_body(const mpm *m, const brick *b, int nth)
{
    if (nth >= m->group[b->group].bodies) return -1;
    for (int i = m->group[b->group].first; i < m->scene.bodies; i++)
        if (m->scene.body[i].group == b->group && nth-- == 0) return i;
    return -1;
}

static bool moves(const mpm *m, const brick *b)
{
    return b->particles > 0 && b->out && b->still != BRICK_ASLEEP && !m->group[b->group].held;
}

static bool near_uneven(const mpm *m, const brick *b)
{
    for (int i = 0; i < NEIGHBOURS; i++)
        if (b->neighbour[i] >= 0 && m->bricks[b->neighbour[i]].uneven) return true;
    return false;
}

/* Has a body's points that heat or their pressure may set apart?  A kelvin makes some megapascals in a metal. */
static bool is_uneven(const mpm *m, const brick *b, int body)
{
    static const double LITTLE = 1; /* [K] */
    const law *k = &m->laws[body];
    const law_form f = law_form_of(k, k->kernel);
    const vd bound = vd_set(0.5 * RELAX_BOUND * k->K0), heat = vd_set(k->c_v * LITTLE);
    const double start = start_heat(k, f);
    for (int cell = 0; cell < BRICK_CELLS; cell++)
        for (int i = b->head[cell]; i >= 0; i = m->links[i].next) {
            if (m->links[i].body != body) continue;
            const block *q = &m->blocks[i];
            for (int lane = 0; lane < LANES; lane += WIDTH) {
                const vd p = vd_load(&q->p[0][lane]), e = vd_load(&q->e[0][lane]) - start;
                const vd mu = vd_load(&q->rho[0][lane]) * k->volume0 - 1;
                const vm apart = vd_less(bound, vd_max(p, -p)) | vd_less(heat, e - reference_energy(k, f, mu));
                if (vm_bits(apart & vd_less(vd_set(0), vd_load(&q->mass[0][lane])))) return true;
            }
        }
    return false;
}

static void look(mpm *m, brick *b)
{
    b->uneven = false;
    if (!moves(m, b)) return;
    for (int i = m->group[b->group].first; i < m->scene.bodies && !b->uneven; i++)
        b->uneven = m->scene.body[i].group == b->group && is_uneven(m, b, i);
}

/* A cell of a brick, and beside which ends of it a mirror lies: what reaches over one is what reaches back. */
typedef struct {
    cell_grid grid;
    bool mirror[3][2];
} relaxed_cell;

static void cell_set(relaxed_cell *c, const mpm *m, const brick *b, const brick_grid *grid, int cell)
{
    const int at[3] = { cell % BRICK, cell / BRICK % BRICK, cell / (BRICK * BRICK) };
    cell_grid_set(&c->grid, grid, b, cell);
    for (int k = 0; k < 3; k++)
        for (int side = 0; side < 2; side++)
            c->mirror[k][side] =
                BRICK * b->at[k] + at[k] == (side ? axes_of(m, b)[k].last : 1) && is_mirror(m, b, k, side);
}

/* Parts of the points' domains in the elements before and after the node, along each axis; their products by octant. */
LANE_INLINE void parts_of(const mpm *m, const brick *b, const relaxed_cell *cell, int body, const block *q, int lane,
                          vd part[OCTANTS])
{
    double least[3];
    vd side[3][2];
    least_domain(m, b, &cell->grid, body, least);
    for (int k = 0; k < 3; k++) {
        const cell_axis *c = cell->grid.axis[k];
        const vd l = vd_max(vd_min(vd_load(&q->half[k][lane]), vd_set(c->widest)), vd_set(least[k]));
        const vd after = (vd_load(&q->x[k][lane]) - c->x[1] + l) / (2 * l);
        side[k][1] = vd_min(vd_max(after, vd_set(0)), vd_set(1));
        if (cell->mirror[k][0]) side[k][1] = vd_set(1);
        if (cell->mirror[k][1]) side[k][1] = vd_set(0);
        side[k][0] = 1 - side[k][1];
    }
    for (int o = 0; o < OCTANTS; o++) part[o] = side[0][o & 1] * side[1][o >> 1 & 1] * side[2][o >> 2];
}

/* The points of a body in a cell, those of a part of a block at a time: `q` from `lane` on. */
typedef struct {
    const brick *b;
    const relaxed_cell *cell;
    int body, block;
    const law *k;
    law_form form;
    double start_heat;
    block *q;
    int lane;
    relaxing at;
    vd part[OCTANTS], give; /* parts of their domains in the elements; V/K of those that take part */
} points;

static points points_of(const mpm *m, const brick *b, const relaxed_cell *cell, int body, int first)
{
    const law *k = &m->laws[body];
    const law_form f = law_form_of(k, k->kernel);
    return (points){ .b = b,
                     .cell = cell,
                     .body = body,
                     .block = first,
                     .k = k,
                     .form = f,
                     .start_heat = start_heat(k, f),
                     .lane = -(int)WIDTH };
}

/* false: there are no more. */
LANE_INLINE bool next_points(mpm *m, points *p)
{
    for (; p->block >= 0; p->block = m->links[p->block].next, p->lane = -(int)WIDTH) {
        if (m->links[p->block].body != p->body) continue;
        for (p->lane += WIDTH; p->lane < (int)LANES; p->lane += WIDTH) {
            if (part_is_empty(m->links[p->block].mask, p->lane)) continue;
            p->q = &m->blocks[p->block];
            parts_of(m, p->b, p->cell, p->body, p->q, p->lane, p->part);
            p->at = relaxing_of(p->k, p->form, p->start_heat, p->q, p->lane);
            p->give = vd_where(p->at.takes_part, p->at.mass * p->at.volume / p->at.K);
            return true;
        }
    }
    return false;
}

static void sum_cell(mpm *m, points p, cell_sums *to)
{
    vd room[OCTANTS], push[OCTANTS], softest = vd_set(0);
    for (int o = 0; o < OCTANTS; o++) room[o] = push[o] = vd_set(0);
    while (next_points(m, &p)) {
        const relaxing *r = &p.at;
        for (int o = 0; o < OCTANTS; o++) room[o] += p.part[o] * p.give, push[o] += p.part[o] * p.give * r->p;
        softest = vd_max(softest, vd_where(r->takes_part, 1 / r->K));
    }
    for (int o = 0; o < OCTANTS; o++) to->room[o] = vd_sum(room[o]), to->push[o] = vd_sum(push[o]);
    to->softest = vd_largest(softest);
}

/* The first block of the body in a cell, or -1. */
static int first_block(const mpm *m, const brick *b, int cell, int body)
{
    int i = b->head[cell];
    while (i >= 0 && m->links[i].body != body) i = m->links[i].next;
    return i;
}

/* What the octants of the cell of node x, y, z of the brick's 6 x 6 x 6 add to elements; `losses`: those too. */
static void add_cell(const cell_sums *from, int x, int y, int z, bool losses, brick_elements to)
{
    for (int o = 0; o < OCTANTS; o++) {
        const int i = x - 1 + (o & 1), j = y - 1 + (o >> 1 & 1), k = z - 1 + (o >> 2);
        if (i < 0 || i >= ELEMENTS || j < 0 || j >= ELEMENTS || k < 0 || k >= ELEMENTS) continue;
        element *e = &to[k][j][i];
        e->room += from->room[o], e->push += from->push[o];
        if (losses) e->mean += from->loss[o], e->largest = fmax(e->largest, from->largest);
        e->softest = fmax(e->softest, from->softest);
    }
}

static double least_size(const mpm *m, const brick *b, const int at[3])
{
    double size = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
        const axis *a = &axes_of(m, b)[k];
        const int node = BRICK * b->at[k] + at[k]; /* at the element's end */
        if (node >= 1 && node <= a->last + 1) size = fmin(size, a->node[node] - a->node[node - 1]);
    }
    return size;
}

/* From the sums of the brick and those next door; with `losses`, has any of them something to lose? */
static bool gather_elements(const mpm *m, const brick *b, const law *of, double time, bool losses, brick_elements to)
{
    bool lost = false;
    memset(to, 0, sizeof(brick_elements));
    for (int n = 0; n < HALO_NODES; n++) {
        const int x = n % HALO, y = n / HALO % HALO, z = n / (HALO * HALO);
        const int there = b->neighbour[HALO_SIDE(x) + 3 * (HALO_SIDE(y) + 3 * HALO_SIDE(z))];
        if (there < 0 || !m->bricks[there].relaxes) continue;
        const int cell = cell_index((x + BRICK - 1) % BRICK, (y + BRICK - 1) % BRICK, (z + BRICK - 1) % BRICK);
        add_cell(&sums_of(&m->bricks[there])[cell], x, y, z, losses, to);
    }
    for (int n = 0; n < ELEMENTS * ELEMENTS * ELEMENTS; n++) {
        const int at[3] = { n % ELEMENTS, n / ELEMENTS % ELEMENTS, n / (ELEMENTS * ELEMENTS) };
        element *e = &to[at[2]][at[1]][at[0]];
        if (!(e->room > 0)) continue;
        lost = lost || e->mean != 0;
        e->P = e->push / e->room, e->mean /= e->room;
        e->share = -expm1(-RELAX_RATE * of->sound * time / least_size(m, b, at));
        const double most = e->largest + fabs(e->mean) * e->softest; /* |dV/V|: its own, and what it takes up */
        if (most > RELAX_MOST) e->share *= RELAX_MOST / most, e->mean *= RELAX_MOST / most;
    }
    return lost;
}

/* Those of the octants of a cell of the brick. */
static void elements_of(brick_elements all, int cell, const element *in[OCTANTS])
{
    const int at[3] = { cell % BRICK, cell / BRICK % BRICK, cell / (BRICK * BRICK) };
    for (int o = 0; o < OCTANTS; o++) in[o] = &all[at[2] + (o >> 2)][at[1] + (o >> 1 & 1)][at[0] + (o & 1)];
}

/* What points lose of their pressure in an element [Pa]. */
LANE_INLINE vd loss(const element *e, const relaxing *r)
{
    const vd x = r->p - e->P, bound = RELAX_BOUND * r->K;
    const vd kept = vd_max(vd_min(x - r->warm, bound), vd_set(0));
    return e->share * (x - vd_min(vd_max(x, -bound), kept));
}

static void sum_losses(mpm *m, points p, const element *in[OCTANTS], cell_sums *to)
{
    vd lost[OCTANTS], largest = vd_set(0);
    for (int o = 0; o < OCTANTS; o++) lost[o] = vd_set(0);
    while (next_points(m, &p))
        for (int o = 0; o < OCTANTS; o++) {
            const vd l = vd_where(p.at.takes_part, loss(in[o], &p.at));
            lost[o] += p.part[o] * p.give * l;
            largest = vd_max(largest, vd_max(l, -l) / p.at.K);
        }
    for (int o = 0; o < OCTANTS; o++) to->loss[o] = vd_sum(lost[o]);
    to->largest = vd_largest(largest);
}

/* (M-7) */
static void relax_cell(mpm *m, points p, const element *in[OCTANTS])
{
    while (next_points(m, &p)) {
        vd beyond = vd_set(0), power = vd_set(0);
        for (int o = 0; o < OCTANTS; o++) {
            const vd d = p.part[o] * (loss(in[o], &p.at) - in[o]->mean);
            beyond += d, power += in[o]->P * d;
        }
        const vd per = vd_where(p.at.takes_part, p.at.volume / p.at.K);
        relax(p.k, p.form, level_dt_last(m, p.b->level), per * beyond, per * power, &p.at, p.q, p.lane);
    }
}

static void one_body(mpm *m, brick *b, relax_pass pass, int body, double time)
{
    cell_sums *sums = sums_of(b);
    brick_elements all;
    const element *in[OCTANTS];
    if (pass == RELAX_SUMS) memset(sums, 0, BRICK_CELLS * sizeof *sums);
    if (body < 0) return;
    if (pass != RELAX_SUMS && !gather_elements(m, b, &m->laws[body], time, pass == RELAX_POINTS, all) &&
        pass == RELAX_POINTS)
        return;
    const brick_grid grid = brick_grid_at(m, b);
    for (int cell = 0; cell < BRICK_CELLS; cell++) {
        const int first = first_block(m, b, cell, body);
        if (first < 0) continue;
        relaxed_cell c;
        cell_set(&c, m, b, &grid, cell);
        const points p = points_of(m, b, &c, body, first);
        if (pass != RELAX_SUMS) elements_of(all, cell, in);
        if (pass == RELAX_SUMS) sum_cell(m, p, &sums[cell]);
        if (pass == RELAX_LOSSES) sum_losses(m, p, in, &sums[cell]);
        if (pass == RELAX_POINTS) relax_cell(m, p, in);
    }
}

void ISA(relax)(mpm *m, brick *b, relax_pass pass, int nth, double time)
{
    if (pass == RELAX_LOOK) {
        look(m, b);
        return;
    }
    if (pass == RELAX_SUMS) b->relaxes = moves(m, b) && near_uneven(m, b);
    if (b->relaxes) one_body(m, b, pass, nth_body(m, b, nth), time);
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Pressure relaxation (M-7): what the points of an element between nodes carry beyond their mean, which no node feels.
 *
 * In passes over the bricks: which have points to relax; sums of the points' parts in the eight elements around each
 * node; sums of what they are to lose; their loss.  The sums lie in brick.out, which the next step writes anew; bricks
 * at rest keep theirs, and take no part, nor do those with nothing to relax in or beside them. */
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
    double room[OCTANTS], push[OCTANTS], excess[OCTANTS]; /* V/K, V p/K, V/K times what is lost [m3/Pa, m3, m3] */
    double hardest, softest;                              /* largest |p|, largest 1/K [Pa, 1/Pa] */
} cell_sums;

/* Of an element: sums of its octants, mean pressure; the share that is lost of what lies beyond it, and the mean of
 * what is lost [Pa, 1, Pa]. */
typedef struct {
    double room, push, hardest, softest, P, share, mean;
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
    for (int cell = 0; cell < BRICK_CELLS; cell++)
        for (int i = b->head[cell]; i >= 0; i = m->links[i].next) {
            if (m->links[i].body != body) continue;
            const block *q = &m->blocks[i];
            for (int lane = 0; lane < LANES; lane += WIDTH) {
                const vd p = vd_load(&q->p[0][lane]), e = vd_load(&q->e[0][lane]) - start_heat(k, f);
                const vd mu = vd_load(&q->rho[0][lane]) * k->volume0 - 1;
                const vm apart = vd_less(bound, vd_max(p, -p)) | vd_less(heat, e - reference_energy(k, f, mu));
                if (vm_bits(apart & vd_less(vd_set(0), vd_load(&q->mass[0][lane])))) return true;
            }
        }
    return false;
}

void ISA(relax_look)(mpm *m, brick *b)
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

/* Of the body's blocks in a cell, the first of which is `first`. */
static void sum_cell(const mpm *m, const brick *b, const relaxed_cell *c, int body, int first, cell_sums *to)
{
    const law *k = &m->laws[body];
    const law_form f = law_form_of(k, k->kernel);
    vd room[OCTANTS], push[OCTANTS], hardest = vd_set(0), softest = vd_set(0);
    for (int o = 0; o < OCTANTS; o++) room[o] = push[o] = vd_set(0);
    for (int i = first; i >= 0; i = m->links[i].next) {
        if (m->links[i].body != body) continue;
        const block *q = &m->blocks[i];
        for (int lane = 0; lane < LANES; lane += WIDTH) {
            if (part_is_empty(m->links[i].mask, lane)) continue;
            vd part[OCTANTS];
            parts_of(m, b, c, body, q, lane, part);
            const relaxing r = relaxing_of(k, f, q, lane);
            const vd give = vd_where(r.takes_part, r.mass * r.volume / r.K);
            for (int o = 0; o < OCTANTS; o++) room[o] += part[o] * give, push[o] += part[o] * give * r.p;
            hardest = vd_max(hardest, vd_where(r.takes_part, vd_max(r.p, -r.p)));
            softest = vd_max(softest, vd_where(r.takes_part, 1 / r.K));
        }
    }
    for (int o = 0; o < OCTANTS; o++) to->room[o] = vd_sum(room[o]), to->push[o] = vd_sum(push[o]);
    to->hardest = vd_largest(hardest), to->softest = vd_largest(softest);
}

/* The first block of the body in a cell, or -1. */
static int first_block(const mpm *m, const brick *b, int cell, int body)
{
    int i = b->head[cell];
    while (i >= 0 && m->links[i].body != body) i = m->links[i].next;
    return i;
}

void ISA(relax_sums)(mpm *m, brick *b, int nth)
{
    b->relaxes = moves(m, b) && near_uneven(m, b);
    if (!b->relaxes) return;
    const int body = nth_body(m, b, nth);
    cell_sums *to = sums_of(b);
    memset(to, 0, BRICK_CELLS * sizeof *to);
    if (body < 0) return;
    const brick_grid grid = brick_grid_at(m, b);
    for (int cell = 0; cell < BRICK_CELLS; cell++) {
        const int first = first_block(m, b, cell, body);
        if (first < 0) continue;
        relaxed_cell c;
        cell_set(&c, m, b, &grid, cell);
        sum_cell(m, b, &c, body, first, &to[cell]);
    }
}

/* What the octants of the cell of node x, y, z of the brick's 6 x 6 x 6 add to elements; `excess`: that too. */
static void add_cell(const cell_sums *from, int x, int y, int z, bool excess, brick_elements to)
{
    for (int o = 0; o < OCTANTS; o++) {
        const int i = x - 1 + (o & 1), j = y - 1 + (o >> 1 & 1), k = z - 1 + (o >> 2);
        if (i < 0 || i >= ELEMENTS || j < 0 || j >= ELEMENTS || k < 0 || k >= ELEMENTS) continue;
        element *e = &to[k][j][i];
        e->room += from->room[o], e->push += from->push[o];
        if (excess) e->mean += from->excess[o];
        e->hardest = fmax(e->hardest, from->hardest), e->softest = fmax(e->softest, from->softest);
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

/* From the sums of the brick and those next door; with `excess`, has any of them something to lose? */
static bool gather_elements(const mpm *m, const brick *b, const law *of, double time, bool excess, brick_elements to)
{
    bool lost = false;
    memset(to, 0, sizeof(brick_elements));
    for (int n = 0; n < HALO_NODES; n++) {
        const int x = n % HALO, y = n / HALO % HALO, z = n / (HALO * HALO);
        const int there = b->neighbour[HALO_SIDE(x) + 3 * (HALO_SIDE(y) + 3 * HALO_SIDE(z))];
        if (there < 0 || !m->bricks[there].relaxes) continue;
        const int cell = cell_index((x + BRICK - 1) % BRICK, (y + BRICK - 1) % BRICK, (z + BRICK - 1) % BRICK);
        add_cell(&sums_of(&m->bricks[there])[cell], x, y, z, excess, to);
    }
    for (int n = 0; n < ELEMENTS * ELEMENTS * ELEMENTS; n++) {
        const int at[3] = { n % ELEMENTS, n / ELEMENTS % ELEMENTS, n / (ELEMENTS * ELEMENTS) };
        element *e = &to[at[2]][at[1]][at[0]];
        if (!(e->room > 0)) continue;
        lost = lost || e->mean != 0;
        e->P = e->push / e->room, e->mean /= e->room;
        e->share = -expm1(-RELAX_RATE * of->sound * time / least_size(m, b, at));
        const double most = e->share * 2 * e->hardest * e->softest; /* |dV/V| */
        if (most > RELAX_MOST) e->share *= RELAX_MOST / most;
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

static void sum_excess(const mpm *m, const brick *b, const relaxed_cell *c, int body, int first,
                       const element *in[OCTANTS], cell_sums *to)
{
    const law *k = &m->laws[body];
    const law_form f = law_form_of(k, k->kernel);
    vd excess[OCTANTS];
    for (int o = 0; o < OCTANTS; o++) excess[o] = vd_set(0);
    for (int i = first; i >= 0; i = m->links[i].next) {
        if (m->links[i].body != body) continue;
        const block *q = &m->blocks[i];
        for (int lane = 0; lane < LANES; lane += WIDTH) {
            if (part_is_empty(m->links[i].mask, lane)) continue;
            vd part[OCTANTS];
            parts_of(m, b, c, body, q, lane, part);
            const relaxing r = relaxing_of(k, f, q, lane);
            const vd give = vd_where(r.takes_part, r.mass * r.volume / r.K);
            for (int o = 0; o < OCTANTS; o++) excess[o] += part[o] * give * loss(in[o], &r);
        }
    }
    for (int o = 0; o < OCTANTS; o++) to->excess[o] = vd_sum(excess[o]);
}

/* (M-7) */
static void relax_cell(mpm *m, const brick *b, const relaxed_cell *c, int body, int first, const element *in[OCTANTS])
{
    const law *k = &m->laws[body];
    const law_form f = law_form_of(k, k->kernel);
    for (int i = first; i >= 0; i = m->links[i].next) {
        if (m->links[i].body != body) continue;
        block *q = &m->blocks[i];
        for (int lane = 0; lane < LANES; lane += WIDTH) {
            if (part_is_empty(m->links[i].mask, lane)) continue;
            vd part[OCTANTS], beyond = vd_set(0), power = vd_set(0);
            parts_of(m, b, c, body, q, lane, part);
            const relaxing r = relaxing_of(k, f, q, lane);
            for (int o = 0; o < OCTANTS; o++) {
                const vd d = part[o] * (loss(in[o], &r) - in[o]->mean);
                beyond += d, power += in[o]->P * d;
            }
            const vd per = vd_where(r.takes_part, r.volume / r.K);
            relax(k, f, level_dt_last(m, b->level), per * beyond, per * power, &r, q, lane);
        }
    }
}

void ISA(relax)(mpm *m, brick *b, int nth, double time, bool sums)
{
    if (!b->relaxes) return;
    const int body = nth_body(m, b, nth);
    if (body < 0) return;
    brick_elements all;
    if (!gather_elements(m, b, &m->laws[body], time, !sums, all) && !sums) return;
    const brick_grid grid = brick_grid_at(m, b);
    for (int cell = 0; cell < BRICK_CELLS; cell++) {
        const int first = first_block(m, b, cell, body);
        if (first < 0) continue;
        const element *in[OCTANTS];
        elements_of(all, cell, in);
        relaxed_cell c;
        cell_set(&c, m, b, &grid, cell);
        if (sums)
            sum_excess(m, b, &c, body, first, in, &sums_of(b)[cell]);
        else
            relax_cell(m, b, &c, body, first, in);
    }
}

/* SPDX-License-Identifier: BSD-3-Clause */
/* Levels where the rules want them (refine.h): between two steps of the coarsest level, now and then.
 *
 * A look counts every granule's life down by one, then points that ask for a level's cells give a full life to the
 * granules around them.  Where a granule has become active or has ceased to be, points change their level: into finer
 * cells they are halved until they fit, in coarser ones they stay as they are until merge.c joins sound ones that lie
 * deep in their group. */
#include "mpm/memory/build.h"
#include "mpm/memory/store.h"
#include "mpm/refine/refine.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

/* ---- what the rules ask for ---- */

/* What a rule asks for in each cell of a brick. */
typedef struct {
    uint8_t level[BRICK_CELLS];
} brick_levels;

/* What points ask of a cell: its size, and what that is a mean or the least of. */
typedef struct {
    double mass, mass_over_size; /* [kg, kg/m] */
    double smallest;             /* [m] */
} wish;

static wish wish_of_cell(const mpm *m, const brick *b, int cell, const mpm_refine *r)
{
    wish w = { .smallest = INFINITY };
    for (int q = b->head[cell]; q >= 0; q = m->links[q].next) {
        double size[LANES];
        if (r->body >= 0 && r->body != m->links[q].body) continue;
        r->kind->cells(m, r, q, size);
        for (unsigned left = m->links[q].mask; left; left &= left - 1) {
            const int l = __builtin_ctz(left);
            const double mass = m->blocks[q].mass[0][l];
            w.smallest = fmin(w.smallest, size[l]);
            w.mass += mass, w.mass_over_size += mass / size[l];
        }
    }
    return w;
}

static int level_of(const mpm *m, const mpm_refine *r, double size)
{
    const int level = mpm_grids_level_for(&m->scene, fmax(size, r->cell));
    return level > m->finest ? level : m->finest;
}

/* The mean of what points ask for; no points ask for nothing. */
static int level_of_mean(const mpm *m, const mpm_refine *r, const wish *w)
{
    return level_of(m, r, w->mass_over_size > 0 ? w->mass / w->mass_over_size : INFINITY);
}

/* Of the eight cells twice as wide that a brick's make, the one that holds cell c. */
static int wide_cell(int c)
{
    return c % BRICK / 2 + 2 * (c / BRICK % BRICK / 2) + 4 * (c / (BRICK * BRICK) / 2);
}

/* By the mean, a cell asks for smaller ones than itself on its own.  For its own size it asks where the cell that would
 * take its place, twice as wide, would be too large: the mean over 2 x 2 x 2 cells, in which one noisy point is little.
 */
static void ask_mean(const mpm *m, const brick *b, const mpm_refine *r, const wish own[BRICK_CELLS],
                     brick_levels *asked)
{
    wish wide[8] = { { 0 } };
    for (int c = 0; c < BRICK_CELLS; c++) {
        wish *w = &wide[wide_cell(c)];
        w->mass += own[c].mass, w->mass_over_size += own[c].mass_over_size;
    }
    for (int c = 0; c < BRICK_CELLS; c++) {
        const int finer = level_of_mean(m, r, &own[c]), here = level_of_mean(m, r, &wide[wide_cell(c)]);
        asked->level[c] = (uint8_t)(finer < b->level ? finer : here < b->level ? b->level : here);
        if (own[c].mass == 0) asked->level[c] = (uint8_t)(m->grids.levels - 1);
    }
}

static void ask_brick(const mpm *m, const brick *b, const mpm_refine *r, brick_levels *asked)
{
    wish own[BRICK_CELLS];
    for (int c = 0; c < BRICK_CELLS; c++) own[c] = wish_of_cell(m, b, c, r);
    if (r->kind->mean)
        ask_mean(m, b, r, own, asked);
    else
        for (int c = 0; c < BRICK_CELLS; c++) asked->level[c] = (uint8_t)level_of(m, r, own[c].smallest);
}

/* The level active over a brick's cell and so far around it. */
static status activate_cell(mpm *m, const brick *b, int cell, int level, const mpm_refine *r)
{
    double lo[3], hi[3];
    const double reach = r->kind->reach ? r->kind->reach(r) : 0;
    for (int k = 0; k < 3; k++) {
        const double *edge = &axes_of(m, b)[k].edge[BRICK * b->at[k] + (cell >> 2 * k) % BRICK];
        const double more = reach + r->kind->buffer * m->scene.axis[k].fine * (1 << level);
        lo[k] = edge[0] - more, hi[k] = edge[1] + more;
    }
    return mpm_grids_activate(&m->grids, level, lo, hi);
}

static status ask_rule(mpm *m, const mpm_refine *r, brick_levels *asked)
{
    const int coarsest = m->grids.levels - 1;
#pragma omp parallel for schedule(dynamic, 8) num_threads(m->threads)
    for (int i = 0; i < m->bricks_used; i++) ask_brick(m, &m->bricks[i], r, &asked[i]);
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS && m->bricks[i].particles > 0; c++)
            if (asked[i].level[c] < coarsest) TRY(activate_cell(m, &m->bricks[i], c, asked[i].level[c], r));
    return status_ok();
}

static status ask_rules(mpm *m)
{
    status s = status_ok();
    brick_levels *asked = malloc((size_t)(m->bricks_used + 1) * sizeof *asked);
    CHECK(asked, STATUS_MEMORY, "no memory to ask where cells should be small");
    for (int i = 0; i < m->scene.refines && s.code == STATUS_OK; i++) s = ask_rule(m, &m->scene.refine[i], asked);
    free(asked);
    return s;
}

static status ask_zone(mpm *m)
{
    return m->time < m->scene.zone_until ? mpm_grids_activate_zone(&m->grids, &m->scene) : status_ok();
}

/* ---- points to their levels ---- */

static int axis_to_halve(const mpm *m, const mover_head *h, const double *q)
{
    const axis *a = m->grids.level[h->level].axes;
    const int in[3] = { h->cell % BRICK, h->cell / BRICK % BRICK, h->cell / (BRICK * BRICK) };
    for (int k = 0; k < 3 && q[FIRST_damage] < 1; k++)
        if (2 * q[FIRST_half + k] > a[k].longest[BRICK * h->at[k] + in[k]]) return k;
    return -1;
}

/* Notes where a point goes, halved until its new cell bears it.  False: no memory. */
static bool send(mpm *m, brick *b, int body, double *q)
{
    mover_list *to = &m->movers[b->movers_thread];
    mover_head h = { .body = body, .level = mpm_grids_level(&m->grids, q + FIRST_x) };
    h.cell = mpm_store_cell_at(m, h.level, q + FIRST_x, h.at);
    const int k = h.cell >= 0 ? axis_to_halve(m, &h, q) : -1;
    if (k >= 0) {
        double other[BLOCK_DOUBLES];
        mpm_point_halve(q, other, k);
        b->sum.splits++;
        return send(m, b, body, other) && send(m, b, body, q);
    }
    if (!mpm_movers_reserve(to, 1)) return false;
    if (h.cell >= 0) mpm_point_rescale_step(q, level_dt_last(m, b->level), level_dt_last(m, h.level));
    to->head[to->count] = h;
    memcpy(to->data[to->count++], q, sizeof to->data[0]);
    b->movers++;
    return true;
}

static bool send_foreign(mpm *m, brick *b, int cell)
{
    bool enough = true, any = false;
    for (int q = b->head[cell]; q >= 0; q = m->links[q].next) {
        double(*from)[LANES] = (double(*)[LANES])(void *)&m->blocks[q];
        for (unsigned lanes = m->links[q].mask; lanes; lanes &= lanes - 1) {
            const int lane = __builtin_ctz(lanes);
            double one[BLOCK_DOUBLES];
            for (int k = 0; k < 3; k++) one[FIRST_x + k] = from[FIRST_x + k][lane];
            if (mpm_grids_level(&m->grids, one + FIRST_x) == b->level) continue;
            for (int i = 0; i < BLOCK_DOUBLES; i++) one[i] = from[i][lane];
            enough = send(m, b, m->links[q].body, one) && enough;
            mpm_store_drop_lane(m, b, q, lane);
            any = true;
        }
    }
    if (any) mpm_store_tidy_cell(m, b, cell);
    return enough;
}

/* What a brick at an interface has must go with it: neighbours look at its sums. */
static void find_interface(const mpm *m, brick *b)
{
    b->interface = mpm_interface_nodes(m, b->level, b->at, b->foreign);
    b->at_interface = interface_any(&b->interface);
    if (!b->at_interface) free(b->line), b->line = NULL;
    if (!interface_shared(&b->interface)) free(b->held), b->held = NULL;
}

static bool empty_brick(mpm *m, brick *b)
{
    bool enough = true;
    b->sum.splits = 0;
    b->movers = 0, b->movers_thread = omp_get_thread_num(), b->movers_first = m->movers[b->movers_thread].count;
    if (!mpm_interface_changed(m, b)) return true;
    find_interface(m, b);
    for (int c = 0; c < BRICK_CELLS; c++)
        if (b->foreign[c] && b->head[c] >= 0) enough = send_foreign(m, b, c) && enough;
    return enough;
}

/* Bricks for the points that come from another, and a bound on the blocks they take: each run of points to one cell its
 * own.  Points that have no cell are booked as gone. */
static status receive(mpm *m, int from, int *blocks)
{
    const brick old = m->bricks[from]; /* the array may move */
    const mover_list *list = &m->movers[old.movers_thread];
    m->report.splits += old.sum.splits;
    for (int i = old.movers_first, run = 0; i < old.movers_first + old.movers; i++) {
        const mover_head *h = &list->head[i];
        int found;
        if (h->cell >= 0) {
            run = i > old.movers_first && memcmp(h, h - 1, sizeof *h) == 0 ? run + 1 : 0;
            *blocks += run % LANES == 0;
            if (run == 0) TRY(mpm_store_brick(m, old.group, h->level, h->at, &found));
            continue;
        }
        departure d = { .count = 0 };
        mpm_point_departure(list->data[i], level_dt_last(m, old.level), &d);
        mpm_book_departure(m, &d);
    }
    return status_ok();
}

/* Every thread looks at all points and takes those of its own bricks: in each brick they come in the order of the old
 * ones. */
static bool fill_bricks(mpm *m, int n)
{
    const int me = omp_get_thread_num(), threads = omp_get_num_threads();
    bool enough = true;
    for (int b = 0; b < n; b++) {
        const brick *old = &m->bricks[b];
        const mover_list *list = &m->movers[old->movers_thread];
        for (int i = old->movers_first; i < old->movers_first + old->movers; i++) {
            const mover_head *h = &list->head[i];
            const int to = h->cell >= 0 ? brick_at(m, old->group, h->level, h->at) : -1;
            if (to < 0 || to % threads != me) continue;
            enough = mpm_store_insert(m, &m->bricks[to], h->cell, h->body, list->data[i]) >= 0 && enough;
            m->bricks[to].fresh = true;
        }
    }
    return enough;
}

static status move_points(mpm *m)
{
    bool enough = true;
    int blocks = 0;
    const int n = m->bricks_used;
    for (int t = 0; t < m->threads; t++) m->movers[t].count = 0;
#pragma omp parallel for schedule(dynamic, 8) num_threads(m->threads) reduction(&& : enough)
    for (int i = 0; i < n; i++) enough = empty_brick(m, &m->bricks[i]) && enough;
    CHECK(enough, STATUS_MEMORY, "no memory for the points that change their level");
    for (int i = 0; i < n; i++) TRY(receive(m, i, &blocks));
    TRY(mpm_store_reserve(m, blocks));
#pragma omp parallel num_threads(m->threads) reduction(&& : enough)
    enough = fill_bricks(m, n);
    CHECK(enough, STATUS_MEMORY, "no memory for the points");
    TRY(mpm_store_prune(m));
    return mpm_store_reserve(m, 0);
}

/* ---- a look ---- */

static void count_down(grids *g)
{
    for (int i = 0; i < grids_flags(g); i++) {
        g->before[i] = g->active[i] > 0;
        if (g->active[i]) g->active[i]--;
    }
}

static bool has_changed(const grids *g)
{
    for (int i = 0; i < grids_flags(g); i++)
        if (g->before[i] != (g->active[i] > 0)) return true;
    return false;
}

status mpm_refine_flags(mpm *m, bool *changed)
{
    *changed = false;
    if (m->grids.levels == 1) return status_ok();
    count_down(&m->grids);
    TRY(ask_zone(m));
    TRY(ask_rules(m));
    TRY(mpm_grids_nest(&m->grids));
    *changed = has_changed(&m->grids);
    return status_ok();
}

status mpm_refine_look(mpm *m)
{
    bool changed;
    TRY(mpm_refine_flags(m, &changed));
    if (changed) TRY(move_points(m));
    TRY(mpm_merge_points(m));
    m->report.particles = mpm_points(m);
    return status_ok();
}

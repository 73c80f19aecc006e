/* SPDX-License-Identifier: BSD-3-Clause */
/* Points that change cells: they leave their block after G2P and enter the new cell before the next P2G.
 *
 * Each brick's movers lie together in the list of the thread that worked on it.  A brick reads its arrivals from its 27
 * neighbours in a fixed order, so the order of points in a cell does not depend on the number of threads. */
#include "mpm/memory/store.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

bool mpm_movers_reserve(mover_list *list, int more)
{
    if (list->count + more <= list->capacity) return true;
    const int64_t capacity = 2 * (int64_t)list->capacity + more + 1024;
    if (capacity > INT_MAX || capacity < list->count + more) return false;
    mover_head *head = realloc(list->head, (size_t)capacity * sizeof *head);
    if (head) list->head = head;
    double(*data)[BLOCK_DOUBLES] = realloc(list->data, (size_t)capacity * sizeof *data);
    if (data) list->data = data;
    if (!head || !data) return false;
    list->capacity = (int)capacity;
    return true;
}

/* New cell of a point near (ci, cj, ck); false when it has left the window.  A point that reaches a level in the middle
 * of that level's step stays on its own level until the step ends: the nodes there are constrained, so it moves with
 * the coarser level. */
static bool find_cell(const mpm *m, const brick *b, const int cell[3], const double *x, mover_head *h)
{
    int step = 0, place[3];
    h->level = b->at_interface ? mpm_grids_level(&m->grids, x) : b->level;
    const bool stays = h->level > m->ends;
    if (stays) h->level = b->level;
    if (h->level != b->level) {
        h->brick_step = CROSSES;
        h->cell = mpm_store_cell_at(m, h->level, x, h->at);
        return h->cell >= 0;
    }
    for (int k = 0, scale = 1; k < 3; k++, scale *= 3) {
        const axis *a = &axes_of(m, b)[k];
        int i = BRICK * b->at[k] + cell[k];
        while (i >= 1 && x[k] < a->edge[i]) i--;
        while (i <= a->last && x[k] >= a->edge[i + 1]) i++;
        if (i < 1 || i > a->last) return false;
        int d = i / BRICK - b->at[k];
        step += scale * (d + 1);
        place[k] = i % BRICK;
    }
    h->brick_step = step;
    h->cell = cell_index(place[0], place[1], place[2]);
    return true;
}

/* Dust is described by no law here; it is taken out and booked. */
static bool erodes(const law *k, const double *q)
{
    const bool loose = q[FIRST_damage] >= 1 || q[FIRST_T] >= k->T_m;
    return loose && q[FIRST_rho] < k->rho_dust;
}

static void send(mpm *m, brick *b, const int cell[3], int body, const double *q)
{
    mover_list *list = &m->movers[b->movers_thread];
    mover_head h = { .body = body };
    if (!find_cell(m, b, cell, q + FIRST_x, &h)) {
        mpm_point_departure(q, level_dt(m, b->level), &b->sum.left);
        return;
    }
    list->head[list->count] = h;
    memcpy(list->data[list->count], q, sizeof list->data[0]);
    if (h.brick_step == CROSSES)
        mpm_point_rescale_step(list->data[list->count], level_dt(m, b->level), level_dt(m, h.level));
    list->count++;
    b->movers++;
    b->mover_steps |= 1u << h.brick_step;
}

static int axis_to_split(const mpm *m, const brick *b, const int cell[3], const double *q)
{
    if (q[FIRST_damage] >= 1) return -1;
    for (int k = 0; k < 3; k++) {
        const axis *a = &axes_of(m, b)[k];
        if (2 * q[FIRST_half + k] > a->longest[BRICK * b->at[k] + cell[k]]) return k;
    }
    return -1;
}

void mpm_movers_take(mpm *m, brick *b, int cell, int block_index, int leaving)
{
    const int at[3] = { cell % BRICK, cell / BRICK % BRICK, cell / (BRICK * BRICK) };
    block *q = &m->blocks[block_index];
    block_link *link = &m->links[block_index];
    double(*from)[LANES] = (double(*)[LANES])(void *)q;
    for (int lane = 0; lane < LANES; lane++) {
        if (!(leaving >> lane & 1)) continue;
        double one[BLOCK_DOUBLES], other[BLOCK_DOUBLES];
        for (int i = 0; i < BLOCK_DOUBLES; i++) one[i] = from[i][lane];
        const int k = axis_to_split(m, b, at, one);
        if (erodes(&m->laws[link->body], one)) {
            mpm_point_departure(one, level_dt(m, b->level), &b->sum.left);
            b->sum.eroded++;
            b->sum.eroded_mass += one[FIRST_mass];
            mpm_store_drop_lane(m, b, block_index, lane);
            continue;
        }
        if (k >= 0) {
            mpm_point_halve(one, other, k);
            send(m, b, at, link->body, other);
            b->sum.splits++;
        }
        send(m, b, at, link->body, one);
        mpm_store_drop_lane(m, b, block_index, lane);
    }
}

/* Points that a cell's blocks of a body have room for before the block `last`. */
static int holes_before(const mpm *m, const brick *b, int cell, int last)
{
    int holes = 0;
    for (int q = b->head[cell]; q != last; q = m->links[q].next)
        if (m->links[q].body == m->links[last].body) holes += LANES - __builtin_popcount(m->links[q].mask);
    return holes;
}

static bool is_last_of_body(const mpm *m, int index)
{
    for (int q = m->links[index].next; q >= 0; q = m->links[q].next)
        if (m->links[q].body == m->links[index].body) return false;
    return true;
}

/* A block that has been taken out of its cell's chain: its points go to holes before it. */
static void empty_block(mpm *m, brick *b, int cell, int index)
{
    double(*from)[LANES] = (double(*)[LANES])(void *)&m->blocks[index];
    for (unsigned left = m->links[index].mask; left; left &= left - 1) {
        double one[BLOCK_DOUBLES];
        for (int i = 0; i < BLOCK_DOUBLES; i++) one[i] = from[i][__builtin_ctz(left)];
        b->particles--;
        mpm_store_insert(m, b, cell, m->links[index].body, one);
    }
    b->blocks--;
    mpm_store_release(m, index);
}

/* As few blocks as each body's points need: the last one is emptied where its points fit into the others' holes. */
static void merge_cell(mpm *m, brick *b, int cell)
{
    for (int *link = &b->head[cell]; *link >= 0;) {
        const int q = *link;
        if (is_last_of_body(m, q) && holes_before(m, b, cell, q) >= __builtin_popcount(m->links[q].mask)) {
            *link = m->links[q].next;
            empty_block(m, b, cell, q);
            link = &b->head[cell];
        } else {
            link = &m->links[q].next;
        }
    }
}

/* Inserts this brick's arrivals from its neighbours, if any; false when no block is free. */
static bool arrive(mpm *m, brick *b, bool *any)
{
    bool enough = true;
    for (int step = 0; step < NEIGHBOURS; step++) {
        if (b->neighbour[step] < 0) continue;
        const brick *from = &m->bricks[b->neighbour[step]];
        const int towards = NEIGHBOURS - 1 - step; /* me, seen from there */
        if (!(from->mover_steps >> towards & 1)) continue;
        const mover_list *list = &m->movers[from->movers_thread];
        for (int i = from->movers_first; i < from->movers_first + from->movers; i++) {
            const mover_head *h = &list->head[i];
            if (h->brick_step != towards) continue;
            if (mpm_store_insert(m, b, h->cell, h->body, list->data[i]) < 0) enough = false;
            *any = true;
        }
    }
    return enough;
}

/* Calls `each` for every mover to another level, in the order of bricks. */
typedef status crosser(mpm *m, const mover_list *list, int i, int group);

static status each_crossing(mpm *m, crosser *each)
{
    const int before = m->bricks_used;
    for (int i = 0; i < before; i++) {
        if (!(m->bricks[i].mover_steps >> CROSSES & 1)) continue;
        const brick b = m->bricks[i]; /* the array may move */
        const mover_list *list = &m->movers[b.movers_thread];
        for (int k = b.movers_first; k < b.movers_first + b.movers; k++)
            if (list->head[k].brick_step == CROSSES) TRY(each(m, list, k, b.group));
    }
    return status_ok();
}

static status make_across(mpm *m, const mover_list *list, int i, int group)
{
    int to;
    return mpm_store_brick(m, group, list->head[i].level, list->head[i].at, &to);
}

static status arrive_across(mpm *m, const mover_list *list, int i, int group)
{
    brick *b = &m->bricks[brick_at(m, group, list->head[i].level, list->head[i].at)];
    const int q = mpm_store_insert(m, b, list->head[i].cell, list->head[i].body, list->data[i]);
    CHECK(q >= 0, STATUS_MEMORY, "the blocks of points ran out where the grids' levels meet: use larger cells");
    b->occupied |= 1ull << list->head[i].cell;
    b->fresh = true;
    return status_ok();
}

/* Do all points lie in cells whose surrounding bricks exist? */
static bool all_covered(const mpm *m)
{
    for (int i = 0; i < m->bricks_used; i++)
        if (m->bricks[i].occupied & ~m->bricks[i].covered) return false;
    return true;
}

status mpm_movers_exchange(mpm *m)
{
    bool enough = true;
    TRY(each_crossing(m, make_across));
    TRY(mpm_store_reserve(m, 0));
#pragma omp parallel for schedule(dynamic, 8) num_threads(m->threads) reduction(&& : enough)
    for (int i = 0; i < m->bricks_used; i++) {
        brick *b = &m->bricks[i];
        if (!b->reached || b->level > m->ends) continue;
        bool changed = b->mover_steps || b->sum.left.count;
        for (int c = 0; c < BRICK_CELLS && changed; c++) mpm_store_tidy_cell(m, b, c);
        enough = arrive(m, b, &changed) && enough;
        for (int c = 0; c < BRICK_CELLS && changed; c++) merge_cell(m, b, c);
        b->occupied = mpm_occupied_cells(b);
    }
    TRY(each_crossing(m, arrive_across));
    if (!all_covered(m)) TRY(m->ends == m->grids.levels - 1 ? mpm_store_prune(m) : mpm_store_cover(m));
    CHECK(enough, STATUS_MEMORY,
          "the blocks of points ran out within one step at t = %g s; this is a limit of the solver: use larger cells",
          m->time);
    return status_ok();
}

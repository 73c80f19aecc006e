/* SPDX-License-Identifier: BSD-3-Clause */
/* Bricks and blocks: making, finding, linking.  One thread at a time, but for mpm_store_insert and mpm_store_release.
 */
#include "mpm/memory/store.h"

#include <assert.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

/* Large arrays start on a huge page and ask for them: points and nodes are reached in no order that small pages like.
 */
static void *aligned(size_t bytes)
{
    enum { LINE_BYTES = 64, HUGE_BYTES = 1 << 21 };
    const size_t unit = bytes < HUGE_BYTES ? LINE_BYTES : HUGE_BYTES, whole = (bytes + unit - 1) / unit * unit;
    void *p = aligned_alloc(unit, whole);
#ifdef MADV_HUGEPAGE
    if (p && unit == HUGE_BYTES) madvise(p, whole, MADV_HUGEPAGE); /* a wish: refusal costs nothing */
#endif
    return p;
}

static void *cleared(size_t bytes)
{
    void *p = aligned(bytes);
    return p ? memset(p, 0, bytes) : NULL;
}

/* A bigger, 64-byte aligned array with the old content; NULL and the old one untouched when memory is short. */
static void *enlarge(void *old, size_t old_bytes, size_t bytes)
{
    void *fresh = aligned(bytes);
    if (!fresh) return NULL;
    if (old) memcpy(fresh, old, old_bytes);
    free(old);
    return fresh;
}

static void chain_free_blocks(mpm *m, int first)
{
    for (int i = m->blocks_capacity - 1; i >= first; i--) {
        m->links[i] = (block_link){ .next = m->free_head };
        m->free_head = i;
        m->blocks_free++;
    }
}

static status grow_blocks(mpm *m, int capacity)
{
    const size_t old = (size_t)m->blocks_capacity;
    block *b = enlarge(m->blocks, old * sizeof(block), (size_t)capacity * sizeof(block));
    CHECK(b, STATUS_MEMORY, "no memory for %d blocks of points (%.1f GB): use larger cells", capacity,
          1e-9 * capacity * (double)sizeof(block));
    m->blocks = b;
    block_link *l = enlarge(m->links, old * sizeof(block_link), (size_t)capacity * sizeof(block_link));
    CHECK(l, STATUS_MEMORY, "no memory for %d blocks of points", capacity);
    m->links = l;
    m->blocks_capacity = capacity;
    chain_free_blocks(m, (int)old);
    return status_ok();
}

static void free_places(mpm *m)
{
    for (int i = 0; m->touch && i < m->places; i++) free(m->touch[i].node), free(m->touch[i].trial);
    free(m->touch);
    free(m->directory);
    free(m->site_list);
    free(m->interface_list);
    free(m->site_sum);
}

/* Room for the bricks of all places that there are. */
static status grow_places(mpm *m)
{
    const int places = grids_places(&m->grids);
    if (places <= m->places) return status_ok();
    const int room = places > 2 * m->places ? places : 2 * m->places;
    int *directory = realloc(m->directory, (size_t)m->groups * (size_t)room * sizeof *directory);
    if (directory) m->directory = directory;
    free(m->site_list), free(m->interface_list), free(m->site_sum);
    m->site_list = malloc((size_t)room * sizeof(int));
    m->interface_list = malloc((size_t)room * sizeof(int));
    m->site_sum = malloc((size_t)room * sizeof(tally));
    m->site_count = m->interface_count = 0;
    touch_site *touch = realloc(m->touch, (size_t)room * sizeof *touch);
    if (touch) m->touch = touch;
    CHECK(directory && m->site_list && m->interface_list && m->site_sum && touch, STATUS_MEMORY,
          "no memory for %d places of bricks", room);
    memset(touch + m->places, 0, (size_t)(room - m->places) * sizeof *touch);
    for (size_t i = directory_slot(m, m->places, 0); i < directory_slot(m, room, 0); i++) m->directory[i] = -1;
    m->places = room;
    return status_ok();
}

status mpm_store_make(mpm *m, int blocks)
{
    m->free_head = -1;
    TRY(grow_places(m));
    return grow_blocks(m, blocks);
}

static void free_brick(brick *b)
{
    free(b->out);
    free(b->out_contact);
    free(b->line);
    free(b->held);
}

void mpm_store_free(mpm *m)
{
    for (int i = 0; i < m->bricks_used; i++) free_brick(&m->bricks[i]);
    for (int t = 0; t < MPM_MAX_THREADS; t++) {
        free(m->movers[t].head);
        free(m->movers[t].data);
    }
    free(m->bricks);
    free(m->nodes);
    free_places(m);
    free(m->blocks);
    free(m->links);
}

static status grow_bricks(mpm *m)
{
    if (m->bricks_used < m->bricks_capacity) return status_ok();
    const int capacity = m->bricks_capacity ? 2 * m->bricks_capacity : 256;
    brick *b = enlarge(m->bricks, (size_t)m->bricks_used * sizeof(brick), (size_t)capacity * sizeof(brick));
    CHECK(b, STATUS_MEMORY, "no memory for %d bricks", capacity);
    m->bricks = b;
    void *nodes = enlarge(m->nodes, (size_t)m->bricks_used * sizeof *m->nodes, (size_t)capacity * sizeof *m->nodes);
    CHECK(nodes, STATUS_MEMORY, "no memory for %d bricks", capacity);
    m->nodes = nodes;
    m->bricks_capacity = capacity;
    return status_ok();
}

status mpm_store_brick(mpm *m, int group, int level, const int at[3], int *out)
{
    int site;
    TRY(mpm_grids_add_place(&m->grids, level, at, &site));
    TRY(grow_places(m));
    int *slot = &m->directory[directory_slot(m, site, group)];
    if (*slot < 0) {
        TRY(grow_bricks(m));
        brick *b = &m->bricks[m->bricks_used];
        memset(b, 0, sizeof *b);
        b->group = group, b->level = level;
        b->interface = mpm_interface_nodes(m, level, at, b->foreign);
        b->at_interface = interface_any(&b->interface);
        memcpy(b->at, at, sizeof b->at);
        for (int c = 0; c < BRICK_CELLS; c++) b->head[c] = -1;
        for (int k = 0; k < NEIGHBOURS; k++) b->neighbour[k] = -1;
        memset(m->nodes[m->bricks_used], 0, sizeof *m->nodes);
        *slot = m->bricks_used++;
    }
    *out = *slot;
    return status_ok();
}

status mpm_store_open(brick *b)
{
    if (!b->out) b->out = cleared(HALO_NODES * sizeof *b->out);
    CHECK(b->out, STATUS_MEMORY, "no memory for a brick");
    return status_ok();
}

status mpm_store_empty(mpm *m, int blocks)
{
    for (int i = 0; i < m->bricks_used; i++) free_brick(&m->bricks[i]);
    m->bricks_used = 0;
    for (size_t i = 0; i < directory_slot(m, m->places, 0); i++) m->directory[i] = -1;
    m->free_head = -1, m->blocks_free = 0;
    chain_free_blocks(m, 0);
    return blocks > m->blocks_capacity ? grow_blocks(m, blocks + blocks / 8) : status_ok();
}

/* May another group have points at this place or next door? */
static bool meets_other(const mpm *m, const brick *b)
{
    for (int step = 0; step < NEIGHBOURS; step++) {
        int to[3];
        if (!brick_step_inside(m, b, step, to)) continue;
        for (int f = 0; f < m->groups; f++) {
            const int other = brick_at(m, f, b->level, to);
            if (f != b->group && other >= 0 && m->bricks[other].covered) return true;
        }
    }
    return false;
}

/* False: no memory. */
static bool link_brick(mpm *m, brick *b)
{
    for (int step = 0; step < NEIGHBOURS; step++) {
        int to[3];
        b->neighbour[step] = brick_step_inside(m, b, step, to) ? brick_at(m, b->group, b->level, to) : -1;
    }
    b->across = b->at_interface && mpm_interface_in_contact(m, b);
    b->contact = b->across || meets_other(m, b);
    const bool surface = b->contact || m->cavities || mpm_arrival_cells(m, b); /* volume gradients are summed */
    if (surface && b->out && !b->out_contact) b->out_contact = aligned(HALO_NODES * sizeof *b->out_contact);
    if (b->at_interface && !b->line) b->line = cleared(2 * BRICK_CELLS * sizeof *b->line);
    if (interface_shared(&b->interface) && !b->held) b->held = cleared(sizeof *b->held);
    return (b->out_contact || !surface || !b->out) && (b->line || !b->at_interface) &&
           (b->held || !interface_shared(&b->interface));
}

static void list_sites_of_level(mpm *m, int level)
{
    for (int p = 0; p < m->grids.pages; p++)
        for (int s = p * PAGE_PLACES; m->grids.page[p].level == level && s < (p + 1) * PAGE_PLACES; s++) {
            int groups = 0;
            for (int f = 0; s < m->places && f < m->groups; f++) {
                const int i = brick_of_site(m, s, f);
                if (i < 0 || groups++ > 0) continue;
                m->site_list[m->site_count++] = s;
                if (m->bricks[i].at_interface) m->interface_list[m->interface_count++] = s;
            }
            if (groups > m->crowd) m->crowd = groups;
        }
    m->sites_to[level] = m->site_count, m->interfaces_to[level] = m->interface_count;
}

static void list_sites(mpm *m)
{
    m->site_count = m->interface_count = m->crowd = 0;
    for (int level = 0; level < m->grids.levels; level++) list_sites_of_level(m, level);
}

status mpm_store_relink(mpm *m)
{
    bool enough = true;
#pragma omp parallel for schedule(dynamic, 16) num_threads(m->threads) reduction(&& : enough)
    for (int i = 0; i < m->bricks_used; i++) enough = link_brick(m, &m->bricks[i]) && enough;
    CHECK(enough, STATUS_MEMORY, "no memory for a brick");
    list_sites(m);
    return status_ok();
}

/* ---- the bricks that points need ---- */

enum { SLACK = 1 }; /* cells that they may go on before bricks are made anew */

/* Those with nodes that they reach. */
static status want_neighbours(mpm *m, int index)
{
    for (int step = 0; step < NEIGHBOURS; step++) {
        const brick *b = &m->bricks[index]; /* the array may move */
        int to[3], found;
        if (!(b->occupied & mpm_cells_towards(step, SLACK + 1)) || !brick_step_inside(m, b, step, to)) continue;
        TRY(mpm_store_brick(m, b->group, b->level, to, &found));
        m->bricks[found].wanted = true;
    }
    return status_ok();
}

static status want_bricks(mpm *m)
{
    int n = m->bricks_used;
#pragma omp parallel for schedule(static) num_threads(m->threads)
    for (int i = 0; i < n; i++) {
        brick *b = &m->bricks[i];
        b->occupied = mpm_occupied_cells(b);
        b->wanted = b->occupied != 0;
    }
    for (int i = 0; i < n; i++)
        if (m->bricks[i].occupied) TRY(want_neighbours(m, i));
    n = m->bricks_used;
#pragma omp parallel for schedule(dynamic, 16) num_threads(m->threads)
    for (int i = 0; i < n; i++) {
        brick *b = &m->bricks[i];
        b->covered = b->wanted ? mpm_cells_around(m, b, SLACK) : 0;
        b->reached = b->wanted ? mpm_cells_around(m, b, SLACK + 1) : 0;
    }
    for (int i = 0; i < n; i++)
        if (m->bricks[i].at_interface && m->bricks[i].reached) TRY(mpm_interface_want_bricks(m, i));
    for (int i = 0; i < m->bricks_used; i++)
        if (m->bricks[i].covered) TRY(mpm_store_open(&m->bricks[i]));
    return status_ok();
}

static void forget_unwanted(mpm *m)
{
    int n = 0;
    for (int i = 0; i < m->bricks_used; i++) {
        brick *b = &m->bricks[i];
        int *slot = &m->directory[directory_slot(m, grids_place(&m->grids, b->level, b->at), b->group)];
        *slot = b->wanted ? n : -1;
        if (b->wanted)
            m->bricks[n++] = *b;
        else
            free_brick(b);
    }
    m->bricks_used = n;
}

status mpm_store_cover(mpm *m)
{
    TRY(want_bricks(m));
    return mpm_store_relink(m);
}

status mpm_store_prune(mpm *m)
{
    TRY(want_bricks(m));
    forget_unwanted(m);
    return mpm_store_relink(m);
}

status mpm_store_reserve(mpm *m, int blocks)
{
    const int step = 64 + m->blocks_capacity / 16, wanted = blocks > step ? blocks : step;
    if (m->blocks_free >= wanted) return status_ok();
    return grow_blocks(m, 2 * m->blocks_capacity + wanted); /* pages that nobody touches cost nothing */
}

/* Values that let the kernels run over a hole without a trap. */
static void block_clear(mpm *m, block *q, int body, const double *point)
{
    double(*to)[LANES] = (double(*)[LANES])(void *)q;
    for (int i = 0; i < BLOCK_DOUBLES; i++)
        for (int l = 0; l < LANES; l++) to[i][l] = point[i];
    const law *k = &m->laws[body];
    for (int l = 0; l < LANES; l++) {
        q->mass[0][l] = q->p[0][l] = q->ep[0][l] = q->damage[0][l] = q->area[0][l] = q->ka[0][l] = 0;
        q->e[0][l] = k->e_start;
        q->rho[0][l] = k->rho_start;
        q->T[0][l] = k->T_r;
        for (int i = 0; i < 6; i++) q->s[i][l] = 0;
        for (int i = 0; i < 9; i++) q->L[i][l] = 0;
        for (int i = 0; i < 3; i++) q->v[i][l] = 0;
    }
}

static int take_free_block(mpm *m)
{
    int i;
#pragma omp critical(breech_blocks)
    {
        i = m->free_head;
        if (i >= 0) {
            m->free_head = m->links[i].next;
            m->blocks_free--, m->blocks_scattered++;
        }
    }
    return i;
}

void mpm_store_release(mpm *m, int i)
{
#pragma omp critical(breech_blocks)
    {
        m->links[i].next = m->free_head;
        m->free_head = i;
        m->blocks_free++;
    }
}

void mpm_store_release_cell(mpm *m, brick *b, int cell)
{
    b->still = 0;
    while (b->head[cell] >= 0) {
        const int i = b->head[cell];
        b->head[cell] = m->links[i].next;
        b->blocks--;
        mpm_store_release(m, i);
    }
}

void mpm_store_drop_lane(mpm *m, brick *b, int block_index, int lane)
{
    block *q = &m->blocks[block_index];
    b->still = 0;
    m->links[block_index].mask &= (uint8_t) ~(1u << lane);
    q->mass[0][lane] = q->area[0][lane] = 0;
    b->particles--;
}

void mpm_store_tidy_cell(mpm *m, brick *b, int cell)
{
    for (int *link = &b->head[cell]; *link >= 0;) {
        const int i = *link;
        if (m->links[i].mask == 0) {
            *link = m->links[i].next;
            mpm_store_release(m, i);
            b->blocks--;
        } else {
            link = &m->links[i].next;
        }
    }
}

/* Places that take the block at the next one, cycle by cycle; the last of a cycle takes that at the first. */
typedef struct {
    int n, *place, *first; /* index of the cycle's first place */
} moves;

/* From where each block goes, -1: nowhere, which is used up. */
static void find_moves(int *to, int blocks, moves *c)
{
    c->n = 0;
    for (int i = 0; i < blocks; i++) {
        const int first = c->n;
        for (int at = i; to[at] >= 0 && to[at] != at;) {
            const int next = to[at];
            to[at] = -1;
            c->first[c->n] = first;
            c->place[c->n++] = at;
            at = next;
        }
        /* found from each place to where its block goes: backwards each takes the next one's */
        for (int a = first, b = c->n - 1; a < b; a++, b--) {
            const int place = c->place[a];
            c->place[a] = c->place[b], c->place[b] = place;
        }
    }
}

typedef struct {
    block points;
    block_link link;
} held_block;

static held_block hold(const mpm *m, int i)
{
    return (held_block){ m->blocks[i], m->links[i] };
}

static void put(mpm *m, int i, const held_block *h)
{
    m->blocks[i] = h->points, m->links[i] = h->link;
}

/* This thread's part of the moves.  What is overwritten before it is taken is held: the first block of the cycle that
 * is under way, and the one after the part.  Other threads may overwrite the two: they are held before any begins. */
static void make_moves(mpm *m, const moves *c)
{
    const int me = omp_get_thread_num(), threads = omp_get_num_threads();
    const int lo = (int)((int64_t)c->n * me / threads), hi = (int)((int64_t)c->n * (me + 1) / threads);
    held_block first = { .link = { 0 } }, after = first;
    if (lo < hi) first = hold(m, c->place[c->first[lo]]);
    if (hi < c->n) after = hold(m, c->place[hi]);
#pragma omp barrier
    for (int i = lo; i < hi; i++) {
        if (c->first[i] == i) first = hold(m, c->place[i]);
        const int to = c->place[i];
        if (i + 1 == c->n || c->first[i + 1] == i + 1)
            put(m, to, &first);
        else if (i + 1 == hi)
            put(m, to, &after);
        else
            m->blocks[to] = m->blocks[c->place[i + 1]], m->links[to] = m->links[c->place[i + 1]];
    }
}

/* Where each block goes, -1: nowhere; the number of those in use. */
static int compact_order(const mpm *m, int *to)
{
    int used = 0;
    for (int i = 0; i < m->blocks_capacity; i++) to[i] = -1;
    for (int s = 0; s < m->site_count; s++)
        for (int f = 0; f < m->groups; f++) {
            const int i = brick_of_site(m, m->site_list[s], f);
            for (int c = 0; i >= 0 && c < BRICK_CELLS; c++)
                for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next) to[q] = used++;
        }
    for (int i = 0, spare = used; i < used; i++) { /* free blocks make room; those beyond stay where they are */
        if (to[i] >= 0) continue;
        while (to[spare] < 0) spare++;
        to[i] = spare++;
    }
    return used;
}

status mpm_store_compact(mpm *m)
{
    const size_t blocks = (size_t)m->blocks_capacity;
    int *to = malloc(3 * blocks * sizeof *to);
    CHECK(to, STATUS_MEMORY, "no memory to sort %d blocks", m->blocks_capacity);
    const int used = compact_order(m, to);
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            if (m->bricks[i].head[c] >= 0) m->bricks[i].head[c] = to[m->bricks[i].head[c]];
    for (int i = 0; i < m->blocks_capacity; i++)
        if (m->links[i].next >= 0) m->links[i].next = to[m->links[i].next];
    moves c = { .place = to + blocks, .first = to + 2 * blocks };
    find_moves(to, m->blocks_capacity, &c);
#pragma omp parallel num_threads(m->threads)
    make_moves(m, &c);
    free(to);
    m->free_head = -1, m->blocks_free = 0, m->blocks_scattered = 0;
    chain_free_blocks(m, used);
    return status_ok();
}

int mpm_store_insert(mpm *m, brick *b, int cell, int body, const double *point)
{
    int *link = &b->head[cell];
    b->still = 0;
    while (*link >= 0 && (m->links[*link].body != body || m->links[*link].mask == 0xff)) link = &m->links[*link].next;
    if (*link < 0) {
        const int fresh = take_free_block(m);
        if (fresh < 0) return -1;
        m->links[fresh] = (block_link){ .next = -1, .body = (uint16_t)body };
        block_clear(m, &m->blocks[fresh], body, point);
        *link = fresh;
        b->blocks++;
    }
    const int lane = __builtin_ctz(~(unsigned)m->links[*link].mask);
    m->links[*link].mask |= (uint8_t)(1u << lane);
    double(*to)[LANES] = (double(*)[LANES])(void *)&m->blocks[*link];
    for (int i = 0; i < BLOCK_DOUBLES; i++) to[i][lane] = point[i];
    b->particles++;
    return *link;
}

int mpm_store_cell_at(const mpm *m, int level, const double x[3], int at[3])
{
    int place[3];
    for (int k = 0; k < 3; k++) {
        const axis *a = &m->grids.level[level].axes[k];
        const int node = mpm_axis_locate(a, x[k]);
        if (node < 1 || node > a->last) return -1;
        at[k] = node / BRICK;
        place[k] = node % BRICK;
    }
    return cell_index(place[0], place[1], place[2]);
}

status mpm_store_place(mpm *m, int body, const double *point)
{
    int at[3], index;
    const int level = mpm_grids_level(&m->grids, point + FIRST_x);
    const int cell = mpm_store_cell_at(m, level, point + FIRST_x, at);
    assert(cell >= 0);
    TRY(mpm_store_brick(m, m->scene.body[body].group, level, at, &index));
    if (m->blocks_free == 0) TRY(mpm_store_reserve(m, 0));
    CHECK(mpm_store_insert(m, &m->bricks[index], cell, body, point) >= 0, STATUS_MEMORY, "no memory for the points");
    return status_ok();
}

status mpm_store_settle(mpm *m)
{
    TRY(mpm_store_cover(m));
    TRY(mpm_store_reserve(m, 0));
    return mpm_store_compact(m);
}

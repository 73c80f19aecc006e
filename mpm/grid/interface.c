/* SPDX-License-Identifier: BSD-3-Clause */
/* Where two levels meet: nodes that take their motion from the other level (grid.h).
 *
 * Of the elements around a node some are active on its level, some on the next coarser one:
 *
 *   f---f---f---c-------c     A fine node of which not all eight elements are fine, and a coarse node all of whose
 *   |   |   |   |       |     elements are fine, are constrained: they are no freedoms of their own.  A fine node on
 *   f---f---f---+       |     the border (+, or c of the fine level) moves as the coarse nodes around it say, a coarse
 *   |   |   |   |       |     node inside the fine cells as the fine node at its place.
 *   f---f---f---c-------c
 *
 *   v_f = sum_c P_fc v_c,   P the coarse hat functions at f's place: 1, or 1/2, 1/4, 1/8 of the two, four, eight nodes
 *   around it; v_c = v_f of the fine node at c's place.
 * What points have given to such a node goes to those it follows with the same weights: m_c += P_fc m_f and likewise
 * force. Momentum is that of the motion at c's place, p_c += P_fc m_f [v_f + G_f (x_c - x_f)], G_f by differences of
 * the fine nodes around, as the points' own gradient is in P2G; else a shear would be smoothed out at every step.
 * The energy goes with it,
 *   K_c += P_fc [K_f + (p_f + dt/2 f_f) . G_f (x_c - x_f)].
 * As sum_c P_fc = 1 and sum_c P_fc (x_c - x_f) = 0, mass, momentum and energy stay to rounding; a linear motion is
 * exact.  Constrained nodes never depend on other constrained nodes: the coarse nodes around a fine one that has a
 * coarse element have that element too, and changes of level lie two elements apart (grid.h).
 *
 * Each node's sums are added to by the thread that works on its site, from the other level's sums, which nobody changes
 * then. */
#include "mpm/memory/store.h"

#include <string.h>

/* Ranges of nodes, both ends included. */
typedef struct {
    int lo[3], hi[3];
} node_box;

static int half_down(int i)
{
    return i >= 0 ? i / 2 : -((1 - i) / 2);
}

static bool is_empty(const node_box *r)
{
    for (int k = 0; k < 3; k++)
        if (r->lo[k] > r->hi[k]) return true;
    return false;
}

static const grid_level *level_at(const mpm *m, int level)
{
    return level >= 0 && level < m->grids.levels ? &m->grids.level[level] : NULL;
}

/* Nodes of a brick, and so many around it. */
static node_box nodes_of(const int at[3], int around)
{
    node_box r;
    for (int k = 0; k < 3; k++) r.lo[k] = BRICK * at[k] - around, r.hi[k] = BRICK * at[k] + BRICK - 1 + around;
    return r;
}

/* Nodes of the coarse grid around fine ones, and the other way round those from one coarse node to the last. */
static node_box to_coarse(const node_box *f)
{
    node_box r;
    for (int k = 0; k < 3; k++) r.lo[k] = 1 + half_down(f->lo[k] - 1), r.hi[k] = 1 + half_down(f->hi[k]);
    return r;
}

static node_box to_fine(const node_box *c)
{
    node_box r;
    for (int k = 0; k < 3; k++) r.lo[k] = 2 * c->lo[k] - 1, r.hi[k] = 2 * c->hi[k] - 1;
    return r;
}

static node_box inside(node_box r, const int lo[3], const int hi[3])
{
    for (int k = 0; k < 3; k++) {
        if (r.lo[k] < lo[k]) r.lo[k] = lo[k];
        if (r.hi[k] > hi[k]) r.hi[k] = hi[k];
    }
    return r;
}

/* Of a brick's nodes (bits) those in the box. */
static uint64_t nodes_in(const int at[3], const node_box *r)
{
    uint64_t set = ~0ull;
    for (int k = 0; k < 3; k++) {
        uint64_t layers = 0;
        for (int i = 0; i < BRICK; i++)
            if (BRICK * at[k] + i >= r->lo[k] && BRICK * at[k] + i <= r->hi[k]) layers |= mpm_cells_of_layer(k, i);
        set &= layers;
    }
    return set;
}

/* Nodes of a grid that exist: 0 .. last + 1. */
static node_box existing(const grid_level *g, node_box r)
{
    const int lo[3] = { 0 }, hi[3] = { g->axes[0].last + 1, g->axes[1].last + 1, g->axes[2].last + 1 };
    return inside(r, lo, hi);
}

/* ---- which nodes, which bricks ---- */

/* The elements around a brick's nodes, a bit each: element 4 at + j - FIRST of x is bit j of a row.  Node i of the
 * brick along an axis lies between elements i + FIRST - 2 and i + FIRST - 1. */
enum { FIRST = 5, PATCH = 11 };
typedef struct {
    uint16_t row[PATCH][PATCH]; /* [z][y] */
} element_patch;

/* Along an axis the granules, of a level so many finer, that elements `lo` to `hi` of a level have a part of. */
typedef struct {
    int lo, hi;
} granule_range;

static granule_range granules_of(int lo, int hi, int finer)
{
    enum { BEFORE = 64 }; /* granules before the window, so that their numbers are rounded down too */
    return (granule_range){ (lo * (1 << finer) + BEFORE * GRANULE) / GRANULE - BEFORE,
                            ((hi + 1) * (1 << finer) - 1 + BEFORE * GRANULE) / GRANULE - BEFORE };
}

static bool any_active(const grids *g, int level, granule_range x, granule_range y, granule_range z)
{
    for (int k = z.lo; k <= z.hi; k++)
        for (int j = y.lo; j <= y.hi; j++)
            for (int i = x.lo; i <= x.hi; i++)
                if (granule_is_active(g, level, i, j, k)) return true;
    return false;
}

/* Which of the elements around a brick of `level` have a part of an active granule of the level so many finer. */
static element_patch patch_of(const grids *g, int level, int finer, const int at[3])
{
    element_patch p;
    granule_range granule[3][PATCH];
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < PATCH; j++) {
            const int element = BRICK * at[k] + j - FIRST;
            granule[k][j] = granules_of(element, element, finer);
        }
    for (int z = 0; z < PATCH; z++)
        for (int y = 0; y < PATCH; y++) {
            const bool as_below = z > 0 && granule[2][z].lo == granule[2][z - 1].lo,
                       as_before = y > 0 && granule[1][y].lo == granule[1][y - 1].lo;
            unsigned row = 0, bit = 0;
            for (int x = 0; x < PATCH && !as_below && !as_before; x++) {
                if (x == 0 || granule[0][x].lo != granule[0][x - 1].lo)
                    bit = any_active(g, level - finer, granule[0][x], granule[1][y], granule[2][z]);
                row |= bit << x;
            }
            p.row[z][y] = as_below ? p.row[z - 1][y] : as_before ? p.row[z][y - 1] : (uint16_t)row;
        }
    return p;
}

static element_patch inverse(const element_patch *p)
{
    element_patch r;
    for (int z = 0; z < PATCH; z++)
        for (int y = 0; y < PATCH; y++) r.row[z][y] = (uint16_t)~p->row[z][y];
    return r;
}

/* Nodes (bits) with a bit set among the elements `from` to `to` of each axis, counted from the node's FIRST. */
static uint64_t any_around(const element_patch *p, int from, int to)
{
    uint64_t r = 0;
    for (int z = 0; z < BRICK; z++)
        for (int y = 0; y < BRICK; y++) {
            unsigned row = 0, found = 0;
            for (int k = z + from; k <= z + to; k++)
                for (int j = y + from; j <= y + to; j++) row |= p->row[k][j];
            for (int i = from; i <= to; i++) found |= row >> i;
            r |= (uint64_t)(found & 0xf) << cell_index(0, y, z);
        }
    return r;
}

/* Elements that adjoin a node, those within two, and those within two of the next coarser level. */
static uint64_t any_beside(const element_patch *p)
{
    return any_around(p, FIRST - 2, FIRST - 1);
}
static uint64_t any_near(const element_patch *p)
{
    return any_around(p, FIRST - 3, FIRST);
}
static uint64_t any_near_coarse(const element_patch *p)
{
    return any_around(p, FIRST - 5, FIRST + 2);
}

/* Which of a brick's nodes: all that exist, those but the ghosts, those at the place of a coarser node. */
typedef enum { NODES_ALL, NODES_NO_GHOSTS, NODES_AT_COARSE } node_choice;

static uint64_t nodes_there(const grid_level *g, const int at[3], node_choice which)
{
    uint64_t r = 0;
    for (int c = 0; c < BRICK_CELLS; c++) {
        const int in[3] = { c % BRICK, c / BRICK % BRICK, c / (BRICK * BRICK) };
        bool there = true;
        for (int k = 0; k < 3; k++) {
            const int n = BRICK * at[k] + in[k];
            there = there && n <= g->axes[k].last + 1;
            if (which == NODES_NO_GHOSTS) there = there && n >= 1 && n <= g->axes[k].last;
            if (which == NODES_AT_COARSE) there = there && n % 2;
        }
        r |= (uint64_t)there << c;
    }
    return r;
}

/* Of each cell the octants (bit 0: the upper half along x) that lie in elements of `p`. */
static void mark_octants(const element_patch *p, uint8_t octants[BRICK_CELLS])
{
    for (int c = 0; c < BRICK_CELLS; c++) {
        const int x = c % BRICK + FIRST - 2, y = c / BRICK % BRICK + FIRST - 2, z = c / (BRICK * BRICK) + FIRST - 2;
        for (int o = 0; o < 8; o++)
            if (p->row[z + o / 4][y + o / 2 % 2] >> (x + o % 2) & 1) octants[c] |= (uint8_t)(1u << o);
    }
}

/* The granules that elements `lo` to `hi` around a brick have a part of, counted from its first node's. */
static void granules_around(const int at[3], int finer, int lo, int hi, granule_range r[3])
{
    for (int k = 0; k < 3; k++) r[k] = granules_of(BRICK * at[k] + lo, BRICK * at[k] + hi, finer);
}

/* Are the granules around a brick of `level`, of the level so many finer, all active (1), none (0), or some (-1)?  As
 * far as its elements reach. */
static int all_alike(const grids *g, int level, int finer, const int at[3])
{
    granule_range r[3];
    granules_around(at, finer, -FIRST, PATCH - 1 - FIRST, r);
    const bool first = granule_is_active(g, level - finer, r[0].lo, r[1].lo, r[2].lo);
    for (int z = r[2].lo; z <= r[2].hi; z++)
        for (int y = r[1].lo; y <= r[1].hi; y++)
            for (int x = r[0].lo; x <= r[0].hi; x++)
                if (granule_is_active(g, level - finer, x, y, z) != first) return -1;
    return first;
}

/* Has any of them changed that elements `lo` to `hi` have a part of? */
static bool any_changed(const grids *g, const brick *b, int finer, int lo, int hi)
{
    granule_range r[3];
    if (finer > b->level) return false;
    granules_around(b->at, finer, lo, hi, r);
    for (int z = r[2].lo; z <= r[2].hi; z++)
        for (int y = r[1].lo; y <= r[1].hi; y++)
            for (int x = r[0].lo; x <= r[0].hi; x++)
                if (granule_has_changed(g, b->level - finer, x, y, z)) return true;
    return false;
}

bool mpm_interface_changed(const mpm *m, const brick *b)
{
    const grids *g = &m->grids;
    const int last = PATCH - 1 - FIRST;
    return any_changed(g, b, 0, -FIRST, last) || any_changed(g, b, 1, -FIRST, last) ||
           any_changed(g, b, 2, -2, BRICK - 1);
}

interface_nodes mpm_interface_nodes(const mpm *m, int level, const int at[3], uint8_t foreign[BRICK_CELLS])
{
    const grids *all = &m->grids;
    const grid_level *g = &all->level[level];
    interface_nodes s = { 0 };
    const int here = all_alike(all, level, 0, at), there = level > 0 ? all_alike(all, level, 1, at) : 0;
    memset(foreign, 0, BRICK_CELLS);
    if (here == 1 && there == 0) return s;
    const uint64_t exist = nodes_there(g, at, NODES_ALL), at_coarse = nodes_there(g, at, NODES_AT_COARSE);
    const element_patch active = patch_of(all, level, 0, at), left = inverse(&active);
    s.follow_coarser = any_beside(&left) & exist;
    s.lead_coarser = at_coarse & ~any_beside(&left) & any_near_coarse(&left);
    mark_octants(&left, foreign);
    if (level == 0) return s;
    const element_patch fine = patch_of(all, level, 1, at), own = inverse(&fine);
    /* a ghost lies a cell beyond the window, where the finer level has no node */
    const uint64_t inside = ~any_beside(&own) & nodes_there(g, at, NODES_NO_GHOSTS);
    s.lead_finer = any_near(&fine) & ~inside & exist;
    s.follow_finer = inside & any_near(&own); /* no point of this level reaches further in */
    mark_octants(&fine, foreign);
    if (level == 1 || !s.follow_finer) return s;
    const element_patch twice = patch_of(all, level, 2, at);
    s.twice_finer = s.follow_finer & any_beside(&twice);
    return s;
}

/* Takes the first of a brick's nodes out of the set: its cell, and the node. */
static int next_node(const brick *b, uint64_t *set, int node[3])
{
    const int c = __builtin_ctzll(*set);
    const int in[3] = { c % BRICK, c / BRICK % BRICK, c / (BRICK * BRICK) };
    for (int k = 0; k < 3; k++) node[k] = BRICK * b->at[k] + in[k];
    *set &= *set - 1;
    return c;
}

/* Makes the bricks of a level that hold these nodes. */
static status want_nodes(mpm *m, int group, int level, const node_box *r)
{
    for (int z = r->lo[2] / BRICK; z <= r->hi[2] / BRICK; z++)
        for (int y = r->lo[1] / BRICK; y <= r->hi[1] / BRICK; y++)
            for (int x = r->lo[0] / BRICK; x <= r->hi[0] / BRICK; x++) {
                int found;
                TRY(mpm_store_brick(m, group, level, (const int[3]){ x, y, z }, &found));
                m->bricks[found].wanted = true;
            }
    return status_ok();
}

status mpm_interface_want_bricks(mpm *m, int index)
{
    const brick b = m->bricks[index]; /* the array may move */
    for (uint64_t set = (b.interface.follow_coarser | b.interface.follow_finer) & b.reached; set;) {
        node_box n;
        const int cell = next_node(&b, &set, n.lo);
        memcpy(n.hi, n.lo, sizeof n.hi);
        const bool up = b.interface.follow_finer >> cell & 1;
        const node_box followed = up ? to_fine(&n) : to_coarse(&n);
        const int level = b.level + (up ? -1 : 1);
        const node_box there = existing(&m->grids.level[level], followed);
        if (!is_empty(&there)) TRY(want_nodes(m, b.group, level, &there));
    }
    return status_ok();
}

/* May another group have points in bricks that hold these nodes? */
static bool others_in(const mpm *m, int group, int level, const node_box *r)
{
    if (is_empty(r)) return false;
    for (int z = r->lo[2] / BRICK; z <= r->hi[2] / BRICK; z++)
        for (int y = r->lo[1] / BRICK; y <= r->hi[1] / BRICK; y++)
            for (int x = r->lo[0] / BRICK; x <= r->hi[0] / BRICK; x++)
                for (int f = 0; f < m->groups; f++) {
                    const int i = brick_at(m, f, level, (const int[3]){ x, y, z });
                    if (f != group && i >= 0 && m->bricks[i].covered) return true;
                }
    return false;
}

/* Constrained nodes lie up to two nodes of their level away from those that they depend on, here as in other groups. */
bool mpm_interface_in_contact(const mpm *m, const brick *b)
{
    enum { REACH = 6 };
    const grid_level *g = &m->grids.level[b->level], *coarser = level_at(m, b->level + 1),
                     *finer = level_at(m, b->level - 1);
    const node_box near = nodes_of(b->at, REACH), own = existing(g, near);
    if (m->arrivals && mpm_near_arrival(m, b, REACH)) return true;
    if (others_in(m, b->group, b->level, &own)) return true;
    if (coarser) {
        const node_box c = to_coarse(&near), there = existing(coarser, c);
        if (others_in(m, b->group, b->level + 1, &there)) return true;
    }
    if (finer) {
        const node_box f = to_fine(&near), there = existing(finer, f);
        if (others_in(m, b->group, b->level - 1, &there)) return true;
    }
    return false;
}

/* ---- a node of another level ---- */

static const brick *brick_with(const mpm *m, int group, int level, const int node[3])
{
    const int at[3] = { node[0] / BRICK, node[1] / BRICK, node[2] / BRICK };
    const int i = brick_at(m, group, level, at);
    return i >= 0 ? &m->bricks[i] : NULL;
}

static int cell_of(const int node[3])
{
    return cell_index(node[0] % BRICK, node[1] % BRICK, node[2] % BRICK);
}

/* ---- sums go to the nodes that are followed ---- */

/* Adds share x the sums of another level's node; `change` is that of the motion from there to here [m/s]. */
static void add_from(brick *b, int cell, const brick *from, int from_cell, double share, const double change[3],
                     double dt)
{
    const double *line = from->line[from_cell], *extra = from->line[BRICK_CELLS + from_cell];
    double *to = b->line[cell], *to_extra = b->line[BRICK_CELLS + cell];
    for (int i = 0; i < LINE; i++) to[i] += share * line[i];
    for (int k = 0; k < 3; k++) {
        to[1 + k] += share * line[0] * change[k];
        to[7] += share * (line[1 + k] + 0.5 * dt * line[4 + k]) * change[k];
    }
    if (!b->across || !from->across) return;
    for (int i = 0; i < LINE; i++) to_extra[i] += share * extra[i];
}

/* Sums of the node before or after one along axis k, NULL where its mass is not above `least`. */
static const double *line_beside(const mpm *m, const brick *b, int cell, int k, int way, double least)
{
    static const int stride[3] = { 1, BRICK, BRICK * BRICK }, step[3] = { 1, 3, 9 };
    const int place = cell / stride[k] % BRICK + way;
    const bool here = place >= 0 && place < BRICK;
    const int other = b->neighbour[SELF + way * step[k]];
    if (!here && (other < 0 || !m->bricks[other].line)) return NULL;
    const double *line =
        here ? b->line[cell + way * stride[k]] : m->bricks[other].line[cell - way * (BRICK - 1) * stride[k]];
    return line[0] > least ? line : NULL;
}

/* The mean of the differences on both sides, that of one side where the other is too light. */
void mpm_interface_slope(const mpm *m, const brick *b, int cell, int k, double least, double slope[3])
{
    const double *here = b->line[cell], *before = line_beside(m, b, cell, k, -1, least),
                 *after = line_beside(m, b, cell, k, 1, least);
    const double *lo = before ? before : here, *hi = after ? after : here;
    const double scale = before && after ? 0.5 : 1;
    for (int i = 0; i < 3; i++) slope[i] = scale * (hi[1 + i] / hi[0] - lo[1 + i] / lo[0]);
}

/* From a fine node to those of a coarse brick that it follows. */
static void hand_on(const mpm *m, const brick *from, int from_cell, const int f[3], brick *b)
{
    const node_box own = nodes_of(b->at, 0), one = { { f[0], f[1], f[2] }, { f[0], f[1], f[2] } };
    const node_box followed = to_coarse(&one), c = inside(followed, own.lo, own.hi);
    if (is_empty(&c)) return;
    double share = 1, slope[3][3] = { { 0 } };
    for (int k = 0; k < 3; k++)
        if (followed.lo[k] < followed.hi[k]) share *= 0.5, mpm_interface_slope(m, from, from_cell, k, 0, slope[k]);
    for (int z = c.lo[2]; z <= c.hi[2]; z++)
        for (int y = c.lo[1]; y <= c.hi[1]; y++)
            for (int x = c.lo[0]; x <= c.hi[0]; x++) {
                const int to[3] = { x, y, z };
                double change[3] = { 0 };
                for (int k = 0; k < 3; k++)
                    for (int i = 0; i < 3; i++) change[i] += to[k] > followed.lo[k] ? slope[k][i] : -slope[k][i];
                const int cell = cell_index(x - own.lo[0], y - own.lo[1], z - own.lo[2]);
                add_from(b, cell, from, from_cell, share, change, level_dt(m, from->level));
            }
}

/* Of the fine nodes around a coarse brick's those that follow them. */
static void receive_from_finer(const mpm *m, brick *b)
{
    const grid_level *finer = &m->grids.level[b->level - 1];
    node_box own = nodes_of(b->at, 0), r = to_fine(&own);
    for (int k = 0; k < 3; k++) r.lo[k]--, r.hi[k]++;
    r = existing(finer, r);
    for (int z = r.lo[2] / BRICK; z <= r.hi[2] / BRICK; z++)
        for (int y = r.lo[1] / BRICK; y <= r.hi[1] / BRICK; y++)
            for (int x = r.lo[0] / BRICK; x <= r.hi[0] / BRICK; x++) {
                const int i = brick_at(m, b->group, b->level - 1, (const int[3]){ x, y, z });
                if (i < 0) continue;
                const brick *from = &m->bricks[i];
                for (uint64_t set = from->interface.follow_coarser & nodes_in(from->at, &r); set;) {
                    int node[3];
                    const int cell = next_node(from, &set, node);
                    if (from->line[cell][0] > 0) hand_on(m, from, cell, node, b);
                }
            }
}

/* Of the coarse nodes those at a fine brick's that follow them. */
static void receive_from_coarser(const mpm *m, brick *b)
{
    static const double none[3] = { 0 };
    for (uint64_t set = b->interface.lead_coarser & mpm_substep_due(m, b); set;) {
        int node[3];
        const int cell = next_node(b, &set, node);
        const int c[3] = { 1 + node[0] / 2, 1 + node[1] / 2, 1 + node[2] / 2 };
        const brick *from = brick_with(m, b->group, b->level + 1, c);
        if (from && from->line[cell_of(c)][0] > 0) add_from(b, cell, from, cell_of(c), 1, none, 0);
    }
}

void mpm_interface_add_sums(mpm *m, int site)
{
    for (int f = 0; f < m->groups; f++) {
        const int i = brick_of_site(m, site, f);
        if (i < 0) continue;
        brick *b = &m->bricks[i];
        if (b->interface.lead_finer && b->level <= m->ends + 1) receive_from_finer(m, b);
        receive_from_coarser(m, b);
    }
}

/* ---- velocities come from them ---- */

static void add_node(double to[NODE], const mpm *m, const brick *b, int level, const int node[3], double share)
{
    const brick *from = brick_with(m, b->group, level, node);
    for (int i = 0; from && i < NODE; i++) to[i] += share * brick_nodes(m, from)[cell_of(node)][i];
}

static void follow_finer(const mpm *m, brick *b, int cell, const int node[3])
{
    const int f[3] = { 2 * node[0] - 1, 2 * node[1] - 1, 2 * node[2] - 1 };
    add_node(brick_nodes(m, b)[cell], m, b, b->level - 1, f, 1);
}

static void follow_coarser(const mpm *m, brick *b, int cell, const int node[3])
{
    const node_box f = { { node[0], node[1], node[2] }, { node[0], node[1], node[2] } };
    const node_box c = to_coarse(&f);
    double share = 1;
    for (int k = 0; k < 3; k++) share *= c.lo[k] < c.hi[k] ? 0.5 : 1;
    for (int z = c.lo[2]; z <= c.hi[2]; z++)
        for (int y = c.lo[1]; y <= c.hi[1]; y++)
            for (int x = c.lo[0]; x <= c.hi[0]; x++)
                add_node(brick_nodes(m, b)[cell], m, b, b->level + 1, (const int[3]){ x, y, z }, share);
}

void mpm_interface_constrain(mpm *m, int site)
{
    for (int f = 0; f < m->groups; f++) {
        const int i = brick_of_site(m, site, f);
        if (i < 0) continue;
        brick *b = &m->bricks[i];
        for (uint64_t set =
                 (b->interface.follow_finer | b->interface.follow_coarser) & mpm_substep_due(m, b) & b->reached;
             set;) {
            int node[3];
            const int cell = next_node(b, &set, node);
            memset(brick_nodes(m, b)[cell], 0, NODE * sizeof(double));
            if (!(b->line[cell][0] > 0)) continue;
            if (b->interface.follow_finer >> cell & 1)
                follow_finer(m, b, cell, node);
            else
                follow_coarser(m, b, cell, node);
        }
    }
}

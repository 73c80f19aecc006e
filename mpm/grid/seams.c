/* Where grids of two levels meet: nodes that follow the other level (grid.h).
 *
 * A fine node f on or beyond the face of its box, and a coarse node inside the box, are no freedoms of their own:
 *   v_f = sum_c P_fc v_c,   P the coarse hat functions at f's place: 1, or 1/2, 1/4, 1/8 of the two, four, eight nodes
 *   around it; v_c = v_f of the fine node at c's place.
 * What particles have given to such a node goes to those it follows with the same weights: m_c += P_fc m_f and likewise
 * force. Momentum is that of the motion at c's place, p_c += P_fc m_f [v_f + G_f (x_c - x_f)], G_f by differences of
 * the fine nodes around, as the particles' own gradient is in P2G; else a shear would be smoothed out at every step.
 * The energy goes with it,
 *   K_c += P_fc [K_f + (p_f + dt/2 f_f) . G_f (x_c - x_f)].
 * As sum_c P_fc = 1 and sum_c P_fc (x_c - x_f) = 0, mass, momentum and energy stay to rounding; a linear motion is
 * exact. A node that is followed follows nobody: boxes are far enough apart (grid.c, PAD).
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
static node_box to_coarse(const grid_level *fine, const node_box *f)
{
    node_box r;
    for (int k = 0; k < 3; k++)
        r.lo[k] = fine->lo[k] + half_down(f->lo[k] - 1), r.hi[k] = fine->lo[k] + half_down(f->hi[k]);
    return r;
}

static node_box to_fine(const grid_level *fine, const node_box *c)
{
    node_box r;
    for (int k = 0; k < 3; k++) r.lo[k] = 2 * (c->lo[k] - fine->lo[k]) + 1, r.hi[k] = 2 * (c->hi[k] - fine->lo[k]) + 1;
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

/* Nodes of a grid that exist: 0 .. last + 1. */
static node_box existing(const grid_level *g, node_box r)
{
    const int lo[3] = { 0 }, hi[3] = { g->axes[0].last + 1, g->axes[1].last + 1, g->axes[2].last + 1 };
    return inside(r, lo, hi);
}

/* ---- which nodes, which bricks ---- */

/* Nodes of a brick along one axis, a bit each. */
typedef struct {
    unsigned beyond;        /* on or beyond a seam of this level's box */
    unsigned in, rim, near; /* inside the finer level's box; next to a seam of it; inside, on or next to it outside */
    unsigned at, at_rim;    /* at the place of a coarser node that is inside this level's box; next to a seam */
    unsigned near_finest;   /* at the place of a finer node that is near the box of the level after that */
} axis_nodes;

static axis_nodes nodes_along(const grid_level *g, const grid_level *finer, const grid_level *finest, int k, int first)
{
    axis_nodes r = { 0 };
    for (int i = 0; i < BRICK; i++) {
        const int n = first + i, last = g->axes[k].last;
        const unsigned bit = 1u << i;
        if (n > last + 1) break;
        if ((g->seam[k][0] && n <= 1) || (g->seam[k][1] && n >= last)) r.beyond |= bit;
        if (n % 2 && n >= 1 + 2 * g->seam[k][0] && n <= last - 2 * g->seam[k][1]) r.at |= bit;
        if ((g->seam[k][0] && n == 3) || (g->seam[k][1] && n == last - 2)) r.at_rim |= bit;
        if (!finer) continue;
        const int lo = finer->lo[k], hi = finer->hi[k], below = finer->seam[k][0], above = finer->seam[k][1];
        if (n >= lo + below && n <= hi - above) r.in |= bit;
        if ((below && n == lo + 1) || (above && n == hi - 1)) r.rim |= bit;
        if (n >= lo - 1 && n <= hi + 1) r.near |= bit;
        const int there = 2 * (n - lo) + 1;
        if (finest && there >= finest->lo[k] - 1 && there <= finest->hi[k] + 1) r.near_finest |= bit;
    }
    return r;
}

static uint64_t all_of(unsigned x, unsigned y, unsigned z)
{
    uint64_t r = 0;
    for (int c = 0; c < BRICK_CELLS; c++)
        r |= (uint64_t)(x >> c % BRICK & y >> c / BRICK % BRICK & z >> c / (BRICK * BRICK) & 1) << c;
    return r;
}

static uint64_t any_of(unsigned x, unsigned y, unsigned z)
{
    return ~all_of(~x, ~y, ~z);
}

seam_nodes mpm_interface_nodes(const mpm *m, int level, const int at[3])
{
    const grid_level *g = &m->grids.level[level], *finer = level_at(m, level - 1), *finest = level_at(m, level - 2);
    axis_nodes a[3];
    for (int k = 0; k < 3; k++) a[k] = nodes_along(g, finer, finest, k, BRICK * at[k]);
    seam_nodes s;
    s.follow_coarser = any_of(a[0].beyond, a[1].beyond, a[2].beyond);
    s.follow_finer = all_of(a[0].in, a[1].in, a[2].in);
    s.lead_coarser = all_of(a[0].at, a[1].at, a[2].at) & any_of(a[0].at_rim, a[1].at_rim, a[2].at_rim);
    s.lead_finer = all_of(a[0].near, a[1].near, a[2].near) & ~s.follow_finer;
    s.follow_finer &= any_of(a[0].rim, a[1].rim, a[2].rim); /* no particle reaches further in */
    s.twice_finer = s.follow_finer & all_of(a[0].near_finest, a[1].near_finest, a[2].near_finest);
    return s;
}

static status make_bricks(mpm *m, int group, int level, const node_box *r)
{
    if (is_empty(r)) return status_ok();
    for (int z = r->lo[2] / BRICK; z <= r->hi[2] / BRICK; z++)
        for (int y = r->lo[1] / BRICK; y <= r->hi[1] / BRICK; y++)
            for (int x = r->lo[0] / BRICK; x <= r->hi[0] / BRICK; x++) {
                const int at[3] = { x, y, z };
                const seam_nodes s = mpm_interface_nodes(m, level, at);
                int found;
                if (seam_any(&s)) TRY(mpm_store_brick(m, group, level, at, &found));
            }
    return status_ok();
}

status mpm_interface_make_bricks(mpm *m, const brick *b)
{
    const node_box reach = nodes_of(b->at, 1); /* of its particles */
    const grid_level *g = &m->grids.level[b->level], *coarser = level_at(m, b->level + 1),
                     *finer = level_at(m, b->level - 1);
    if (coarser) {
        const node_box c = to_coarse(g, &reach), there = existing(coarser, c);
        TRY(make_bricks(m, b->group, b->level + 1, &there));
    }
    if (finer) {
        const node_box own = inside(reach, finer->lo, finer->hi), f = to_fine(finer, &own);
        if (!is_empty(&own)) TRY(make_bricks(m, b->group, b->level - 1, &f));
    }
    return status_ok();
}

/* Does another group have particles in bricks that hold these nodes? */
static bool others_in(const mpm *m, int group, int level, const node_box *r)
{
    if (is_empty(r)) return false;
    for (int z = r->lo[2] / BRICK; z <= r->hi[2] / BRICK; z++)
        for (int y = r->lo[1] / BRICK; y <= r->hi[1] / BRICK; y++)
            for (int x = r->lo[0] / BRICK; x <= r->hi[0] / BRICK; x++)
                for (int f = 0; f < m->groups; f++) {
                    const int i = brick_at(m, f, level, (const int[3]){ x, y, z });
                    if (f != group && i >= 0 && m->bricks[i].particles > 0) return true;
                }
    return false;
}

/* Nodes of particles in the brick are followed by, or follow, nodes up to two further of their level; so are the
 * others'. */
bool mpm_interface_in_contact(const mpm *m, const brick *b)
{
    enum { REACH = 6 };
    const grid_level *g = &m->grids.level[b->level], *coarser = level_at(m, b->level + 1),
                     *finer = level_at(m, b->level - 1);
    const node_box near = nodes_of(b->at, REACH), own = existing(g, near);
    if (others_in(m, b->group, b->level, &own)) return true;
    if (coarser) {
        const node_box c = to_coarse(g, &near), there = existing(coarser, c);
        if (others_in(m, b->group, b->level + 1, &there)) return true;
    }
    if (finer) {
        const node_box f = to_fine(finer, &near), there = existing(finer, f);
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

/* Takes the first of a brick's nodes out of the set: its cell, and the node. */
static int next_node(const brick *b, uint64_t *set, int node[3])
{
    const int c = __builtin_ctzll(*set);
    const int in[3] = { c % BRICK, c / BRICK % BRICK, c / (BRICK * BRICK) };
    for (int k = 0; k < 3; k++) node[k] = BRICK * b->at[k] + in[k];
    *set &= *set - 1;
    return c;
}

/* ---- sums go to the nodes that are followed ---- */

/* Adds share x the sums of another level's node, which lies `off` from this one; `change` is that of the motion from
 * there to here [m/s]. */
static void add_from(brick *b, int cell, const brick *from, int from_cell, double share, const double off[3],
                     const double change[3], double dt)
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
    for (int k = 0; k < 3; k++) to_extra[3 + k] += share * line[0] * off[k];
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
    const grid_level *g = &m->grids.level[b->level], *finer = g - 1;
    const node_box own = nodes_of(b->at, 0), one = { { f[0], f[1], f[2] }, { f[0], f[1], f[2] } };
    const node_box followed = to_coarse(finer, &one), c = inside(followed, own.lo, own.hi);
    if (is_empty(&c)) return;
    double share = 1, slope[3][3] = { { 0 } };
    for (int k = 0; k < 3; k++)
        if (followed.lo[k] < followed.hi[k]) share *= 0.5, mpm_interface_slope(m, from, from_cell, k, 0, slope[k]);
    for (int z = c.lo[2]; z <= c.hi[2]; z++)
        for (int y = c.lo[1]; y <= c.hi[1]; y++)
            for (int x = c.lo[0]; x <= c.hi[0]; x++) {
                const int to[3] = { x, y, z };
                double off[3], change[3] = { 0 };
                for (int k = 0; k < 3; k++) {
                    off[k] = finer->axes[k].node[f[k]] - g->axes[k].node[to[k]];
                    for (int i = 0; i < 3; i++) change[i] += to[k] > followed.lo[k] ? slope[k][i] : -slope[k][i];
                }
                const int cell = cell_index(x - own.lo[0], y - own.lo[1], z - own.lo[2]);
                add_from(b, cell, from, from_cell, share, off, change, level_dt(m, from->level));
            }
}

/* Of the fine nodes around a coarse brick's those that follow them. */
static void receive_from_finer(const mpm *m, brick *b)
{
    const grid_level *finer = &m->grids.level[b->level - 1];
    node_box own = nodes_of(b->at, 0), r = to_fine(finer, &own);
    for (int k = 0; k < 3; k++) r.lo[k]--, r.hi[k]++;
    r = existing(finer, r);
    for (int z = r.lo[2] / BRICK; z <= r.hi[2] / BRICK; z++)
        for (int y = r.lo[1] / BRICK; y <= r.hi[1] / BRICK; y++)
            for (int x = r.lo[0] / BRICK; x <= r.hi[0] / BRICK; x++) {
                const int i = brick_at(m, b->group, b->level - 1, (const int[3]){ x, y, z });
                if (i < 0) continue;
                const brick *from = &m->bricks[i];
                for (uint64_t set = from->seam.follow_coarser; set;) {
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
    const grid_level *g = &m->grids.level[b->level];
    for (uint64_t set = b->seam.lead_coarser & mpm_substep_due(m, b); set;) {
        int node[3];
        const int cell = next_node(b, &set, node);
        const int c[3] = { g->lo[0] + node[0] / 2, g->lo[1] + node[1] / 2, g->lo[2] + node[2] / 2 };
        const brick *from = brick_with(m, b->group, b->level + 1, c);
        if (from && from->line[cell_of(c)][0] > 0) add_from(b, cell, from, cell_of(c), 1, none, none, 0);
    }
}

void mpm_interface_add_sums(mpm *m, int site)
{
    for (int f = 0; f < m->groups; f++) {
        const int i = m->directory[f * m->grids.sites + site];
        if (i < 0) continue;
        brick *b = &m->bricks[i];
        if (b->seam.lead_finer && b->level <= m->ends + 1) receive_from_finer(m, b);
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
    const grid_level *finer = &m->grids.level[b->level - 1];
    const int f[3] = { 2 * (node[0] - finer->lo[0]) + 1, 2 * (node[1] - finer->lo[1]) + 1,
                       2 * (node[2] - finer->lo[2]) + 1 };
    add_node(brick_nodes(m, b)[cell], m, b, b->level - 1, f, 1);
}

static void follow_coarser(const mpm *m, brick *b, int cell, const int node[3])
{
    const node_box f = { { node[0], node[1], node[2] }, { node[0], node[1], node[2] } };
    const node_box c = to_coarse(&m->grids.level[b->level], &f);
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
        const int i = m->directory[f * m->grids.sites + site];
        if (i < 0) continue;
        brick *b = &m->bricks[i];
        for (uint64_t set = (b->seam.follow_finer | b->seam.follow_coarser) & mpm_substep_due(m, b); set;) {
            int node[3];
            const int cell = next_node(b, &set, node);
            memset(brick_nodes(m, b)[cell], 0, NODE * sizeof(double));
            if (!(b->line[cell][0] > 0)) continue;
            if (b->seam.follow_finer >> cell & 1)
                follow_finer(m, b, cell, node);
            else
                follow_coarser(m, b, cell, node);
        }
    }
}

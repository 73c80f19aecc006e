/* SPDX-License-Identifier: BSD-3-Clause */
/* The grid phase at one site: sums of all bricks that reach its nodes, momentum update, boundaries, contact (M-6).
 *
 *   m dv/dt = f;   what the mixing of point velocities and the contacts take from the kinetic energy stays at the
 *   node as heat and goes to the points in G2P:  E_i = v_i^2/2 + Q_i/m_i.  So does the work of the forces on the
 *   velocities before them, dt/2 f . v, less what the points had booked of it (p2g.c); that on those after them is
 *   the points'. */
#include "mpm/grid/face_depth.h"
#include "mpm/kernel/kernels.h"
#include "mpm/law/contact.h"
#include "mpm/memory/cavities.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef double node_lines[BRICK_CELLS][LINE] __attribute__((aligned(64)));

typedef struct {
    brick *brick;
    double (*line)[LINE];  /* [64] m, p, f, K; borrowed */
    double (*extra)[LINE]; /* [64] V grad S, m (x_p - x_i), m flow stress, m effusivity */
} group_nodes;

/* One node of one group while it is worked on. */
typedef struct {
    double m, v[3], f[3], heat;
    double v_start[3];  /* before the forces, after the walls [m/s] */
    double absorbed[3]; /* impulse of absorbing boundaries [N s] */
    bool held[3];       /* components that a wall holds in this turn, */
    double hold[3];     /* at which velocity [m/s] */
    const double *extra;
} node_state;

/* Nodes of a brick that the points of its neighbour at a step reach: a box, where the neighbour has its sums of
 * them, and its cells whose points those are. */
typedef struct {
    int first[3], count[3], there;
    uint64_t cells;
} shared_box;

#define FIRST_OF(d) ((d) > 0 ? BRICK - 1 : 0)
#define COUNT_OF(d) ((d) == 0 ? BRICK : 1)
#define THERE_OF(d) ((d) > 0 ? 0 : (d) < 0 ? HALO - 1 : 1)
#define CELLS_OF(d, before, after) ((d) < 0 ? (before) : (d) > 0 ? (after) : ~0ull)
#define SHARED_BOX(x, y, z)                                                                                \
    {                                                                                                      \
        { FIRST_OF(x), FIRST_OF(y), FIRST_OF(z) }, { COUNT_OF(x), COUNT_OF(y), COUNT_OF(z) },              \
            HALO_PLACE(THERE_OF(x), THERE_OF(y), THERE_OF(z)),                                             \
            CELLS_OF(x, 0x8888888888888888, 0x1111111111111111) &                                          \
                CELLS_OF(y, 0xf000f000f000f000, 0x000f000f000f000f) & CELLS_OF(z, 0xffffull << 48, 0xffff) \
    }
#define SHARED_ROW(y, z) SHARED_BOX(-1, y, z), SHARED_BOX(0, y, z), SHARED_BOX(1, y, z)
#define SHARED_PLANE(z) SHARED_ROW(-1, z), SHARED_ROW(0, z), SHARED_ROW(1, z)
static const shared_box shared_boxes[NEIGHBOURS] = { SHARED_PLANE(-1), SHARED_PLANE(0), SHARED_PLANE(1) };

static void add_lines(double (*to)[LINE], double (*const out)[LINE], const shared_box *b)
{
    double(*from)[LINE] = &out[b->there];
    for (int k = 0; k < b->count[2]; k++)
        for (int j = 0; j < b->count[1]; j++)
            for (int i = 0; i < b->count[0]; i++, from++) {
                double *a = to[cell_index(b->first[0] + i, b->first[1] + j, b->first[2] + k)];
                for (int q = 0; q < LINE; q += WIDTH) vd_store(a + q, vd_load(a + q) + vd_load(*from + q));
            }
}

static void prefetch_lines(double (*const out)[LINE], const shared_box *b)
{
    for (int i = 0; i < b->count[0] * b->count[1] * b->count[2]; i++) __builtin_prefetch(out[b->there + i]);
}

/* Ghosts of a mirror: their sums are folded back already (p2g.c), their velocities are made in G2P. */
static void clear_ghosts(const mpm *m, const brick *b, double (*line)[LINE])
{
    for (int k = 0; k < 3; k++)
        for (int side = 0; side < 2; side++) {
            const int ghost = (side ? axes_of(m, b)[k].last + 1 : 0) - BRICK * b->at[k];
            if (ghost < 0 || ghost >= BRICK || !is_mirror(m, b, k, side)) continue;
            for (int i = 0; i < BRICK * BRICK; i++) {
                int at[3];
                at[k] = ghost, at[(k + 1) % 3] = i % BRICK, at[(k + 2) % 3] = i / BRICK;
                memset(line[cell_index(at[0], at[1], at[2])], 0, sizeof *line);
            }
        }
}

/* All sums are asked for before any is added: most come from another core's cache or from memory. */
static bool gather_group(const mpm *m, const brick *b, bool with_contact, const group_nodes *n)
{
    const brick *from[NEIGHBOURS];
    const shared_box *box[NEIGHBOURS];
    bool meets[NEIGHBOURS];
    int count = 0;
    for (int step = 0; step < NEIGHBOURS; step++) {
        if (b->neighbour[step] < 0) continue;
        from[count] = &m->bricks[b->neighbour[step]];
        box[count] = &shared_boxes[step];
        const uint64_t near = from[count]->occupied & box[count]->cells;
        if (!near) continue;
        meets[count] = with_contact && from[count]->meets & near;
        prefetch_lines(from[count]->out, box[count]);
        if (meets[count]) prefetch_lines(from[count]->out_contact, box[count]);
        count++;
    }
    memset(n->line, 0, sizeof(node_lines));
    if (with_contact) memset(n->extra, 0, sizeof(node_lines));
    for (int i = 0; i < count; i++) {
        add_lines(n->line, from[i]->out, box[i]);
        if (meets[i]) add_lines(n->extra, from[i]->out_contact, box[i]);
    }
    clear_ghosts(m, b, n->line);
    return count > 0;
}

static group_nodes interface_lines(brick *b)
{
    return (group_nodes){ b, b->line, b->line + BRICK_CELLS };
}

void ISA(gather)(mpm *m, int site)
{
    for (int f = 0; f < m->groups; f++) {
        const int i = brick_of_site(m, site, f);
        if (i < 0) continue;
        brick *b = &m->bricks[i];
        const group_nodes n = interface_lines(b);
        if (b->level <= m->begins) gather_group(m, b, b->across, &n);
    }
}

static bool has_mass(double (*const line)[LINE])
{
    for (int i = 0; i < BRICK_CELLS; i++)
        if (line[i][0] > 0) return true;
    return false;
}

/* ---- boundaries ---- */

typedef struct {
    mpm_boundary_kind kind;
    int axis, end; /* end: 0 the lower, 1 the upper */
    double size;   /* of the element beside the boundary [m] */
    const double *velocity;
    bool arrives; /* group_info.arrives: it acts as a contact */
} wall;

static int walls_at(const mpm *m, const axis axes[3], const int index[3], int group, wall w[3])
{
    int n = 0;
    for (int k = 0; k < 3; k++) {
        const axis *a = &axes[k];
        const int hi = index[k] >= a->last;
        if (index[k] > 1 && !hi) continue;
        const mpm_axis *s = &m->scene.axis[k];
        if (m->group[group].passes[2 * k + hi]) continue;
        if (s->boundary[hi] == MPM_BOUNDARY_FREE) continue;
        w[n++] = (wall){ .kind = s->boundary[hi],
                         .axis = k,
                         .end = hi,
                         .size = hi ? axis_left(a, a->last) : axis_right(a, 1),
                         .velocity = s->boundary_velocity[hi],
                         .arrives = m->group[group].arrives[2 * k + hi] };
    }
    return n;
}

/* A group at a node, and the walls that act on it there. */
typedef struct {
    brick *brick;
    node_state state;
    wall walls[3];
    int n_walls;
} node_side;

static bool is_held(const mpm *m, const node_side *s)
{
    return m->group[s->brick->group].held;
}

/* Where a wall acts on a group's node, and what books it. */
typedef struct {
    const mpm *m;
    const brick *brick;
    int cell;
    double dt; /* [s] */
    tally *sum;
} wall_place;

/* A wall gives component k its velocity.  Where several do, at an edge of the window, the last one counts. */
static void wall_hold(node_state *n, int k, double velocity)
{
    n->held[k] = true;
    n->hold[k] = velocity;
}

/* What the mixing with the walls takes is heat, their reaction's work is booked. */
static void take_holds(node_state *n, double dt, tally *sum)
{
    for (int k = 0; k < 3; k++) {
        if (!n->held[k]) continue;
        const double change = n->hold[k] - n->v[k], J = n->m * change - dt * n->f[k];
        sum->impulse_boundary[k] += J;
        sum->work_boundary += J * n->hold[k];
        n->heat += 0.5 * n->m * change * change;
        n->v[k] = n->hold[k];
        n->f[k] = 0;
        n->held[k] = false;
    }
}

/* What goes on beyond an absorbing end. */
typedef struct {
    double p, s;  /* speeds of pressure and of shear waves [m/s] */
    double start; /* pressure over density at the start [m2/s2] */
} end_matter;

static end_matter matter_of(const law *k)
{
    return (end_matter){ sqrt((k->K0 + 4.0 / 3.0 * k->G) / k->rho0), sqrt(k->G / k->rho0), k->p_start / k->rho_start };
}

typedef struct {
    end_matter of; /* times mass */
    double mass;
} matter_sums;

static void add_chain(const mpm *m, int head, matter_sums *sum)
{
    for (int i = head; i >= 0; i = m->links[i].next) {
        const end_matter of = matter_of(&m->laws[m->links[i].body]);
        for (int l = 0; l < LANES; l++) {
            const double more = m->blocks[i].mass[0][l];
            sum->mass += more, sum->of.p += more * of.p, sum->of.s += more * of.s, sum->of.start += more * of.start;
        }
    }
}

/* First block of one of the 27 cells around a brick's cell, -1: none. */
static int head_beside(const mpm *m, const brick *b, int cell, int which)
{
    int at[3], step = 0;
    for (int k = 0, scale = 1; k < 3; k++, scale *= 3, which /= 3) {
        const int i = (cell >> 2 * k) % BRICK + which % 3 - 1;
        at[k] = (i + BRICK) % BRICK;
        step += scale * (i < 0 ? 0 : i < BRICK ? 1 : 2);
    }
    return b->neighbour[step] < 0 ? -1 : m->bricks[b->neighbour[step]].head[cell_index(at[0], at[1], at[2])];
}

/* At a node of a group with several materials: means by mass over the points of the node's own cell, of those around
 * it where it has none. */
static end_matter matter_at(const mpm *m, const brick *b, int cell)
{
    matter_sums sum = { .mass = 0 };
    if (!m->group[b->group].mixed) return matter_of(group_law(m, b->group));
    add_chain(m, b->head[cell], &sum);
    for (int i = 0; i < NEIGHBOURS && b->head[cell] < 0; i++) add_chain(m, head_beside(m, b, cell, i), &sum);
    if (!(sum.mass > 0)) return matter_of(group_law(m, b->group));
    return (end_matter){ sum.of.p / sum.mass, sum.of.s / sum.mass, sum.of.start / sum.mass };
}

#define BOUNDARY_ACTS
#include "mpm/law/boundary.def"
#undef BOUNDARY_ACTS

typedef enum { BOUNDARY_ONCE, BOUNDARY_AGAIN } wall_turn;

/* The walls at a node, before the forces (BOUNDARY_ONCE) or after a contact.  A held group stays at rest, whatever they
 * say. */
static void apply_walls(const mpm *m, node_side *side, int cell, wall_turn turn, double dt, tally *sum)
{
    node_state *n = &side->state;
    const wall_place at = { m, side->brick, cell, dt, sum };
    for (int k = 0; k < 3 && is_held(m, side) && turn == BOUNDARY_ONCE; k++) wall_hold(n, k, 0);
    for (int i = 0; i < side->n_walls && !is_held(m, side); i++) {
        const wall *w = &side->walls[i];
        if (w->arrives) continue; /* touch_wall */
#define BOUNDARY(PLACE, name, after, text) \
    if (w->kind == MPM_BOUNDARY_##PLACE && (after) >= turn) boundary_##name(n, w, &at);
#include "mpm/law/boundary.def"
    }
    take_holds(n, dt, sum);
}

/* ---- contact of two groups at a node ---- */

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

typedef struct {
    const double *h;
    const wall *walls;
    int wall_count;
    double dt; /* [s] */
} node_place;

/* A plane across n at a node. */
typedef struct {
    double width;   /* of the cell along n [m] */
    double part[3]; /* |n_k h_k| over it [1] */
} face;

/* The quadratic spline, w = 3/4 - d^2 within half a cell, (3/2 - |d|)^2/2 beyond. */
static double depth_bspline(double r)
{
    if (r < 1.0 / 3) return 3 * r - 1.5;
    double d = fmin(r - 2.0 / 3, 1.4);
    for (int i = 0; i < 6; i++) {
        const double e = 1.5 - d, w = d < 0.5 ? 0.75 - d * d : 0.5 * e * e, slope = d < 0.5 ? -2 * d : -e;
        const double F = d < 0.5 ? 0.5 + 0.75 * d - d * d * d / 3 : 1 - e * e * e / 6;
        d += (r - F / w) / (1 - F * slope / (w * w));
        d = fmax(fmin(d, 1.49), -0.6);
    }
    return d;
}

/* Depth of the node below the face of a side whose outward normal is `out` times n, in widths of the cell along n. */
static double depth_of(const mpm *m, const node_state *s, double out, const contact_touch *t, const face *of)
{
    const double area = out * dot(t->n, s->extra) * of->width, V = s->extra[3];
    const bool bspline = m->scene.basis == MPM_BASIS_BSPLINE;
    if (!(area > 1e-6 * V)) return bspline ? 1.5 : of->part[0] + of->part[1] + of->part[2]; /* no face at the node */
    return bspline ? depth_bspline(V / area) : face_depth(m->depths, of->part, V / area);
}

/* The normal is the volume gradient of one side alone, `of` (mpm_pair.normal_of): behind the edge of the other a
 * difference of gradients tilts and reads sliding as approach.  Where that side has no surface at the node (deep
 * overlap) the difference must serve.  False: they do not touch. */
static bool geometry(const mpm *m, const node_state *a, const node_state *b, bool of_b, const node_place *at,
                     contact_touch *t)
{
    const double *h = at->h;
    const node_state *one = of_b ? b : a;
    double d[3];
    for (int k = 0; k < 3; k++) d[k] = of_b ? -one->extra[k] : one->extra[k];
    const double smallest = fmin(h[0], fmin(h[1], h[2]));
    if (sqrt(dot(d, d)) * smallest < 0.05 * one->extra[3])
        for (int k = 0; k < 3; k++) d[k] = a->extra[k] - b->extra[k];
    for (int i = 0; i < at->wall_count; i++)
        if (at->walls[i].kind == MPM_BOUNDARY_SYMMETRY) d[at->walls[i].axis] = 0;
    const double length = sqrt(dot(d, d));
    if (!(length > 0)) return false;
    face of;
    for (int k = 0; k < 3; k++) t->n[k] = d[k] / length, of.part[k] = fabs(t->n[k] * h[k]);
    of.width = sqrt(dot(of.part, of.part));
    for (int k = 0; k < 3; k++) of.part[k] /= of.width;
    const double area[2] = { dot(t->n, a->extra), -dot(t->n, b->extra) };
    t->area = fmax((b->m * area[0] + a->m * area[1]) / (a->m + b->m), 0); /* the lighter side's counts */
    t->shear = fmin(a->extra[6] / a->m, b->extra[6] / b->m) / sqrt(3);
    t->width = of.width;
    t->gap = -of.width * (depth_of(m, a, 1, t, &of) + depth_of(m, b, -1, t, &of));
    return true;
}

static double kinetic(const node_state *n)
{
    return 0.5 * n->m * dot(n->v, n->v);
}

/* At a node, the mean by mass where the group has several materials. */
static double effusivity_at(const mpm *m, const node_side *s)
{
    const group_info *g = &m->group[s->brick->group];
    return g->mixed ? s->state.extra[7] / s->state.m : m->effusivity[g->first];
}

/* Share of the contact heat that goes to a: by effusivity sqrt(k rho c) where both are known, else half; a held body,
 * which may sleep for good, takes none. */
static double heat_share(const mpm *m, const node_side *a, const node_side *b)
{
    if (is_held(m, a) || is_held(m, b)) return is_held(m, b);
    const double e[2] = { effusivity_at(m, a), effusivity_at(m, b) };
    return isnan(e[0]) || isnan(e[1]) ? 0.5 : e[0] / (e[0] + e[1]);
}

/* Two groups that touch at a node: J is the impulse on b, minus it that on a. */
typedef struct {
    node_side *a, *b;
    double J[3]; /* [N s] */
} touching;

#define CONTACT_IMPULSE
#include "mpm/law/contact.def"
#undef CONTACT_IMPULSE

static bool impulse(const touch_rule *rule, const contact_touch *t, double J[3])
{
#define CONTACT_BEGIN(name, text) \
    if (rule->law == CONTACT_##name) return contact_##name(rule->value, t, J);
#include "mpm/law/contact.def"
    return false;
}

/* What a pair is at a node before any contact acts there; false: no face. */
static bool record_of(const mpm *m, const node_side *a, const node_side *b, const node_place *at, touch_node *r)
{
    const node_state *p = &a->state, *q = &b->state;
    const touch_rule *rule = touch_rule_of(m, a->brick->group, b->brick->group);
    const bool held[2] = { is_held(m, a), is_held(m, b) };
    contact_touch c = { .dt = at->dt };
    if (held[0] && held[1]) return false;
    if (!geometry(m, p, q, rule->normal_of_higher, at, &c)) return false;
    *r = (touch_node){ .group = { a->brick->group, b->brick->group },
                       .area = c.area,
                       .gap = c.gap,
                       .width = c.width,
                       .shear = c.shear,
                       .reduced = held[0]   ? q->m
                                  : held[1] ? p->m
                                            : p->m * q->m / (p->m + q->m) };
    double along[3];
    for (int k = 0; k < 3; k++) {
        r->n[k] = c.n[k], r->apart[k] = q->v[k] - p->v[k];
        along[k] = fabs(c.n[k] * (p->extra[k] - q->extra[k]));
        if (along[k] > along[r->along]) r->along = k;
    }
    return true;
}

/* A pair's record at a node of a site, NULL: none in this step. */
static const touch_node *record_at(const mpm *m, const touch_site *t, int cell, const int group[2])
{
    if (t->step != m->substeps) return NULL;
    for (int i = t->first[cell]; i < t->first[cell + 1]; i++)
        if (t->node[i].group[0] == group[0] && t->node[i].group[1] == group[1]) return &t->node[i];
    return NULL;
}

/* The same one node on along axis k. */
static const touch_node *record_beside(const mpm *m, const brick *b, int cell, int k, int way, const int group[2])
{
    static const int stride[3] = { 1, BRICK, BRICK * BRICK }, step[3] = { 1, 3, 9 };
    const int place = cell / stride[k] % BRICK + way;
    if (place >= 0 && place < BRICK)
        return record_at(m, &m->touch[grids_place(&m->grids, b->level, b->at)], cell + way * stride[k], group);
    const int other = b->neighbour[SELF + way * step[k]];
    if (other < 0) return NULL;
    const int site = grids_place(&m->grids, b->level, m->bricks[other].at);
    return record_at(m, &m->touch[site], cell - way * (BRICK - 1) * stride[k], group);
}

/* Adds a node to the face's mean, by the part of the face that belongs to it. */
typedef struct {
    double area, compliance, gap, n[3], apart[3]; /* sums of A, A^2/m, A g, A n, A (v_b - v_a) */
} face_sums;

static void add_record(face_sums *f, const touch_node *r, const double apart[3])
{
    f->area += r->area;
    f->compliance += r->area * r->area / r->reduced;
    f->gap += r->area * r->gap;
    for (int k = 0; k < 3; k++) f->n[k] += r->area * r->n[k], f->apart[k] += r->area * apart[k];
}

/* The face that a node has a part of passes between nodes: its motion is the mean of theirs by their parts A of it, and
 * one pressure acts on it, whose part at the node is as A.  So each body's forces at its nodes are balanced one by one,
 * at a node of little mass too, and what a body does behind its own face is its own.  Nodes before and after along the
 * axis that is nearest to the normal count.  `apart` at this node as it is now; a node may be in several pairs. */
static bool face_at(const mpm *m, const brick *b, int cell, const touch_node *r, const double apart[3],
                    contact_touch *t)
{
    face_sums f = { .area = 0 };
    const int along = r->along;
    if (!(r->area > 0)) return false;
    add_record(&f, r, apart);
    for (int way = -1; way <= 1; way += 2) {
        const touch_node *q = record_beside(m, b, cell, along, way, r->group);
        if (q && q->area > 0 && dot(q->n, r->n) > 0.5) add_record(&f, q, q->apart);
    }
    const double length = sqrt(dot(f.n, f.n));
    for (int k = 0; k < 3; k++) t->n[k] = f.n[k] / length, t->apart[k] = f.apart[k] / f.area;
    t->gap = f.gap / f.area;
    t->width = r->width, t->shear = r->shear, t->area = r->area;
    t->reduced = r->area * f.area / f.compliance;
    return true;
}

/* Sets the pair's velocities and its J; false where the two do not touch. */
static bool contact_pair(const mpm *m, touching *t, int cell, const touch_node *r, double dt, tally *sum)
{
    node_state *a = &t->a->state, *b = &t->b->state;
    const touch_rule *rule = touch_rule_of(m, t->a->brick->group, t->b->brick->group);
    const bool held[2] = { is_held(m, t->a), is_held(m, t->b) };
    contact_touch c = { .dt = dt };
    double apart[3];
    for (int k = 0; k < 3; k++) apart[k] = b->v[k] - a->v[k];
    if (!face_at(m, t->a->brick, cell, r, apart, &c) || !impulse(rule, &c, t->J)) return false;
    for (int k = 0; k < 3; k++) {
        if (held[0])
            sum->impulse_boundary[k] += t->J[k]; /* what holds it gives it back */
        else
            a->v[k] -= t->J[k] / a->m;
        if (held[1])
            sum->impulse_boundary[k] -= t->J[k];
        else
            b->v[k] += t->J[k] / b->m;
        t->a->brick->contact_impulse[k] -= t->J[k];
        t->b->brick->contact_impulse[k] += t->J[k];
    }
    return true;
}

/* What a contact takes from the kinetic energy over the step, forces included, is
 *   Q = -J . (v_b - v_a), the mean of that difference before the forces and at the end of the step.
 * The drop of kinetic energy across the contact alone would count the approach that the forces have just made and the
 * contact takes back: heat from bodies that only press on each other. */
static void contact_heat(const mpm *m, const touching *t, tally *sum)
{
    node_state *a = &t->a->state, *b = &t->b->state;
    double Q = 0;
    for (int k = 0; k < 3; k++) {
        const double slip = b->v[k] - a->v[k], slip_start = b->v_start[k] - a->v_start[k];
        Q -= t->J[k] * 0.5 * (slip + slip_start);
    }
    const double share = heat_share(m, t->a, t->b);
    a->heat += share * Q;
    b->heat += (1 - share) * Q;
    sum->heat_friction += Q;
}

/* ---- one node ---- */

static void finish_node(const node_state *n, double node[NODE], tally *sum)
{
    for (int k = 0; k < 3; k++) sum->work_boundary += 0.5 * n->absorbed[k] * (n->v_start[k] + n->v[k]);
    for (int k = 0; k < 3; k++) node[k] = n->v[k];
    node[3] = 0.5 * dot(n->v, n->v) + n->heat / n->m;
}

/* The group's part of the node before any contact: walls, then the forces; gas: pressure of a cavity (mpm/cavity.h). */
static void begin_side(const mpm *m, const group_nodes *group, int cell, const int index[3], double dt, double gas,
                       node_side *side, tally *sum)
{
    const double *line = group->line[cell];
    node_state *n = &side->state;
    side->brick = group->brick;
    *n = (node_state){ .m = line[0], .extra = group->extra[cell] };
    for (int k = 0; k < 3; k++) n->v[k] = line[1 + k] / n->m, n->f[k] = line[4 + k];
    n->heat = line[7] - kinetic(n);
    for (int k = 0; k < 3 && gas != 0; k++) {
        n->f[k] -= gas * n->extra[k];
        sum->impulse_external[k] -= dt * gas * n->extra[k];
    }
    side->n_walls = walls_at(m, axes_of(m, side->brick), index, side->brick->group, side->walls);
    apply_walls(m, side, cell, BOUNDARY_ONCE, dt, sum);
    memcpy(n->v_start, n->v, sizeof n->v_start);
    n->heat -= 0.5 * dt * dot(line + 4, n->v);
    for (int k = 0; k < 3; k++) n->v[k] += dt * n->f[k] / n->m, n->f[k] = 0;
}

/* Memory of a thread for the groups at a site: `groups` of all but pair, which has one for every two. */
typedef struct {
    node_lines (*own)[2];
    group_nodes *group;
    node_side *side;
    touching *pair;
    int gas;       /* 1 + the cavity that the node lies at, 0: none */
    double *swept; /* [cavities] volume that the site's nodes make [m3] */
} scratch;

static size_t whole_lines(size_t bytes)
{
    return (bytes + 63) / 64 * 64;
}

size_t ISA(node_bytes)(int groups)
{
    const size_t n = (size_t)groups;
    return whole_lines(n * sizeof(node_lines[2])) + whole_lines(n * sizeof(group_nodes)) +
           whole_lines(n * sizeof(node_side)) + whole_lines(n * (n - 1) / 2 * sizeof(touching));
}

static scratch scratch_of(const mpm *m, int thread)
{
    const size_t n = (size_t)m->scratch_groups;
    char *p = m->scratch + (size_t)thread * m->scratch_bytes;
    scratch s = { .own = (void *)p };
    s.group = (void *)(p += whole_lines(n * sizeof(node_lines[2])));
    s.side = (void *)(p += whole_lines(n * sizeof(group_nodes)));
    s.pair = (void *)(p + whole_lines(n * sizeof(node_side)));
    return s;
}

/* What the node's motion adds to the void around it: its gas does p times that in work [m3]. */
static double volume_made(const node_state *n, double dt)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum -= 0.5 * dt * n->extra[k] * (n->v_start[k] + n->v[k]);
    return sum;
}

/* A wall that the group came to, after its forces: once the gap to it is closed the group does not go on, and may
 * leave.  A mirror lets it slide, others take it with them. */
static void touch_wall(node_side *side, const wall *w, double dt, tally *sum)
{
    node_state *n = &side->state;
    const double area = (w->end ? 1 : -1) * n->extra[w->axis] * w->size, V = n->extra[3];
    const bool rough = w->kind != MPM_BOUNDARY_SYMMETRY;
    static const double at_rest[3] = { 0 };
    const double *moving = w->kind == MPM_BOUNDARY_PRESCRIBED ? w->velocity : at_rest;
    contact_touch t = { .width = w->size, .dt = dt, .reduced = n->m };
    if (!(area > 0)) return;
    t.n[w->axis] = w->end ? 1 : -1;
    t.gap = -w->size * face_depth_aligned(V / area);
    for (int k = 0; k < 3; k++) t.apart[k] = moving[k] - n->v[k];
    const double closing = contact_closing(&t), left = closing - dot(t.apart, t.n);
    if (!(closing < 0)) return;
    for (int k = 0; k < 3; k++) {
        const double change = k == w->axis || rough ? t.apart[k] + left * t.n[k] : 0;
        n->v[k] += change;
        n->heat -= n->m * change * (0.5 * (n->v_start[k] + n->v[k]) - moving[k]);
        sum->impulse_boundary[k] += n->m * change;
        sum->work_boundary += n->m * change * moving[k];
    }
}

static void touch_walls(const mpm *m, node_side *side, double dt, tally *sum)
{
    for (int i = 0; i < side->n_walls && !is_held(m, side); i++)
        if (side->walls[i].arrives) touch_wall(side, &side->walls[i], dt, sum);
}

/* The last of a group at a node: walls that act again, what is booked, the node itself. */
static void end_side(mpm *m, node_side *side, int cell, bool again, int gas, double *swept, double dt, tally *sum)
{
    if (again) apply_walls(m, side, cell, BOUNDARY_AGAIN, dt, sum);
    if (gas) swept[gas - 1] += volume_made(&side->state, dt);
    finish_node(&side->state, brick_nodes(m, side->brick)[cell], sum);
}

/* Room for more records and trials of a site. */
static bool reserve_touch(touch_site *t, int records, int trials)
{
    if (t->count + records > t->capacity) {
        const int capacity = 2 * t->capacity + records + 16;
        touch_node *node = realloc(t->node, (size_t)capacity * sizeof *node);
        if (!node) return false;
        t->node = node, t->capacity = capacity;
    }
    if (t->trials + trials > t->trial_capacity) {
        const int capacity = 2 * t->trial_capacity + trials + 16;
        touch_trial *trial = realloc(t->trial, (size_t)capacity * sizeof *trial);
        if (!trial) return false;
        t->trial = trial, t->trial_capacity = capacity;
    }
    return true;
}

static touch_trial trial_of(const mpm *m, const node_side *s)
{
    touch_trial t = { .brick = (int)(s->brick - m->bricks), .m = s->state.m, .heat = s->state.heat };
    memcpy(t.v, s->state.v, sizeof t.v);
    memcpy(t.v_start, s->state.v_start, sizeof t.v_start);
    memcpy(t.absorbed, s->state.absorbed, sizeof t.absorbed);
    memcpy(t.extra, s->state.extra, sizeof t.extra);
    return t;
}

static void side_of(mpm *m, const touch_trial *t, const int index[3], node_side *s)
{
    s->brick = &m->bricks[t->brick];
    s->state = (node_state){ .m = t->m, .heat = t->heat, .extra = t->extra };
    memcpy(s->state.v, t->v, sizeof t->v);
    memcpy(s->state.v_start, t->v_start, sizeof t->v_start);
    memcpy(s->state.absorbed, t->absorbed, sizeof t->absorbed);
    s->n_walls = walls_at(m, axes_of(m, s->brick), index, s->brick->group, s->walls);
}

/* A node that groups share waits for the nodes around it: what is known of it before any contact. */
static bool note_shared(mpm *m, touch_site *t, const node_side *side, int here, const double h[3], double dt)
{
    if (!reserve_touch(t, here * (here - 1) / 2, here)) return false;
    for (int s = 0; s < here; s++) t->trial[t->trials++] = trial_of(m, &side[s]);
    for (int a = 0; a < here; a++)
        for (int b = a + 1; b < here; b++) {
            const node_place place = { h, side[a].walls, side[a].n_walls, dt };
            t->count += record_of(m, &side[a], &side[b], &place, &t->node[t->count]);
        }
    return true;
}

static void one_node(mpm *m, const scratch *at, touch_site *t, int count, int cell, const int index[3],
                     const double h[3], double dt, tally *sum)
{
    node_side *side = at->side;
    const double gas = at->gas ? m->cavities->state[at->gas - 1].pressure : 0;
    int here = 0;
    for (int s = 0; s < count; s++)
        if (at->group[s].line[cell][0] > 0)
            begin_side(m, &at->group[s], cell, index, dt, gas, &side[here++], sum);
        else
            memset(brick_nodes(m, at->group[s].brick)[cell], 0, NODE * sizeof(double));
    if (here > 1) {
        if (!note_shared(m, t, side, here, h, dt)) sum->stranded = true;
        return;
    }
    for (int s = 0; s < here; s++) {
        touch_walls(m, &side[s], dt, sum);
        end_side(m, &side[s], cell, count > 1, at->gas, at->swept, dt, sum);
    }
}

/* The contacts at a node that groups share, whose trials begin with `first`. */
static void touch_node_at(mpm *m, const scratch *at, const touch_site *t, int first, int here, int cell,
                          const int index[3], double dt, tally *sum)
{
    node_side *side = at->side;
    int pairs = 0;
    for (int s = 0; s < here; s++) side_of(m, &t->trial[first + s], index, &side[s]);
    for (int a = 0; a < here; a++)
        for (int b = a + 1; b < here; b++) {
            const int group[2] = { side[a].brick->group, side[b].brick->group };
            const touch_node *r = record_at(m, t, cell, group);
            touching *p = &at->pair[pairs];
            *p = (touching){ &side[a], &side[b], { 0 } };
            if (r && contact_pair(m, p, cell, r, dt, sum)) pairs++;
        }
    for (int s = 0; s < here; s++) touch_walls(m, &side[s], dt, sum);
    for (int i = 0; i < pairs; i++) contact_heat(m, &at->pair[i], sum); /* of the motion that the walls leave */
    for (int s = 0; s < here; s++) end_side(m, &side[s], cell, true, at->gas, at->swept, dt, sum);
}

/* Away from every wall: one_node then only adds the forces, unless groups meet. */
static bool is_inside(const axis axes[3], const int index[3])
{
    for (int k = 0; k < 3; k++)
        if (index[k] <= 1 || index[k] >= axes[k].last) return false;
    return true;
}

static bool is_shared(const group_nodes *groups, int count, int cell)
{
    int n = 0;
    for (int s = 0; s < count; s++) n += groups[s].line[cell][0] > 0;
    return n > 1;
}

/* one_node for a single group away from the walls; zero where it has no mass. */
static void free_node(const double line[LINE], double dt, double node[NODE])
{
    const double inverse = line[0] > 0 ? 1 / line[0] : 0;
    double before = 0, after = 0, power = 0;
    for (int k = 0; k < 3; k++) {
        const double v = line[1 + k] * inverse;
        power += line[4 + k] * v;
        node[k] = v + dt * line[4 + k] * inverse;
        before += v * v;
        after += node[k] * node[k];
    }
    node[3] = 0.5 * after + (line[7] - 0.5 * dt * power) * inverse - 0.5 * before;
}

/* The groups that have mass at a site, an interface's already gathered; their number. */
static int groups_at(mpm *m, int site, const scratch *to, tally *sum)
{
    int count = 0, present = 0;
    for (int f = 0; f < m->groups; f++) present += brick_of_site(m, site, f) >= 0;
    sum->shared = present > 1;
    for (int f = 0; f < m->groups; f++) {
        const int i = brick_of_site(m, site, f);
        if (i < 0) continue;
        brick *b = &m->bricks[i];
        group_nodes *n = &to->group[count];
        *n = b->at_interface ? interface_lines(b) : (group_nodes){ b, to->own[count][0], to->own[count][1] };
        if (present > 1) memset(b->contact_impulse, 0, sizeof b->contact_impulse);
        if (b->at_interface
                ? has_mass(b->line)
                : gather_group(m, b, present > 1 || m->cavities || (m->arrivals && mpm_arrival_cells(m, b)), n))
            count++;
        else
            memset(brick_nodes(m, b), 0, sizeof *m->nodes);
    }
    return count;
}

static const brick *first_at(const mpm *m, int site)
{
    int f = 0;
    while (brick_of_site(m, site, f) < 0) f++;
    return &m->bricks[brick_of_site(m, site, f)];
}

void ISA(nodes)(mpm *m, int site, int thread)
{
    scratch at = scratch_of(m, thread);
    tally *sum = &m->site_sum[site];
    memset(sum, 0, sizeof *sum);
    const brick *b = first_at(m, site);
    const uint64_t due = mpm_substep_due(m, b) &
                         ~(b->interface.follow_coarser | b->interface.follow_finer); /* mpm_interface_constrain */
    if (!due) return;
    struct mpm_cavities *cavities = m->cavities;
    if (cavities) {
        at.swept = cavities->swept + site * cavities->n;
        memset(at.swept, 0, (size_t)cavities->n * sizeof *at.swept);
    }
    const int count = groups_at(m, site, &at, sum);
    if (count == 0) return;
    const axis *axes = axes_of(m, b);
    touch_site *touch = count > 1 ? &m->touch[site] : NULL;
    if (touch) touch->count = touch->trials = 0, touch->step = m->substeps;
    for (int cell = 0; cell < BRICK_CELLS; cell++) {
        if (touch) touch->first[cell] = touch->count, touch->first_trial[cell] = touch->trials;
        const int index[3] = { BRICK * b->at[0] + cell % BRICK, BRICK * b->at[1] + cell / BRICK % BRICK,
                               BRICK * b->at[2] + cell / (BRICK * BRICK) };
        if (!(due >> cell & 1)) continue;
        const double dt = mpm_substep_dt(m, b, cell);
        at.gas = cavities && is_in_map(cavities, index) ? cavity_at(cavities, index) & CAVITY_OF : 0;
        if (!at.gas && is_inside(axes, index) && !is_shared(at.group, count, cell)) {
            for (int s = 0; s < count; s++)
                free_node(at.group[s].line[cell], dt, brick_nodes(m, at.group[s].brick)[cell]);
            continue;
        }
        double h[3];
        for (int k = 0; k < 3; k++) h[k] = axes[k].edge[index[k] + 1] - axes[k].edge[index[k]];
        one_node(m, &at, touch, count, cell, index, h, dt, sum);
    }
    if (touch) touch->first[BRICK_CELLS] = touch->count, touch->first_trial[BRICK_CELLS] = touch->trials;
}

void ISA(touch)(mpm *m, int site, int thread)
{
    const touch_site *t = &m->touch[site];
    if (t->step != m->substeps || t->trials == 0) return;
    scratch at = scratch_of(m, thread);
    tally *sum = &m->site_sum[site];
    const brick *b = first_at(m, site);
    struct mpm_cavities *cavities = m->cavities;
    if (cavities) at.swept = cavities->swept + site * cavities->n;
    for (int cell = 0; cell < BRICK_CELLS; cell++) {
        const int first = t->first_trial[cell], here = t->first_trial[cell + 1] - first;
        const int index[3] = { BRICK * b->at[0] + cell % BRICK, BRICK * b->at[1] + cell / BRICK % BRICK,
                               BRICK * b->at[2] + cell / (BRICK * BRICK) };
        if (here == 0) continue;
        at.gas = cavities && is_in_map(cavities, index) ? cavity_at(cavities, index) & CAVITY_OF : 0;
        touch_node_at(m, &at, t, first, here, cell, index, mpm_substep_dt(m, b, cell), sum);
    }
}

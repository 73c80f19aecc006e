/* The fine zone along x follows the ploughing: a new axis now and then, between two steps.
 *
 * Nodes of the old and the new fine zone lie on one lattice, so what stays in it keeps its cells.  Particles that come
 * into finer cells are halved along x until they fit; neighbours along x that are left in coarser cells are merged. */
#include "mpm/memory/build.h"
#include "mpm/memory/store.h"

#include <math.h>
#include <omp.h>
#include <stdlib.h>
#include <string.h>

static const double MERGE_RATIO = 0.9; /* of a merged domain to the longest that its cell bears, at most */
static const int QUANTUM = 8;          /* fine cells the zone moves at a time, at least */
/* Fine cells, or own half lengths, that the last points of a wake reach beyond their ends. */
static const double SEAM = 1.0;

/* ---- merging ---- */

/* A cell's points; a thread has its own. */
typedef struct {
    int n, capacity, merged;
    int *body;
    double (*data)[BLOCK_DOUBLES];
} gathering;

static bool make_room(gathering *g, int n)
{
    if (n <= g->capacity) return true;
    const int capacity = 2 * n + 64;
    int *b = realloc(g->body, (size_t)capacity * sizeof *b);
    if (b) g->body = b;
    double(*d)[BLOCK_DOUBLES] = realloc(g->data, (size_t)capacity * sizeof *d);
    if (d) g->data = d;
    if (b && d) g->capacity = capacity;
    return b && d;
}

/* All of the points, or only what decides which of them are merged. */
static bool gather_cell(const mpm *m, const brick *b, int cell, bool whole, gathering *g)
{
    static const int decides[] = { FIRST_x,        FIRST_x + 1,    FIRST_x + 2, FIRST_half,
                                   FIRST_half + 1, FIRST_half + 2, FIRST_damage };
    const int fields = whole ? (int)BLOCK_DOUBLES : (int)(sizeof decides / sizeof *decides);
    g->n = g->merged = 0;
    for (int q = b->head[cell]; q >= 0; q = m->links[q].next) {
        const double(*from)[LANES] = (const double(*)[LANES])(const void *)&m->blocks[q];
        if (!make_room(g, g->n + LANES)) return false;
        for (unsigned lanes = m->links[q].mask; lanes; lanes &= lanes - 1) {
            for (int i = 0; i < fields; i++) {
                const int field = whole ? i : decides[i];
                g->data[g->n][field] = from[field][__builtin_ctz(lanes)];
            }
            g->body[g->n++] = m->links[q].body;
        }
    }
    return true;
}

/* Side by side along an axis, of one size across, sound, and together no longer than the cell bears? */
static bool mergeable(const double *a, const double *b, int along, double longest)
{
    if (a[FIRST_damage] >= 1 || b[FIRST_damage] >= 1) return false;
    const double length = a[FIRST_half + along] + b[FIRST_half + along],
                 apart = fabs(a[FIRST_x + along] - b[FIRST_x + along]);
    if (2 * length > longest || fabs(apart - length) > 0.5 * length) return false;
    for (int i = 1; i < 3; i++) {
        const int k = (along + i) % 3;
        const double small = fmin(a[FIRST_half + k], b[FIRST_half + k]),
                     large = fmax(a[FIRST_half + k], b[FIRST_half + k]);
        if (small < 0.7 * large || fabs(a[FIRST_x + k] - b[FIRST_x + k]) > 0.5 * small) return false;
    }
    return true;
}

static int partner(const gathering *g, int i, int along, double longest)
{
    int best = -1;
    double nearest = HUGE_VAL;
    for (int j = i + 1; j < g->n; j++) {
        const double d = fabs(g->data[i][FIRST_x + along] - g->data[j][FIRST_x + along]);
        if (g->body[j] == g->body[i] && d < nearest && mergeable(g->data[i], g->data[j], along, longest))
            best = j, nearest = d;
    }
    return best;
}

static void merge_along(gathering *g, int along, double longest, double dt)
{
    for (bool again = true; again;) {
        again = false;
        for (int i = 0; i < g->n; i++) {
            const int j = partner(g, i, along, longest);
            if (j < 0) continue;
            mpm_point_merge(g->data[i], g->data[j], along, dt);
            g->n--;
            g->body[j] = g->body[g->n];
            memcpy(g->data[j], g->data[g->n], sizeof g->data[j]);
            g->merged++;
            again = true;
        }
    }
}

static bool any_partner(const gathering *g, const double longest[3])
{
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < g->n && longest[k] > 0; i++)
            if (partner(g, i, k, longest[k]) >= 0) return true;
    return false;
}

/* Longest domains along each axis; 0: none is merged along it.  False: no memory. */
static bool merge_cell(mpm *m, brick *b, int cell, const double longest[3], gathering *g)
{
    if (!gather_cell(m, b, cell, false, g)) return false;
    if (!any_partner(g, longest)) return true;
    if (!gather_cell(m, b, cell, true, g)) return false;
    for (int k = 0; k < 3; k++) merge_along(g, k, longest[k], level_dt_last(m, b->level));
    b->particles -= g->n + g->merged;
    mpm_store_release_cell(m, b, cell);
    for (int i = 0; i < g->n; i++)
        mpm_store_insert(m, b, cell, g->body[i], g->data[i]); /* fits: less than was released */
    return true;
}

/* How long points may become by merging in a brick's cells along each axis; 0 where cells are no larger than fine ones.
 */
static bool merge_lengths(const mpm *m, const brick *b, double longest[3][BRICK])
{
    bool any = false;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < BRICK; i++) {
            const axis *a = &axes_of(m, b)[k];
            const int node = BRICK * b->at[k] + i;
            const bool larger =
                node >= 1 && node <= a->last && a->node[node + 1] - a->node[node - 1] > 2.4 * m->scene.axis[k].fine;
            longest[k][i] = larger ? MERGE_RATIO * a->longest[node] : 0;
            any = any || larger;
        }
    return any;
}

/* Cells of more than a block, so that what lies in its cell as it was made costs nothing. */
static bool merge_brick(mpm *m, brick *b, gathering *g, uint64_t *merges)
{
    double along[3][BRICK];
    if (b->particles == 0 || !merge_lengths(m, b, along)) return true;
    for (int c = 0; c < BRICK_CELLS; c++) {
        const double longest[3] = { along[0][c % BRICK], along[1][c / BRICK % BRICK], along[2][c / (BRICK * BRICK)] };
        if (b->head[c] < 0 || m->links[b->head[c]].next < 0) continue;
        if (!merge_cell(m, b, c, longest, g)) return false;
        *merges += (uint64_t)g->merged;
    }
    return true;
}

static status merge_coarse(mpm *m)
{
    bool enough = true;
    uint64_t merges = 0;
#pragma omp parallel num_threads(m->threads) reduction(&& : enough) reduction(+ : merges)
    {
        gathering g = { 0 };
#pragma omp for schedule(dynamic, 4)
        for (int i = 0; i < m->bricks_used; i++) enough = merge_brick(m, &m->bricks[i], &g, &merges) && enough;
        free(g.body);
        free(g.data);
    }
    m->report.merges += merges;
    CHECK(enough, STATUS_MEMORY, "no memory to merge particles");
    return status_ok();
}

/* ---- the wake ---- */

/* The part of a point below x along the axis that the window follows; what lies beyond is left to the point itself,
 * however it is split by then. */
static status wake_point(mpm *m, const block *q, int lane, int body, double x)
{
    mpm_wake *w = &m->wake;
    if (w->n == m->wake_capacity) {
        const size_t capacity = 2 * m->wake_capacity + 4096;
        mpm_wake_point *p = realloc(w->point, capacity * sizeof *p);
        CHECK(p, STATUS_MEMORY, "no memory for a wake of %zu points", capacity);
        w->point = p;
        m->wake_capacity = capacity;
    }
    mpm_wake_point *p = &w->point[w->n++];
    memset(p, 0, sizeof *p); /* images hold the padding too */
    for (int k = 0; k < 3; k++) {
        p->position[k] = q->x[k][lane], p->size[k] = q->half[k][lane], p->velocity[k] = q->v[k][lane];
    }
    p->damage = q->damage[0][lane], p->mass = q->mass[0][lane], p->body = body;
    mpm_cut_at(m->scene.follow.along, x, false, p->position, p->size, &p->mass);
    return status_ok();
}

/* What lies beyond x moves on for a while: without the overlap a crack would open there, as deep as that motion goes.
 */
static void reach_over_seam(const mpm *m, size_t first, double x)
{
    const int k = m->scene.follow.along;
    const double cell = m->scene.axis[k].fine;
    for (size_t i = first; i < m->wake.n; i++) {
        mpm_wake_point *p = &m->wake.point[i];
        if (p->position[k] + p->size[k] <= x - cell) continue;
        const double more = SEAM * fmax(cell, p->size[k]);
        p->position[k] += 0.5 * more, p->size[k] += 0.5 * more;
    }
}

bool mpm_cut_at(int along, double place, bool above, double position[3], double size[3], double *mass)
{
    const int k = along;
    const double lo = position[k] - size[k], hi = position[k] + size[k];
    const double from = above ? fmax(lo, place) : lo, to = above ? hi : fmin(hi, place);
    if (!(to > from)) return false;
    *mass *= (to - from) / (hi - lo);
    if (from > lo || to < hi) position[k] = 0.5 * (from + to), size[k] = 0.5 * (to - from);
    return true;
}

/* Keeps what the followed bodies look like upstream of x before it is merged. */
static status leave_wake(mpm *m, double x)
{
    const size_t first = m->wake.n;
    const int k = m->scene.follow.along;
    for (int i = 0; i < m->bricks_used; i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next)
                for (int l = 0; l < LANES && m->scene.body[m->links[q].body].followed; l++) {
                    const block *b = &m->blocks[q];
                    if (m->links[q].mask >> l & 1 && b->x[k][l] + b->half[k][l] > m->wake.until &&
                        b->x[k][l] - b->half[k][l] < x)
                        TRY(wake_point(m, b, l, m->links[q].body, x));
                }
    reach_over_seam(m, first, x);
    m->wake.until = x;
    return status_ok();
}

/* ---- moving ---- */

/* Axis along which the point is longer than its new cell bears; -1: none. */
static int too_long(const mpm *m, const mover_head *h, const double *q)
{
    const axis *a = m->grids.level[h->level].axes;
    const int in[3] = { h->cell % BRICK, h->cell / BRICK % BRICK, h->cell / (BRICK * BRICK) };
    for (int k = 0; k < 3 && q[FIRST_damage] < 1; k++)
        if (2 * q[FIRST_half + k] > a[k].longest[BRICK * h->at[k] + in[k]]) return k;
    return -1;
}

/* Notes where a point goes, halved until its new cell bears it.  What the new window leaves out is gone, and so is what
 * lies beyond the cells of its level: no cell.  False: no memory. */
static bool send_off(mpm *m, brick *old, int body, double *q)
{
    mover_list *to = &m->movers[old->movers_thread];
    mover_head h = { .body = body, .level = mpm_grids_level(&m->grids, q + FIRST_x) };
    h.cell = mpm_store_cell_at(m, h.level, q + FIRST_x, h.at);
    const int k = h.cell >= 0 ? too_long(m, &h, q) : -1;
    if (k >= 0) {
        double other[BLOCK_DOUBLES];
        mpm_point_halve(q, other, k);
        old->sum.splits++;
        return send_off(m, old, body, other) && send_off(m, old, body, q);
    }
    if (!mpm_movers_reserve(to, 1)) return false;
    if (h.cell >= 0) mpm_point_rescale_step(q, level_dt_last(m, old->level), level_dt_last(m, h.level));
    to->head[to->count] = h;
    memcpy(to->data[to->count++], q, sizeof to->data[0]);
    old->movers++;
    return true;
}

/* All points of a brick of the old grid, in the order of cells and chains; its blocks go back. */
static bool empty_brick(mpm *m, brick *old)
{
    bool enough = true;
    old->sum.splits = 0;
    old->movers = 0, old->movers_thread = omp_get_thread_num(), old->movers_first = m->movers[old->movers_thread].count;
    for (int c = 0; c < BRICK_CELLS; c++) {
        for (int q = old->head[c]; q >= 0; q = m->links[q].next) {
            const double(*from)[LANES] = (const double(*)[LANES])(const void *)&m->blocks[q];
            for (unsigned lanes = m->links[q].mask; lanes; lanes &= lanes - 1) {
                double one[BLOCK_DOUBLES];
                for (int i = 0; i < BLOCK_DOUBLES; i++) one[i] = from[i][__builtin_ctz(lanes)];
                enough = send_off(m, old, m->links[q].body, one) && enough;
            }
        }
        mpm_store_release_cell(m, old, c);
    }
    return enough;
}

/* Bricks for the points that come from an old one, and a bound on the blocks they take: each run of points to one cell
 * its own. Points that have no cell are booked as gone. */
static status receive(mpm *m, const brick *old, int *blocks)
{
    const mover_list *list = &m->movers[old->movers_thread];
    m->report.splits += old->sum.splits;
    for (int i = old->movers_first, run = 0; i < old->movers_first + old->movers; i++) {
        const mover_head *h = &list->head[i];
        int found;
        if (h->cell >= 0) {
            run = i > old->movers_first && memcmp(h, h - 1, sizeof *h) == 0 ? run + 1 : 0;
            *blocks += run % LANES == 0;
            if (run == 0) TRY(mpm_store_brick(m, old->group, h->level, h->at, &found));
            continue;
        }
        departure d = { .count = 0 };
        mpm_point_departure(list->data[i], level_dt_last(m, old->level), &d);
        mpm_book_departure(m, &d);
    }
    return status_ok();
}

/* Every thread looks at all points and takes those of its own bricks: in each brick they come in the order of the old
 * ones. */
static bool fill_bricks(mpm *m, const brick *old, int n)
{
    const int me = omp_get_thread_num(), threads = omp_get_num_threads();
    bool enough = true;
    for (int b = 0; b < n; b++) {
        const mover_list *list = &m->movers[old[b].movers_thread];
        for (int i = old[b].movers_first; i < old[b].movers_first + old[b].movers; i++) {
            const mover_head *h = &list->head[i];
            const int to = h->cell >= 0 ? brick_at(m, old[b].group, h->level, h->at) : -1;
            if (to < 0 || to % threads != me) continue;
            enough = mpm_store_insert(m, &m->bricks[to], h->cell, h->body, list->data[i]) >= 0 && enough;
        }
    }
    return enough;
}

static status move_over(mpm *m, brick *old, int n)
{
    bool enough = true;
    int blocks = 0;
    for (int t = 0; t < m->threads; t++) m->movers[t].count = 0;
#pragma omp parallel for schedule(dynamic, 2) num_threads(m->threads) reduction(&& : enough)
    for (int i = 0; i < n; i++) enough = empty_brick(m, &old[i]) && enough;
    CHECK(enough, STATUS_MEMORY, "no memory to move the fine zone");
    for (int i = 0; i < n; i++) TRY(receive(m, &old[i], &blocks));
    TRY(mpm_store_reserve(m, blocks));
#pragma omp parallel num_threads(m->threads) reduction(&& : enough)
    enough = fill_bricks(m, old, n);
    CHECK(enough, STATUS_MEMORY, "no memory for the particles");
    return status_ok();
}

/* From the old bricks to new ones, so many at a time that the copies on the way take little memory. */
static status refill(mpm *m)
{
    enum { TOGETHER = 128 };
    brick *old = m->bricks;
    const int n = m->bricks_used;
    status s = mpm_store_new_grid(m);
    for (int i = 0; i < n && s.code == STATUS_OK; i += TOGETHER)
        s = move_over(m, &old[i], n - i < TOGETHER ? n - i : TOGETHER);
    for (int i = 0; i < n; i++) mpm_store_free_brick(&old[i]);
    free(old);
    return s;
}

/* Points that come in, and what they bring. */
typedef struct {
    mpm *m;
    departure brought;
} growth;

static status grow_point(void *user, int body, const build_point *p)
{
    growth *g = user;
    double q[BLOCK_DOUBLES];
    mpm_point_of(g->m, body, p, q);
    mpm_point_departure(q, 0, &g->brought);
    return mpm_store_place(g->m, body, q);
}

/* Fresh metal of the followed bodies, from the old window's upper end on. */
static status grow_in(mpm *m, double from)
{
    const build_range range = { m->scene.follow.along, from, INFINITY };
    if (!(m->scene.axis[range.along].hi > from)) return status_ok();
    growth g = { .m = m };
    const build_sink sink = { grow_point, &g };
    for (int i = 0; i < m->scene.bodies; i++)
        if (m->scene.body[i].followed) TRY(mpm_build_body(&m->scene, i, &m->laws[i], &m->grids, &range, &sink));
    m->ledger.mass_start += g.brought.mass;
    m->ledger.energy_start += g.brought.energy;
    for (int k = 0; k < 3; k++) m->ledger.momentum_start[k] += g.brought.momentum[k];
    return status_ok();
}

zone mpm_zone_of(const mpm *m)
{
    const mpm_axis *s = &m->scene.axis[m->scene.follow.along];
    const mpm_axis *across = &m->scene.axis[m->scene.follow.across];
    return (zone){ { s->fine_lo, s->lo, s->hi, across->fine_lo, across->fine_hi } };
}

static bool is_half_model(const mpm_axis *across)
{
    return across->boundary[0] == BOUNDARY_SYMMETRY && across->fine_lo <= across->lo;
}

void mpm_zone_across(const mpm_scene *s, double *middle, double *half)
{
    const mpm_axis *z = &s->axis[s->follow.across];
    *middle = is_half_model(z) ? z->fine_lo : 0.5 * (z->fine_lo + z->fine_hi); /* a half model's begins at its mirror */
    *half = z->fine_hi - *middle;
}

void mpm_zone_widen(const mpm_scene *s, double more, double *lo, double *hi)
{
    const mpm_axis *z = &s->axis[s->follow.across];
    const bool half_model = is_half_model(z);
    const double pair = (s->levels > 1 ? 2 : 1) * z->fine; /* of the cells around it the zone takes whole ones */
    const double end = half_model ? z->hi - z->fine_hi : fmin(z->hi - z->fine_hi, z->fine_lo - z->lo);
    double middle, half;
    mpm_zone_across(s, &middle, &half);
    const double room = fmin(s->follow.width - half, end - mpm_grids_margin(s->levels, z->fine));
    const double wider = fmax(fmin(more, floor(room / pair + 1e-6) * pair), 0);
    *hi = z->fine_hi + wider;
    *lo = z->fine_lo - (half_model ? 0 : wider);
}

status mpm_zone_regrid(mpm *m, zone z)
{
    mpm_axis *s = &m->scene.axis[m->scene.follow.along], *across = &m->scene.axis[m->scene.follow.across];
    grids made;
    s->fine_lo = z.at[0], s->fine_hi = z.at[0] + m->zone_length;
    s->lo = z.at[1], s->hi = z.at[2];
    across->fine_lo = z.at[3], across->fine_hi = z.at[4];
    TRY(mpm_grids_make(&m->scene, &made));
    mpm_grids_free(&m->grids);
    m->grids = made;
    TRY(refill(m));
    return merge_coarse(m);
}

/* Across, the zone widens by a quarter or more of itself when the plastic power comes near its rim (front.c). */
static void widen(const mpm *m, const plough *p, zone *z)
{
    static const double NEAR = 0.6, WIDER = 1.25;
    double middle, half;
    mpm_zone_across(&m->scene, &middle, &half);
    if (!(p->half_width > NEAR * half) || !(half < m->scene.follow.width * (1 - 1e-9))) return;
    const double together = (1 << (m->scene.levels - 1)) * m->scene.axis[m->scene.follow.across].fine;
    mpm_zone_widen(&m->scene, ceil((WIDER - 1) * half / together) * together, &z->at[3], &z->at[4]);
}

/* Where the window ought to be now; the fine zone stays inside it. */
static zone zone_wanted(const mpm *m, const plough *p)
{
    const mpm_axis *s = &m->scene.axis[m->scene.follow.along];
    const double end = p->power > 0 ? p->front + m->scene.follow.lead : s->lo;
    const double room = fmax(2 * s->coarse, mpm_grids_margin(m->scene.levels, s->fine)),
                 way = m->scene.follow.speed * m->time;
    const double hi = m->zone_start.at[2] + way;
    const double fine_hi = fmin(end, hi - room);
    const double together = 1 << (m->scene.levels - 1); /* cells of the coarsest level keep their places */
    const double cells = fmax(floor((fine_hi - s->fine_hi) / s->fine / together), 0) * together;
    zone z = mpm_zone_of(m);
    z.at[0] += cells * s->fine, z.at[1] = m->zone_start.at[1] + way, z.at[2] = hi;
    z.at[1] = fmin(z.at[1], z.at[0] - room);
    if (p->power > 0) widen(m, p, &z);
    return z;
}

status mpm_zone_follow(mpm *m)
{
    const zone now = mpm_zone_of(m);
    if (!mpm_scene_follows(&m->scene)) return status_ok();
    plough p;
    TRY(mpm_plastic_front_find(m, &p));
    /* no front goes faster than what makes it: power that a slider's edge takes far ahead must not draw the zone off a
     * front that dies */
    const double passed = m->scene.follow.speed * (m->time - m->report.plastic_time);
    if (m->report.peak_plastic_power > 0 && m->scene.follow.speed > 0)
        p.front = fmin(p.front, m->report.plastic_front + passed);
    m->report.plastic_front = p.front, m->report.plastic_power = p.power, m->report.plastic_time = m->time;
    m->report.peak_plastic_power = fmax(m->report.peak_plastic_power, p.power);
    const zone next = zone_wanted(m, &p);
    const double fine = m->scene.axis[m->scene.follow.along].fine, step = QUANTUM * fine;
    if (next.at[0] - now.at[0] < 0.999 * step && next.at[2] - now.at[2] < 4 * step && !(next.at[4] > now.at[4])) {
        if (m->scene.levels > 1) TRY(merge_coarse(m));
    } else {
        TRY(leave_wake(m, next.at[0] + fine)); /* the cell at the zone's end merges already */
        TRY(mpm_zone_regrid(m, next));
        TRY(mpm_store_surround_all(m));
        TRY(grow_in(m, now.at[2]));
        TRY(mpm_store_settle(m));
    }
    m->report.particles = mpm_particles(m);
    return status_ok();
}

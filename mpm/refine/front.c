/* Where the followed bodies are ploughed: their plastic power in the fine zone, slice by slice along the axis that the
 * zone follows and across it.
 *
 * The edge of a slider that is pressed on ploughs over the whole width, a local damage does not: what counts is the
 * power beyond what the same metal takes in the zone's rim, its outer quarter on either side, in cells of one size. */
#include "mpm/memory/store.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

/* Of the power lies ahead of the front, and as much beyond the half width. */
static const double POWER_AHEAD = 0.05;
static const double RIM = 0.75; /* of the zone's half width; beyond it lies the rim */

enum { ACROSS = 64 }; /* slices of the zone's half width */

typedef struct {
    double power, volume; /* [W, m3] */
} taken;

typedef struct {
    int along, across;   /* axes (mpm_follow) */
    double lo, width;    /* of a slice along [m] */
    double middle, half; /* of the zone across [m] */
    int n;
    taken *sums; /* [2 n] along, inside the rim and in it, then [ACROSS]; so many for each share of the bricks */
} profile;

static int sums_of(const profile *p)
{
    return 2 * p->n + ACROSS;
}

static void add(taken *t, double power, double volume)
{
    t->power += power, t->volume += volume;
}

/* A point belongs to all slices along x that its domain covers. */
static void add_lane(const block *q, int l, double off, const profile *p, taken *to)
{
    const double x = q->x[p->along][l], half = q->half[p->along][l], power = lane_plastic_power(q, l),
                 volume = q->mass[0][l] / q->rho[0][l];
    const int first = (int)fmax((x - half - p->lo) / p->width, 0);
    const int last = (int)fmin((x + half - p->lo) / p->width, p->n - 1), n = last - first + 1;
    for (int i = first; i <= last; i++) add(&to[2 * i + (off > RIM)], power / n, volume / n);
    add(&to[2 * p->n + (int)(off * ACROSS)], power, volume);
}

static void add_block(const mpm *m, int index, const profile *p, taken *to)
{
    if (!m->scene.body[m->links[index].body].followed) return;
    const block *q = &m->blocks[index];
    for (int l = 0; l < LANES; l++) {
        const double off = fabs(q->x[p->across][l] - p->middle) / p->half;
        if (q->mass[0][l] > 0 && off < 1) add_lane(q, l, off, p, to);
    }
}

static void add_share(const mpm *m, int share, const profile *p)
{
    taken *to = p->sums + (ptrdiff_t)share * sums_of(p);
    for (int i = share_begin(m->bricks_used, share); i < share_begin(m->bricks_used, share + 1); i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next) add_block(m, q, p, to);
}

/* All shares into the first. */
static void add_bodies(const mpm *m, const profile *p)
{
#pragma omp parallel for schedule(dynamic) num_threads(m->threads)
    for (int i = 0; i < SHARES; i++) add_share(m, i, p);
    for (int i = 1; i < SHARES; i++)
        for (int k = 0; k < sums_of(p); k++) {
            const taken *from = &p->sums[i * sums_of(p) + k];
            add(&p->sums[k], from->power, from->volume);
        }
}

/* Beyond what the rim's metal takes. */
static double excess(const taken *inside, const taken *rim)
{
    return fmax(inside->power - (rim->volume > 0 ? rim->power * inside->volume / rim->volume : 0), 0);
}

static double slice_power(const profile *p, int i)
{
    return excess(&p->sums[2 * i], &p->sums[2 * i + 1]);
}

static void find_front(const profile *p, plough *out)
{
    double ahead = 0;
    int front = p->n - 1;
    for (int i = 0; i < p->n; i++) out->power += slice_power(p, i);
    for (; front > 0; front--) {
        if (ahead + slice_power(p, front) >= POWER_AHEAD * out->power) break;
        ahead += slice_power(p, front);
    }
    out->front = p->lo + p->width * (front + 1);
}

/* Share of the zone's half width. */
static double find_width(const profile *p)
{
    const taken *across = p->sums + 2 * p->n;
    const int rim_from = (int)(RIM * ACROSS);
    taken rim = { 0, 0 };
    double all = 0, beyond = 0;
    int i = rim_from - 1;
    for (int k = rim_from; k < ACROSS; k++) add(&rim, across[k].power, across[k].volume);
    for (int k = 0; k < rim_from; k++) all += excess(&across[k], &rim);
    for (; i > 0; i--) {
        const double here = excess(&across[i], &rim);
        if (beyond + here >= POWER_AHEAD * all) break;
        beyond += here;
    }
    return (i + 1.0) / ACROSS;
}

status mpm_plastic_front_find(const mpm *m, plough *out)
{
    const mpm_axis *s = &m->scene.axis[m->scene.follow.along];
    *out = (plough){ .front = s->lo };
    profile p = { m->scene.follow.along, m->scene.follow.across, .lo = s->lo, .width = 2 * s->fine,
                  .n = (int)((s->hi - s->lo) / (2 * s->fine)) + 1 };
    mpm_zone_across(&m->scene, &p.middle, &p.half);
    p.sums = calloc((size_t)sums_of(&p) * SHARES, sizeof *p.sums);
    CHECK(p.sums, STATUS_MEMORY, "no memory to find the plastic front in %d slices", p.n);
    add_bodies(m, &p);
    find_front(&p, out);
    out->half_width = find_width(&p) * p.half;
    free(p.sums);
    return status_ok();
}

/* Where the followed bodies are ploughed: their plastic power, slice by slice along an axis (mpm_follow).
 *
 * The edge of a slider that is pressed on ploughs over the whole width, a local damage does not: what counts is the
 * power beyond what the same metal takes in the window's rim, its outer quarter across the axis. */
#include "mpm/memory/store.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

static const double POWER_AHEAD = 0.05; /* of the power lies ahead of the front */
static const double RIM = 0.75;         /* of the window's half width; beyond it lies the rim */

typedef struct {
    double power, volume; /* [W, m3] */
} taken;

typedef struct {
    int along, across;   /* axes (mpm_follow) */
    double lo, width;    /* of a slice along [m] */
    double middle, half; /* of the window across [m] */
    int n;
    taken *sums; /* [2 n] inside the rim and in it; so many for each share of the bricks */
} profile;

typedef struct {
    double front, power; /* [m, W] */
} plough;

static int sums_of(const profile *p)
{
    return 2 * p->n;
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

/* The window's extent across: of a half model from its mirror on. */
static void set_across(const mpm_axis *across, profile *p)
{
    const bool half_model = across->boundary[0] == BOUNDARY_SYMMETRY;
    p->middle = half_model ? across->lo : 0.5 * (across->lo + across->hi);
    p->half = across->hi - p->middle;
}

static status find(const mpm *m, plough *out)
{
    const mpm_axis *s = &m->scene.axis[m->scene.follow.along];
    *out = (plough){ .front = s->lo };
    profile p = { m->scene.follow.along, m->scene.follow.across, .lo = s->lo, .width = 2 * s->fine,
                  .n = (int)((s->hi - s->lo) / (2 * s->fine)) + 1 };
    set_across(&m->scene.axis[m->scene.follow.across], &p);
    p.sums = calloc((size_t)sums_of(&p) * SHARES, sizeof *p.sums);
    CHECK(p.sums, STATUS_MEMORY, "no memory to find the plastic front in %d slices", p.n);
    add_bodies(m, &p);
    find_front(&p, out);
    free(p.sums);
    return status_ok();
}

status mpm_plastic_front_look(mpm *m)
{
    plough p;
    mpm_report *r = &m->report;
    if (!mpm_scene_follows(&m->scene)) return status_ok();
    TRY(find(m, &p));
    r->plastic_front = p.front, r->plastic_power = p.power, r->plastic_time = m->time;
    r->peak_plastic_power = fmax(r->peak_plastic_power, p.power);
    return status_ok();
}

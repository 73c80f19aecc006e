/* Where the rail is ploughed: the plastic power of the followed bodies, slice by slice along x. */
#include "mpm/store.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

static const double POWER_AHEAD = 0.05; /* of the power lies ahead of the front */

/* Along x, of the followed bodies, inside the fine zone across (z) and beside it. */
typedef struct {
    double power[2], volume[2]; /* plastic power, volume: inside, beside [W, m3] */
} slice;

typedef struct {
    double lo, width; /* of a slice [m] */
    int n;
    slice *slice; /* n of each share of the bricks */
} profile;

/* V s : D of a lane that yields, else 0. */
static double lane_plastic_power(const block *q, int l)
{
    double square = 0, power = 0;
    if (q->damage[0][l] >= 1) return 0;
    for (int i = 0; i < 6; i++) square += (i < 3 ? 1 : 2) * q->s[i][l] * q->s[i][l];
    if (1.5 * square < 0.81 * q->flow[0][l] * q->flow[0][l]) return 0;
    for (int i = 0; i < 3; i++) power += q->s[i][l] * q->L[4 * i][l];
    power += q->s[3][l] * (q->L[1][l] + q->L[3][l]) + q->s[4][l] * (q->L[5][l] + q->L[7][l]) +
             q->s[5][l] * (q->L[2][l] + q->L[6][l]);
    return fmax(power, 0) * q->mass[0][l] / q->rho[0][l];
}

/* A point belongs to all slices that its domain covers. */
static void add_lane(const mpm *m, const block *q, int l, const profile *p, slice *to)
{
    const mpm_axis *z = &m->scene.axis[2];
    const double half = q->half[0][l], power = lane_plastic_power(q, l), volume = q->mass[0][l] / q->rho[0][l];
    const int beside = q->x[2][l] < z->fine_lo || q->x[2][l] > z->fine_hi;
    const int first = (int)fmax((q->x[0][l] - half - p->lo) / p->width, 0);
    const int last = (int)fmin((q->x[0][l] + half - p->lo) / p->width, p->n - 1);
    for (int i = first; i <= last; i++) {
        to[i].power[beside] += power / (last - first + 1);
        to[i].volume[beside] += volume / (last - first + 1);
    }
}

static void add_block(const mpm *m, int index, const profile *p, slice *to)
{
    if (!(m->scene.follow_bodies >> m->links[index].body & 1)) return;
    const block *q = &m->blocks[index];
    for (int l = 0; l < LANES; l++)
        if (q->mass[0][l] > 0) add_lane(m, q, l, p, to);
}

static void add_share(const mpm *m, int share, const profile *p)
{
    slice *to = p->slice + (ptrdiff_t)share * p->n;
    for (int i = share_begin(m->bricks_used, share); i < share_begin(m->bricks_used, share + 1); i++)
        for (int c = 0; c < BRICK_CELLS; c++)
            for (int q = m->bricks[i].head[c]; q >= 0; q = m->links[q].next) add_block(m, q, p, to);
}

/* All shares into the first. */
static void add_bodies(const mpm *m, profile *p)
{
#pragma omp parallel for schedule(dynamic) num_threads(m->threads)
    for (int i = 0; i < SHARES; i++) add_share(m, i, p);
    for (int i = 1; i < SHARES; i++)
        for (int k = 0; k < p->n; k++) {
            const slice *from = &p->slice[i * p->n + k];
            for (int beside = 0; beside < 2; beside++) {
                p->slice[k].power[beside] += from->power[beside];
                p->slice[k].volume[beside] += from->volume[beside];
            }
        }
}

/* What a slice takes in the fine zone beyond what the same metal takes beside it: the edge of a slider that is pressed on
 * ploughs over the whole width, a groove does not. */
static double excess(const slice *s)
{
    const double background = s->volume[1] > 0 ? s->power[1] * s->volume[0] / s->volume[1] : 0;
    return fmax(s->power[0] - background, 0);
}

/* Where the followed bodies are ploughed: all but a twentieth of that power lies behind it [m, W]. */
double front_find(const mpm *m, double *power)
{
    const mpm_axis *s = &m->scene.axis[0];
    profile p = { .lo = s->lo, .width = 2 * s->fine, .n = (int)((s->hi - s->lo) / (2 * s->fine)) + 1 };
    p.slice = calloc((size_t)p.n * SHARES, sizeof *p.slice);
    *power = 0;
    if (!p.slice) return s->lo;
    add_bodies(m, &p);
    for (int i = 0; i < p.n; i++) *power += excess(&p.slice[i]);
    double ahead = 0;
    int i = p.n - 1;
    while (i > 0 && ahead + excess(&p.slice[i]) < POWER_AHEAD * *power) ahead += excess(&p.slice[i--]);
    free(p.slice);
    return p.lo + p.width * (i + 1);
}

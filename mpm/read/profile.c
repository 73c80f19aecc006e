/* SPDX-License-Identifier: BSD-3-Clause */
/* Plastic power of bodies along an axis (mpm_plastic_profile). */
#include "mpm/read/visit.h"

#include <math.h>
#include <stdlib.h>

/* One share of the bricks. */
typedef struct {
    const mpm_slices *slices;
    const bool *counts;
    mpm_plastic_sum *to; /* [2 n] */
} share_sums;

static void add(mpm_plastic_sum *to, double power, double volume)
{
    to->power += power, to->volume += volume;
}

/* off: the point's distance from the middle across, over the half width. */
static void add_lane(const block *q, int l, double off, const share_sums *s)
{
    const mpm_slices *p = s->slices;
    const double x = q->x[p->along][l], half = q->half[p->along][l], power = lane_plastic_power(q, l),
                 volume = q->mass[0][l] / q->rho[0][l];
    const double from = (x - half - p->lo) / p->width, to = (x + half - p->lo) / p->width;
    if (!(to >= 0 && from < p->n)) return; /* in no slice */
    const int first = (int)fmax(from, 0), last = (int)fmin(to, p->n - 1), n = last - first + 1;
    for (int i = first; i <= last; i++) add(&s->to[2 * i + (off > p->sides)], power / n, volume / n);
}

static void add_block(void *user, const mpm *m, const brick *b, int index)
{
    (void)b;
    const share_sums *s = user;
    const mpm_slices *p = s->slices;
    if (!s->counts[m->links[index].body]) return;
    const block *q = &m->blocks[index];
    for (int l = 0; l < LANES; l++) {
        const double off = fabs(q->x[p->across][l] - p->middle) / p->half;
        if (q->mass[0][l] > 0 && off < 1) add_lane(q, l, off, s);
    }
}

status mpm_plastic_profile(const mpm *m, const bool *counts, const mpm_slices *slices, mpm_plastic_sum *sums)
{
    const int parts = 2 * slices->n;
    share_sums share[SHARES];
    mpm_plastic_sum *all = calloc((size_t)parts * SHARES, sizeof *all);
    CHECK(all, STATUS_MEMORY, "no memory for the plastic power in %d slices", slices->n);
    for (int i = 0; i < SHARES; i++) share[i] = (share_sums){ slices, counts, all + (ptrdiff_t)i * parts };
    mpm_visit_shares(m, add_block, share, sizeof *share);
    for (int k = 0; k < parts; k++) {
        sums[k] = all[k];
        for (int i = 1; i < SHARES; i++) add(&sums[k], all[i * parts + k].power, all[i * parts + k].volume);
    }
    free(all);
    return status_ok();
}

/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/target_compare.h"

#include <math.h>

static const double ALIKE = 0.01; /* of the arrival velocity: residual velocities nearer than this are tied */

/* The lower, the better. */
static int grade(const strike_outcome *o)
{
    switch ((strike_class)o->class) {
    case STRIKE_REBOUND:
    case STRIKE_STOPPED:
    case STRIKE_BULGED: return 0;
    case STRIKE_TORN: return 1;
    case STRIKE_PIERCED: return 2;
    case STRIKE_UNFINISHED: return 3;
    }
    return 3;
}

/* What sorts limit velocities: the middle of the bracket; beyond the range of the search the end that is known. */
static double limit_of(const target_entry *e)
{
    if (!isnan(e->limit)) return e->limit;
    return !isnan(e->limit_interval[0]) ? e->limit_interval[0] : e->limit_interval[1];
}

/* Does a come before b? */
static bool is_before(const target_ranking *r, const target_entry *a, const target_entry *b)
{
    if (r->by_limit) {
        const double one = limit_of(a), two = limit_of(b);
        return isnan(two) ? !isnan(one) : one > two;
    }
    if (grade(&a->is) != grade(&b->is)) return grade(&a->is) < grade(&b->is);
    return a->is.residual_velocity < b->is.residual_velocity;
}

/* Is a, which comes before b, better for certain? */
static bool is_told(const target_ranking *r, const target_entry *a, const target_entry *b)
{
    if (r->by_limit) return a->limit_interval[0] >= b->limit_interval[1]; /* NAN: not told */
    if (b->is.class == STRIKE_UNFINISHED) return false;                   /* which may yet hold */
    if (grade(&a->is) != grade(&b->is)) return true;
    return a->is.class == STRIKE_PIERCED &&
           b->is.residual_velocity - a->is.residual_velocity > ALIKE * b->is.impact_velocity;
}

static void sort(target_ranking *r)
{
    for (int k = 1; k < r->n; k++) {
        const target_entry moved = r->ranking[k];
        int at = k;
        for (; at > 0 && is_before(r, &moved, &r->ranking[at - 1]); at--) r->ranking[at] = r->ranking[at - 1];
        r->ranking[at] = moved;
    }
}

/* Of those before k that lead a group: the best from which k cannot be told; else k itself. */
static int leader_of(const target_ranking *r, int k)
{
    for (int j = 0; j < k; j++)
        if (r->ranking[j].tied == j + 1 && !is_told(r, &r->ranking[j], &r->ranking[k])) return j;
    return k;
}

void study_targets_rank(target_ranking *r)
{
    sort(r);
    for (int k = 0; k < r->n; k++) r->ranking[k].tied = leader_of(r, k) + 1;
}

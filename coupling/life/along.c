/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/life/along.h"

#include <math.h>

static const double DEEPEST = 1.5;  /* half lengths */
static const double DEEPER = 1.25;  /* each depth over the one before */
static const double STEP = 0.05;    /* between places of a passage, in half lengths */
static const double NEAR = 3.0;     /* up to which they are so dense */
static const double SLOW = 1.0;     /* below, the load is as at rest: K differs from 1 by 1e-7 [m/s] */
static const double CRACKED = 1e-9; /* rounding of shares that add up to the limit */
enum { FAR = 10, BEHIND = 30, MAX_PLACES = 200 };

double life_along_depth(const life_rail *r, int k)
{
    return k == 0 ? 0.0 : DEEPEST * r->half_length * pow(DEEPER, k - (LIFE_DEPTHS - 1));
}

/* ---- a passage ---- */

/* Where the strain is asked for, from the middle of the contact; the contact goes to +x, so that time runs to -x. */
typedef struct {
    int n;
    double x[MAX_PLACES];
} places;

static void add(places *p, double x)
{
    p->x[p->n++] = x;
}

static places places_of(const life_rail *r, const life_passage *p, const contact_load *l)
{
    const double a = r->half_length, last = fmax(p->until / p->heat.dwell, 2.0);
    places all = { .n = 0 };
    for (double x = -NEAR; x < NEAR + 0.5 * STEP; x += STEP) add(&all, a * x);
    for (int k = 0; k < l->n; k++) add(&all, l->piece[k].from), add(&all, l->piece[k].to);
    for (int k = 1; k <= FAR; k++) add(&all, a * (NEAR + 0.1 * k * k)), add(&all, -a * (NEAR + 0.1 * k * k));
    for (int k = 1; k <= BEHIND; k++) add(&all, a * (1.0 - 2.0 * pow(last, (double)k / BEHIND)));
    return all;
}

static void contact_strain(const life_rail *r, const life_passage *p, const contact_load *l, double x, double z,
                           double strain[3])
{
    double stress[3];
    if (p->velocity >= SLOW) {
        const contact_speed speed = life_contact_speed(r->youngs, r->poisson, r->density, p->velocity);
        life_contact_moving(l, &speed, x, z, strain);
        return;
    }
    life_contact_stress(l, x, z, stress);
    life_contact_strain(stress, r->youngs, r->poisson, strain);
}

void life_along_passage(const life_rail *r, const life_passage *p, double *const rate[LIFE_CAUSES])
{
    const contact_load l = life_contact_armature(r->half_length, r->rounding, p->pressure, p->friction);
    const places at = places_of(r, p, &l);
    const double a = r->half_length, expansion = isnan(r->expansion) ? 0.0 : r->expansion;
    for (int j = 0; j < LIFE_DEPTHS; j++) {
        const double z = life_along_depth(r, j);
        fatigue_extremes of[LIFE_CAUSES] = { { { 0.0 }, { 0.0 } } };
        for (int i = 0; i < at.n; i++) {
            double strain[LIFE_CAUSES][3];
            const double time = p->heat.dwell * 0.5 * (1.0 - at.x[i] / a);
            contact_strain(r, p, &l, at.x[i], z, strain[LIFE_BY_CONTACT]);
            life_heat_strain(life_heat_rise(&p->heat, z, fmin(time, p->until)), expansion, r->poisson,
                             strain[LIFE_BY_HEAT]);
            for (int q = 0; q < 3; q++) strain[LIFE_BY_BOTH][q] = strain[LIFE_BY_CONTACT][q] + strain[LIFE_BY_HEAT][q];
            for (int c = 0; c < LIFE_CAUSES; c++) mpm_fatigue_take(&r->fan, r->measure, r->poisson, strain[c], &of[c]);
        }
        for (int c = 0; c < LIFE_CAUSES; c++)
            for (int k = 0; k < r->fan.n; k++)
                rate[c][j * r->fan.n + k] =
                    mpm_fatigue_rate(&r->law, mpm_fatigue_range(r->measure, of[c].least[k], of[c].largest[k]));
    }
}

/* ---- shots ---- */

/* Shots that direction i lasts; what it has spent after all of them, not capped. */
static double life_of(const life_shots *s, int i, double factor, double *spent)
{
    double life = INFINITY;
    *spent = 0.0;
    for (int n = 0; n < s->shots; n++) {
        const double rate = factor * s->rate[s->flight[n]][i];
        if (isinf(life) && *spent + rate >= 1.0) life = n + (1.0 - *spent) / rate;
        *spent += rate;
    }
    const double last = factor * s->rate[s->flight[s->shots - 1]][i];
    return isfinite(life) ? life : s->shots + (1.0 - *spent) / last;
}

/* Number of the direction whose loss brings the index to the limit, the one with the least value going first. */
static int at_limit(const life_rail *r, const double *value)
{
    bool gone[FATIGUE_MAX_DIRECTIONS] = { false };
    double index = 0.0;
    int next = 0;
    for (int n = 0; n < r->fan.n && index < r->limit - CRACKED; n++) {
        next = -1;
        for (int k = 0; k < r->fan.n; k++)
            if (!gone[k] && (next < 0 || value[k] < value[next])) next = k;
        gone[next] = true;
        index += r->fan.share[next];
    }
    return next;
}

static void take_depth(const life_rail *r, const life_shots *s, double factor, int j, life_place *best)
{
    double life[FATIGUE_MAX_DIRECTIONS] = { 0.0 }, unspent[FATIGUE_MAX_DIRECTIONS] = { 0.0 };
    int first = 0;
    for (int k = 0; k < r->fan.n; k++) {
        life[k] = life_of(s, j * r->fan.n + k, factor, &unspent[k]);
        unspent[k] = -unspent[k];
        if (life[k] < life[first]) first = k;
    }
    const double cracks = life[at_limit(r, life)];
    best->spent = fmax(best->spent, -unspent[at_limit(r, unspent)]);
    best->first = fmin(best->first, life[first]);
    if (!(cracks < best->life)) return;
    best->life = cracks, best->depth_number = j;
    best->depth = life_along_depth(r, j), best->angle = r->fan.angle[first];
}

life_place life_along_place(const life_rail *r, const life_shots *s, double factor)
{
    life_place best = { .life = INFINITY, .first = INFINITY, .depth = NAN, .angle = NAN };
    for (int j = 0; j < LIFE_DEPTHS; j++) take_depth(r, s, factor, j, &best);
    return best;
}

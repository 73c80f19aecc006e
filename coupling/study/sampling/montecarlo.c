/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/sampling/montecarlo.h"

#include "coupling/host/numbers.h"
#include "coupling/study/layer_wear.h"
#include "coupling/study/sampling/gouge_law.h"
#include "coupling/study/sampling/population.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* What is added up over all histories, for each surface and shot. */
enum { GOUGES, VOLUME, FIRSTS, SUMS = FIRSTS + MC_BINS };

/* A grain; of those that gouges leave, rims, as the next shot finds them. */
typedef struct {
    double x, ln_r;
    int family;
    bool bare; /* it stands on the rail's own metal, not on a layer */
} grain;

typedef struct {
    size_t n, room;
    grain *item; /* owned */
} grain_list;

/* A population on one surface. */
typedef struct {
    int family;       /* -1: cannot gouge */
    double kept;      /* share of the first surface's grains that are there */
    double ln_median; /* of log-normal sizes */
} strewn_here;

/* One surface, ready for drawing. */
typedef struct {
    const grain_families *grains;
    gouge_law *law; /* of each family, owned, as those of changed and of bare rails: NULL: there are none */
    gouge_law *changed[MC_CHANGES], *bare;
    double most[MC_CHANGES]; /* that the laws of changed rails are for [K, m, m] */
    gouge_law_draw *draw;    /* of each family in this world, owned */
    mc_along *own;           /* where all shots are alike, owned */
    const mc_along *along;   /* of the shot under way */
    double per_place;        /* [1/m] */
    double layers;           /* thickness of all [m] */
    strewn_here *strewn;     /* of each population, owned */
    double ln_factor;        /* on sizes */
    double ln_smallest;      /* of a population's grains and of rims */
    int draws;
    grain_list rims, rims_next; /* that this shot meets, that it leaves */
    bool rim_lost;              /* there was no memory for it */
    int gouges;                 /* of the shot under way */
    double volume, first;
    double latest; /* volume of the gouge that was made last [m3] */
} lane;

/* What all surfaces draw of one population of the first surface. */
typedef struct {
    const case_population *p;
    double from, to;           /* stretch worth drawing [m] */
    double mean;               /* grains drawn, expected */
    double lowest;             /* deviate below which a log-normal grain is too small for every surface */
    gsl_ran_discrete_t *table; /* of tabulated sizes, owned; NULL: log-normal */
} strewn;

typedef struct {
    const mc_plan *plan;
    gsl_rng *rng;
    lane *lane;     /* owned */
    strewn *strewn; /* one a population, owned */
    double *sum;    /* [n x shots x SUMS], owned */
    double *share;  /* of each number that a world draws, [numbers x MC_WORLDS], 0 .. 1, owned */
    mc_result *out; /* sums of what is strewn until they are means */
    uint64_t drawn; /* grains so far */
    bool stopped;
} mc;

/* ---- counting ---- */

static double *sums_of(const mc *m, int surface, int number)
{
    return m->sum + ((size_t)surface * (size_t)m->plan->shots + (size_t)number) * SUMS;
}

/* Of the piece of the barrel around x. */
static mc_strewn *strewn_of(const mc *m, int surface, int number, int population, double x)
{
    const int piece = (int)(MC_PIECES * x / m->plan->length), fired = surface * m->plan->shots + number;
    return &m->out->strewn[(fired * m->out->populations + population) * MC_PIECES +
                           (piece < MC_PIECES ? piece : MC_PIECES - 1)];
}

static int bin_of(const mc *m, double x)
{
    const int bin = (int)(MC_BINS * x / m->plan->length);
    return bin < MC_BINS ? bin : MC_BINS - 1;
}

/* ---- lists of grains ---- */

static bool add_grain(grain_list *l, grain g)
{
    if (l->n == l->room) {
        const size_t room = l->room > 0 ? 2 * l->room : 64;
        grain *more = realloc(l->item, room * sizeof *more);
        if (!more) return false;
        l->item = more;
        l->room = room;
    }
    l->item[l->n++] = g;
    return true;
}

/* ---- one grain on one surface ---- */

static double value_at(const lane *l, const double table[MC_PLACES + 1], double x)
{
    const double at = fmin(fmax(x * l->per_place, 0.0), MC_PLACES - 1e-9);
    const int i = (int)at;
    return table[i] + (at - i) * (table[i + 1] - table[i]);
}

static double velocity_at(const lane *l, double x)
{
    return value_at(l, l->along->v, x);
}

/* How far the rail at a grain is on its way to each of the changed ones, 0 .. 1.  Where a gouge has bared the rail
 * there are no layers left to wear, and what metal has come there since is not followed. */
static void shares_at(const lane *l, const grain *g, double share[MC_CHANGES])
{
    for (int k = 0; k < MC_CHANGES; k++) {
        const bool counts = l->changed[k] && (k == MC_WARMTH || !g->bare);
        share[k] = counts ? fmin(value_at(l, l->along->left[k], g->x) / l->most[k], 1.0) : 0.0;
    }
}

double study_mc_threshold_changed(double threshold, double cold, double hot, double share)
{
    if (cold > 0.0 && isfinite(cold) && isfinite(hot)) return threshold * (1.0 + share * (hot / cold - 1.0));
    return share < 0.5 || isinf(cold) == isinf(hot) ? threshold : hot;
}

static double threshold_at(const lane *l, const grain *g, const double share[MC_CHANGES])
{
    const gouge_law_draw draw = l->draw[g->family];
    const double cold = study_gouge_law_threshold(&l->law[g->family], g->ln_r, draw);
    double here = g->bare ? study_gouge_law_threshold(&l->bare[g->family], g->ln_r, draw) : cold;
    for (int k = 0; k < MC_CHANGES; k++) {
        if (!(share[k] > 0.0)) continue;
        const double hot = study_gouge_law_threshold(&l->changed[k][g->family], g->ln_r, draw);
        here = study_mc_threshold_changed(here, cold, hot, share[k]);
    }
    return here;
}

/* What each change does to the mark is added; the first of those that know a mark is the one that they start from. */
static gouge_mark mark_at(const lane *l, const grain *g, double v, const double share[MC_CHANGES])
{
    const gouge_law *cold = g->bare ? &l->bare[g->family] : &l->law[g->family];
    for (int k = 0; k < MC_CHANGES && !cold->marked; k++)
        if (share[k] > 0.0) cold = &l->changed[k][g->family];
    const gouge_mark start = study_gouge_law_mark(cold, v);
    gouge_mark here = start;
    for (int k = 0; k < MC_CHANGES; k++) {
        const gouge_law *hot = share[k] > 0.0 ? &l->changed[k][g->family] : cold;
        if (hot == cold || !hot->marked) continue;
        const gouge_mark to = study_gouge_law_mark(hot, v);
        here = study_gouge_mark_towards(&here, &start, &to, share[k]);
    }
    if (here.volume < 0.0) here.volume = 0.0;
    return here;
}

/* Where the gouge ends; on the rail's own metal if it wears the layers through, or is in such a place itself. */
static void leave_rim(lane *l, const grain *g, double radius, const gouge_mark *m)
{
    if (!(m->rim > 0.0)) return;
    const double layers = l->layers - value_at(l, l->along->left[MC_WEAR], g->x);
    const bool bare = l->bare && (g->bare || study_layer_wear_is_through(m->layers_gone, m->depth * radius, layers));
    const double as_grain = m->rim * radius / l->grains->family[g->family].aspect; /* radius of a grain as high */
    const grain left = { g->x + m->along * radius, log(as_grain), g->family, bare };
    if (!add_grain(&l->rims_next, left)) l->rim_lost = true;
}

/* Does it gouge? */
static bool meet(lane *l, const grain *g)
{
    const double v = velocity_at(l, g->x);
    double share[MC_CHANGES];
    shares_at(l, g, share);
    if (!(v > 0.0) || v < threshold_at(l, g, share)) return false;
    const double radius = exp(g->ln_r);
    const gouge_mark mark = mark_at(l, g, v, share);
    l->gouges++;
    l->latest = mark.volume * radius * radius * radius;
    l->volume += l->latest;
    l->first = fmin(l->first, g->x);
    leave_rim(l, g, radius, &mark);
    return true;
}

/* ---- one shot ---- */

static void meet_sites(lane *l)
{
    const case_onset *c = l->grains->c;
    for (int i = 0; i < c->sites.n; i++) {
        const case_site *site = &c->sites.item[i];
        const int family = study_family_of_site(l->grains, i);
        const grain g = { site->position, log(site->radius) + l->ln_factor, family, false };
        if (g.family >= 0) meet(l, &g);
    }
}

static void meet_rims(const mc *m, lane *l)
{
    for (size_t i = 0; i < l->rims.n; i++) {
        const grain *g = &l->rims.item[i];
        if (g->ln_r >= l->ln_smallest && g->x < m->plan->length) meet(l, g);
    }
}

static double draw_deviate(const mc *m, const strewn *s)
{
    double z;
    if (s->lowest > 0.0) return gsl_ran_ugaussian_tail(m->rng, s->lowest);
    do z = gsl_ran_gaussian_ziggurat(m->rng, 1.0);
    while (z < s->lowest);
    return z;
}

/* Between two grains; what was counted is lost then. */
static bool stop_asked(mc *m)
{
    enum { EVERY = 1 << 16 };
    if (m->drawn++ % EVERY == 0) m->stopped = m->plan->stop && m->plan->stop();
    return m->stopped;
}

static void strew(mc *m, int index, int number)
{
    const strewn *s = &m->strewn[index];
    for (unsigned k = gsl_ran_poisson(m->rng, s->mean); k > 0 && !stop_asked(m); k--) {
        const double x = s->from + (s->to - s->from) * gsl_rng_uniform(m->rng);
        const double kept = gsl_rng_uniform(m->rng);
        const size_t line = s->table ? gsl_ran_discrete(m->rng, s->table) : 0;
        const double spread = s->table ? 0.0 : s->p->radius_spread * draw_deviate(m, s);
        for (int i = 0; i < m->plan->n; i++) {
            lane *l = &m->lane[i];
            const strewn_here *here = &l->strewn[index];
            if (here->family < 0 || kept >= here->kept) continue;
            const case_sizes *sizes = &l->grains->c->populations.item[index].sizes;
            const double ln_r = l->ln_factor + (s->table ? log(sizes->item[line].radius) : here->ln_median + spread);
            const grain g = { x, ln_r, here->family, false };
            if (!(ln_r >= l->ln_smallest) || !meet(l, &g)) continue;
            mc_strewn *sum = strewn_of(m, i, number, index, x);
            sum->gouges += 1.0;
            sum->volume += l->latest;
        }
    }
}

/* The rims that a shot leaves are those that the next one meets. */
static status hand_on_rims(lane *l)
{
    const grain_list met = l->rims;
    CHECK(!l->rim_lost, STATUS_MEMORY, "no memory for the Monte Carlo");
    l->rims = l->rims_next;
    l->rims_next = met;
    return status_ok();
}

/* The shot of this number, from 0, on all surfaces. */
static status fire(mc *m, int number)
{
    for (int i = 0; i < m->plan->n; i++) {
        lane *l = &m->lane[i];
        if (!l->own) l->along = &m->plan->surface[i].along[number];
        l->gouges = 0;
        l->rims_next.n = 0;
        l->volume = 0.0;
        l->first = INFINITY;
        if (number == 0) meet_sites(l);
        meet_rims(m, l);
    }
    for (int k = 0; k < m->out->populations; k++)
        if (number == 0 || m->strewn[k].p->renewed) strew(m, k, number);
    for (int i = 0; i < m->plan->n; i++) TRY(hand_on_rims(&m->lane[i]));
    return status_ok();
}

/* ---- counting ---- */

static void count(mc *m, mc_result *out, int world, int number)
{
    for (int i = 0; i < m->plan->n; i++) {
        const lane *l = &m->lane[i];
        double *sum = sums_of(m, i, number);
        const size_t at = ((size_t)i * (size_t)m->plan->shots + (size_t)number) * MC_WORLDS + (size_t)world;
        sum[GOUGES] += l->gouges;
        sum[VOLUME] += l->volume;
        out->world_gouges[at] += l->gouges;
        out->world_volumes[at] += l->volume;
        if (l->gouges > 0) sum[FIRSTS + bin_of(m, l->first)] += 1.0;
    }
}

/* Latin hypercube (docs/theory/onset.md): one world in each MC_WORLDS-th of what a number may be. */
static void draw_number(mc *m, double share[MC_WORLDS])
{
    for (int w = 0; w < MC_WORLDS; w++) share[w] = (w + gsl_rng_uniform(m->rng)) / MC_WORLDS;
    gsl_ran_shuffle(m->rng, share, MC_WORLDS, sizeof *share);
}

static double either_way(double share)
{
    return 2.0 * share - 1.0;
}

static void begin_world(mc *m, int world)
{
    const double *share = m->share + world, alike = either_way(*share);
    for (int i = 0; i < m->plan->n; i++) {
        lane *l = &m->lane[i], *same = l;
        for (int j = 0; j < i && same == l; j++)
            if (m->lane[j].draws == l->draws) same = &m->lane[j];
        for (int k = 0; k < l->grains->n; k++, share += 2 * (ptrdiff_t)MC_WORLDS)
            l->draw[k] = same == l ? (gouge_law_draw){ .in_band = share[MC_WORLDS],
                                                       .alike = alike,
                                                       .own = either_way(share[2 * MC_WORLDS]) }
                                   : same->draw[k];
    }
}

static void middle_of(const double *worlds, double interval[2])
{
    double sorted[MC_WORLDS];
    memcpy(sorted, worlds, sizeof sorted);
    qsort(sorted, MC_WORLDS, sizeof *sorted, host_number_order);
    interval[0] = sorted[MC_WORLDS / 20];
    interval[1] = sorted[MC_WORLDS - 1 - MC_WORLDS / 20];
}

/* Place before which this share of all shots has gouged: linear inside a bin; NaN if fewer gouge. */
static double place_of_share(const mc_shot *s, double share, double length)
{
    for (int k = 0; k < MC_BINS; k++) {
        if (s->before[k] < share) continue;
        const double below = k > 0 ? s->before[k - 1] : 0.0;
        return length * (k + (share - below) / (s->before[k] - below)) / MC_BINS;
    }
    return NAN;
}

static void conclude(const mc *m, mc_result *out)
{
    static const double shares[3] = { 0.05, 0.5, 0.95 };
    const double each = 1.0 / out->histories, in_world = (double)MC_WORLDS / out->histories;
    for (int i = 0; i < out->n * out->shots; i++) {
        const double *sum = m->sum + (size_t)i * SUMS;
        mc_shot *s = &out->of[i];
        double *gouges = out->world_gouges + (size_t)i * MC_WORLDS,
               *volumes = out->world_volumes + (size_t)i * MC_WORLDS;
        for (int w = 0; w < MC_WORLDS; w++) gouges[w] *= in_world, volumes[w] *= in_world;
        s->gouges = sum[GOUGES] * each;
        s->volume = sum[VOLUME] * each;
        middle_of(gouges, s->gouges_interval);
        if (isnan(s->volume))
            s->volume_interval[0] = s->volume_interval[1] = NAN;
        else
            middle_of(volumes, s->volume_interval);
        double gouged = 0.0; /* histories: a whole number, so that certainty is 1 */
        for (int k = 0; k < MC_BINS; k++) s->before[k] = (gouged += sum[FIRSTS + k]) / out->histories;
        s->probability = s->before[MC_BINS - 1];
        for (int k = 0; k < 3; k++) s->first[k] = place_of_share(s, shares[k], m->plan->length);
    }
    for (int i = 0; i < out->n * out->shots * out->populations * MC_PIECES; i++)
        out->strewn[i].gouges *= each, out->strewn[i].volume *= each;
}

void study_mc_mean_shot(const mc_result *r, int surface, mc_mean_shot *out)
{
    const double each = 1.0 / r->shots;
    double volumes[MC_WORLDS] = { 0.0 };
    memset(out, 0, sizeof *out);
    for (int i = surface * r->shots; i < (surface + 1) * r->shots; i++) {
        out->gouges += each * r->of[i].gouges;
        out->volume += each * r->of[i].volume;
        out->probability += each * r->of[i].probability;
        for (int w = 0; w < MC_WORLDS; w++) {
            out->world_gouges[w] += each * r->world_gouges[(size_t)i * MC_WORLDS + (size_t)w];
            volumes[w] += each * r->world_volumes[(size_t)i * MC_WORLDS + (size_t)w];
        }
    }
    middle_of(out->world_gouges, out->gouges_interval);
    if (isnan(out->volume))
        out->volume_interval[0] = out->volume_interval[1] = NAN;
    else
        middle_of(volumes, out->volume_interval);
}

/* ---- setting up ---- */

void study_mc_velocities(const shot_outcome *flown, double length, double v[MC_PLACES + 1])
{
    for (int i = 0; i <= MC_PLACES; i++) v[i] = gouge_trace_velocity(flown, i * length / MC_PLACES);
}

static status make_along(const mc_plan *plan, const mc_surface *s, lane *l)
{
    l->per_place = MC_PLACES / plan->length;
    l->along = s->along;
    if (s->along) return status_ok();
    l->along = l->own = calloc(1, sizeof *l->own);
    CHECK(l->own, STATUS_MEMORY, "no memory for the Monte Carlo");
    study_mc_velocities(s->grains->flown, plan->length, l->own->v);
    return status_ok();
}

/* The laws of another rail's families, in the order of the first's; none in *out where there are none. */
static status make_laws(const mc_surface *s, const grain_families *from, gouge_law **out)
{
    if (!from) return status_ok();
    *out = calloc((size_t)s->grains->n + 1, sizeof **out);
    CHECK(*out, STATUS_MEMORY, "no memory for the Monte Carlo");
    for (int k = 0; k < s->grains->n; k++) {
        const grain_family *f = study_family_alike(from, &s->grains->family[k]);
        if (f)
            study_gouge_law_make(f, &from->c->impact, &(*out)[k]);
        else
            study_gouge_law_none(&(*out)[k]);
    }
    return status_ok();
}

static void place_populations(const mc_plan *plan, lane *l)
{
    const case_populations *all = &l->grains->c->populations, *first = &plan->surface[0].grains->c->populations;
    for (int k = 0; k < all->n; k++)
        l->strewn[k] = (strewn_here){ .family = l->grains->of_population[k],
                                      .kept = all->item[k].density / first->item[k].density,
                                      .ln_median = log(all->item[k].radius_median) };
}

static status make_lane(const mc_plan *plan, int i, lane *l)
{
    const mc_surface *s = &plan->surface[i];
    l->grains = s->grains;
    l->draws = s->draws;
    l->ln_factor = log(s->size_factor);
    l->ln_smallest = log(s->grains->c->study.smallest_radius);
    l->draw = calloc((size_t)s->grains->n + 1, sizeof *l->draw);
    l->strewn = calloc((size_t)s->grains->c->populations.n + 1, sizeof *l->strewn);
    CHECK(l->draw && l->strewn, STATUS_MEMORY, "no memory for the Monte Carlo");
    place_populations(plan, l);
    l->layers = case_layers_thickness(&s->grains->c->impact.rail.layers);
    TRY(make_laws(s, s->grains, &l->law));
    for (int k = 0; k < MC_CHANGES; k++) {
        l->most[k] = s->changed[k].most;
        TRY(make_laws(s, s->changed[k].grains, &l->changed[k]));
    }
    TRY(make_laws(s, s->bare, &l->bare));
    return make_along(plan, s, l);
}

/* The lowest threshold of a family on this surface, whatever its rail has come to [m/s] */
static double lowest_of(const lane *l, int family)
{
    double lowest = study_gouge_law_lowest(&l->law[family]);
    int changes = 0;
    for (int k = 0; k < MC_CHANGES; k++) {
        if (!l->changed[k]) continue;
        lowest = fmin(lowest, study_gouge_law_lowest(&l->changed[k][family]));
        changes++;
    }
    return changes > 1 ? 0.0 : lowest; /* of several factors together no bound is known */
}

/* First place where any shot on any surface may gouge with grains of this population. */
static double first_place(const mc *m, int index)
{
    double first = m->plan->length;
    for (int i = 0; i < m->plan->n; i++) {
        const lane *l = &m->lane[i];
        const int family = l->grains->of_population[index], shots = l->own ? 1 : m->plan->shots;
        if (family < 0) continue;
        const double lowest = lowest_of(l, family);
        for (int number = 0; number < shots; number++) {
            int k = 0;
            while (k <= MC_PLACES && l->along[number].v[k] < lowest) k++;
            if (k <= MC_PLACES) first = fmin(first, fmax(k - 1, 0) / l->per_place);
        }
    }
    return first;
}

/* Deviate from which on a log-normal grain is large enough for a surface.  Without a spread all grains are, or none. */
static double smallest_deviate(const mc *m, int index)
{
    double lowest = INFINITY;
    for (int i = 0; i < m->plan->n; i++) {
        const lane *l = &m->lane[i];
        const case_population *p = &l->grains->c->populations.item[index];
        const double ln = log(l->grains->c->study.smallest_radius / p->radius_median) - l->ln_factor;
        const bool all = l->ln_factor + l->strewn[index].ln_median >= l->ln_smallest; /* as strew asks */
        lowest = fmin(lowest, p->radius_spread > 0.0 ? ln / p->radius_spread : all ? -INFINITY : INFINITY);
    }
    return lowest;
}

static status make_strewn(mc *m, int index)
{
    strewn *s = &m->strewn[index];
    s->p = &m->plan->surface[0].grains->c->populations.item[index];
    s->to = s->p->to;
    s->from = fmin(fmax(s->p->from, first_place(m, index)), s->to);
    s->mean = s->p->density * (s->to - s->from);
    if (s->p->sizes.n == 0) {
        s->lowest = smallest_deviate(m, index);
        s->mean *= gsl_cdf_ugaussian_Q(s->lowest);
        return status_ok();
    }
    double *share = malloc((size_t)s->p->sizes.n * sizeof *share);
    CHECK(share, STATUS_MEMORY, "no memory for the Monte Carlo");
    for (int k = 0; k < s->p->sizes.n; k++) share[k] = s->p->sizes.item[k].share;
    s->table = gsl_ran_discrete_preproc((size_t)s->p->sizes.n, share);
    free(share);
    CHECK(s->table, STATUS_MEMORY, "no memory for the Monte Carlo");
    return status_ok();
}

/* u_a, then u_b and u_o of each family of each surface. */
static status draw_worlds(mc *m)
{
    size_t numbers = 1;
    for (int i = 0; i < m->plan->n; i++) numbers += 2 * (size_t)m->lane[i].grains->n;
    m->share = calloc(numbers * MC_WORLDS, sizeof *m->share);
    CHECK(m->share, STATUS_MEMORY, "no memory for the Monte Carlo");
    for (size_t k = 0; k < numbers; k++) draw_number(m, m->share + k * MC_WORLDS);
    return status_ok();
}

static status set_up(mc *m, mc_result *out)
{
    const mc_plan *p = m->plan;
    const size_t n = (size_t)p->n, cells = n * (size_t)p->shots;
    out->populations = p->surface[0].grains->c->populations.n;
    m->rng = gsl_rng_alloc(gsl_rng_mt19937);
    m->lane = calloc(n, sizeof *m->lane);
    m->strewn = calloc((size_t)out->populations + 1, sizeof *m->strewn);
    m->sum = calloc(cells * SUMS, sizeof *m->sum);
    out->of = calloc(cells, sizeof *out->of);
    out->strewn = calloc(cells * (size_t)out->populations * MC_PIECES + 1, sizeof *out->strewn);
    out->world_gouges = calloc(cells * MC_WORLDS, sizeof(double));
    out->world_volumes = calloc(cells * MC_WORLDS, sizeof(double));
    CHECK(m->rng && m->lane && m->strewn && m->sum && out->of && out->strewn && out->world_gouges && out->world_volumes,
          STATUS_MEMORY, "no memory for the Monte Carlo");
    gsl_rng_set(m->rng, (unsigned long)p->seed);
    for (int i = 0; i < p->n; i++) TRY(make_lane(p, i, &m->lane[i]));
    for (int k = 0; k < out->populations; k++) TRY(make_strewn(m, k));
    return draw_worlds(m);
}

static void lane_free(lane *l)
{
    free(l->law);
    for (int k = 0; k < MC_CHANGES; k++) free(l->changed[k]);
    free(l->bare);
    free(l->own);
    free(l->draw);
    free(l->strewn);
    free(l->rims.item);
    free(l->rims_next.item);
}

static void tear_down(mc *m)
{
    for (int i = 0; m->lane && i < m->plan->n; i++) lane_free(&m->lane[i]);
    for (int k = 0; m->strewn && k < m->out->populations; k++)
        if (m->strewn[k].table) gsl_ran_discrete_free(m->strewn[k].table);
    if (m->rng) gsl_rng_free(m->rng);
    free(m->lane);
    free(m->strewn);
    free(m->sum);
    free(m->share);
}

static status run_all(mc *m, mc_result *out)
{
    const int in_world = out->histories / MC_WORLDS;
    progress *shown = m->plan->progress;
    if (shown) host_progress_task(shown, "random shots", 0.0, 0);
    for (int w = 0; w < MC_WORLDS && !m->stopped; w++) {
        begin_world(m, w);
        if (shown) host_progress_update(shown, (double)w / MC_WORLDS, 0);
        for (int h = 0; h < in_world && !stop_asked(m); h++) {
            for (int i = 0; i < m->plan->n; i++) m->lane[i].rims.n = 0;
            for (int k = 0; k < m->plan->shots; k++) {
                TRY(fire(m, k));
                count(m, out, w, k);
            }
        }
    }
    CHECK(!m->stopped, STATUS_STOPPED, "stopped in the random shots");
    return status_ok();
}

status study_mc_run(const mc_plan *plan, mc_result *out)
{
    mc m = { .plan = plan, .out = out };
    const double since = host_wall_clock();
    memset(out, 0, sizeof *out);
    out->n = plan->n;
    out->shots = plan->shots;
    out->histories = MC_WORLDS * (plan->histories / MC_WORLDS + (plan->histories % MC_WORLDS != 0));
    gsl_error_handler_t *handler = gsl_set_error_handler_off(); /* GSL's own ends the program */
    status s = set_up(&m, out);
    gsl_set_error_handler(handler);
    if (s.code == STATUS_OK) s = run_all(&m, out);
    if (s.code == STATUS_OK) conclude(&m, out);
    tear_down(&m);
    out->seconds = host_wall_clock() - since;
    return s;
}

void study_mc_free(mc_result *r)
{
    free(r->of);
    free(r->strewn);
    free(r->world_gouges);
    free(r->world_volumes);
    memset(r, 0, sizeof *r);
}

/* ---- by quadrature ---- */

/* Grains of a population at a place that gouge there: density x share of the sizes whose threshold is passed. */
static double gouging_density(const lane *l, int index, double x)
{
    enum { SIZES = 400 };
    const case_population *p = &l->grains->c->populations.item[index];
    const gouge_law *law = &l->law[l->grains->of_population[index]];
    const double smallest = l->grains->c->study.smallest_radius, v = velocity_at(l, x);
    double sum = 0.0;
    for (int i = 0; i < p->sizes.n; i++) {
        const double r = p->sizes.item[i].radius;
        if (r < smallest || v < study_gouge_law_threshold(law, log(r), study_gouge_law_middle)) continue;
        sum += study_population_share_from(p, r) - study_population_share_from(p, r * (1.0 + 1e-12));
    }
    for (int i = 0; p->sizes.n == 0 && i < SIZES; i++) { /* equal shares above the smallest */
        const double all = study_population_share_from(p, smallest), share = 1.0 - all * (1.0 - (i + 0.5) / SIZES);
        const double ln_r = log(p->radius_median) + p->radius_spread * gsl_cdf_ugaussian_Pinv(share);
        if (v >= study_gouge_law_threshold(law, ln_r, study_gouge_law_middle)) sum += all / SIZES;
    }
    return p->density * sum;
}

double study_mc_expected(const grain_families *grains, double length)
{
    const mc_surface one = { .grains = grains, .size_factor = 1.0 };
    const mc_plan plan = { .length = length, .n = 1, .surface = &one };
    lane *l = calloc(1, sizeof *l);
    double sum = NAN;
    if (l && make_lane(&plan, 0, l).code == STATUS_OK) {
        sum = 0.0;
        for (int i = 0; i < grains->c->sites.n; i++) {
            const case_site *site = &grains->c->sites.item[i];
            const int family = study_family_of_site(grains, i);
            sum += family >= 0 &&
                   velocity_at(l, site->position) >=
                       study_gouge_law_threshold(&l->law[family], log(site->radius), study_gouge_law_middle);
        }
        for (int k = 0; k < grains->c->populations.n; k++) {
            const case_population *p = &grains->c->populations.item[k];
            for (int i = 0; grains->of_population[k] >= 0 && i < MC_PLACES; i++)
                sum += gouging_density(l, k, p->from + (p->to - p->from) * (i + 0.5) / MC_PLACES) * (p->to - p->from) /
                       MC_PLACES;
        }
    }
    if (l) lane_free(l);
    free(l);
    return sum;
}

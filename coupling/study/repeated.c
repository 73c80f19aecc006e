/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/repeated.h"

#include "coupling/study/sampling/gouge_law.h"
#include "coupling/study/warm_rail.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double LEAST_RISE = 10.0;  /* below, a threshold moves by less than 0.5 % (docs/theory/onset.md) [K] */
static const double RISE_STEP = 25.0;   /* so that scenes are shared [K] */
static const double NEAR_MELTING = 0.8; /* of the rise to melting, by the first shot alone */

void study_repeated_free(repeated_rail *r)
{
    study_families_free(&r->warm);
    study_families_free(&r->bare);
    free(r->warm_case);
    free(r->bare_case);
    free(r->shot);
    free(r->along);
    memset(r, 0, sizeof *r);
}

/* ---- the flights ---- */

/* Of the piece's middles linearly, even before the first and after the last. */
static double rise_at(const double rise[CIRCUIT_SHOT_PIECES], double share_of_barrel)
{
    const double at = fmin(fmax(CIRCUIT_SHOT_PIECES * share_of_barrel - 0.5, 0.0), CIRCUIT_SHOT_PIECES - 1.0);
    const int k = at < CIRCUIT_SHOT_PIECES - 1 ? (int)at : CIRCUIT_SHOT_PIECES - 2;
    return rise[k] + (at - k) * (rise[k + 1] - rise[k]);
}

/* The largest where the armature is at least this fast. */
static double warmest(const mc_along *a, double slowest)
{
    double most = 0.0;
    for (int k = 0; k <= MC_PLACES; k++)
        if (a->v[k] >= slowest) most = fmax(most, a->rise[k]);
    return most;
}

/* The next shot, through rails that are warmer in the mean; the same flight as the last where they hardly are. */
static status fly(session *s, warm_rail *w, repeated_rail *out)
{
    const case_onset *c = w->c;
    const int number = w->number;
    bool is_flown;
    shot_outcome flown;
    shot_record record;
    TRY(study_warm_rail_shoot(s, w, &is_flown, &flown, &record));
    out->along[number] = out->along[number - 1];
    out->shot[number].muzzle_velocity = out->shot[number - 1].muzzle_velocity;
    if (is_flown) {
        study_mc_velocities(&flown, c->launcher.barrel.length, out->along[number].v);
        out->shot[number].muzzle_velocity = record.is.muzzle_velocity;
        gouge_shot_outcome_free(&flown);
    }
    for (int k = 0; k <= MC_PLACES; k++) out->along[number].rise[k] = rise_at(w->rise, (double)k / MC_PLACES);
    out->shot[number].rise = warmest(&out->along[number], c->study.velocity_low);
    out->rise = fmax(out->rise, out->shot[number].rise);
    return status_ok();
}

static status fly_all(session *s, const grain_families *first, const shot_record *flight, repeated_rail *out)
{
    warm_rail w = study_warm_rail_begin(first->c, first->flown);
    study_mc_velocities(first->flown, first->c->launcher.barrel.length, out->along[0].v);
    out->shot[0].muzzle_velocity = flight->is.muzzle_velocity;
    while (w.number < out->shots) TRY(fly(s, &w, out));
    return status_ok();
}

/* Would the rail come near melting if every shot left what the first one leaves? */
static bool may_melt(const case_onset *c, const double left[CIRCUIT_SHOT_PIECES])
{
    double rise = 0.0, most = 0.0;
    for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++) most = fmax(most, left[k]);
    for (int n = 1; n < c->study.shots; n++) rise = c->study.heat_kept * (rise + most);
    return rise > NEAR_MELTING * study_warm_rail_melting_rise(c);
}

status study_repeated_possible(session *s, const grain_families *first, const shot_record *flight)
{
    repeated_rail rail;
    if (first->c->study.shots < 2 || !may_melt(first->c, first->flown->rail_rise)) return status_ok();
    const status done = study_repeated_fly(s, first, flight, &rail);
    study_repeated_free(&rail);
    return done;
}

status study_repeated_fly(session *s, const grain_families *first, const shot_record *flight, repeated_rail *out)
{
    const int shots = first->c->study.shots;
    memset(out, 0, sizeof *out);
    if (shots == 1) return status_ok();
    out->shot = calloc((size_t)shots, sizeof *out->shot);
    out->along = calloc((size_t)shots, sizeof *out->along);
    CHECK(out->shot && out->along, STATUS_MEMORY, "no memory for %d shots", shots);
    out->shots = shots;
    return fly_all(s, first, flight, out);
}

/* ---- the searches ---- */

static bool is_renewed(const grain_families *f)
{
    for (int i = 0; i < f->c->populations.n; i++)
        if (f->of_population[i] >= 0 && f->c->populations.item[i].renewed) return true;
    return false;
}

/* The deepest crater among those that count. */
static double deepest_gouge(const grain_families *f)
{
    double depth = 0.0;
    for (int k = 0; k < f->n; k++) depth = fmax(depth, study_gouge_law_depth(&f->family[k], &f->c->impact));
    return depth;
}

static bool wears_layers_through(const grain_families *f)
{
    for (int k = 0; k < f->n; k++)
        if (study_gouge_law_bares(&f->family[k], &f->c->impact)) return true;
    return false;
}

/* A copy of what the first shot was given, to be changed. */
static status copy_case(const grain_families *first, case_onset **out)
{
    *out = malloc(sizeof **out);
    CHECK(*out, STATUS_MEMORY, "no memory for a case");
    **out = *first->c;
    return status_ok();
}

status study_repeated_want(const grain_families *first, repeated_rail *out, grain_families **wanted, int *n)
{
    *n = 0;
    if (out->shots == 0) return status_ok();
    const bool warm = out->rise >= LEAST_RISE && (deepest_gouge(first) > 0.0 || is_renewed(first));
    const bool bare = wears_layers_through(first);
    const double rounded = RISE_STEP * ceil(out->rise / RISE_STEP);
    if (!warm || rounded < study_warm_rail_melting_rise(first->c)) out->rise = warm ? rounded : 0.0;
    if (warm) {
        TRY(copy_case(first, &out->warm_case));
        out->warm_case->impact.rail.temperature += out->rise;
        snprintf(out->warm_prefix, sizeof out->warm_prefix, "%swarm-", first->prefix);
        TRY(study_families_sort(out->warm_case, first->flown, out->warm_prefix, &out->warm));
        wanted[(*n)++] = &out->warm;
    }
    if (bare) {
        TRY(copy_case(first, &out->bare_case));
        out->bare_case->impact.rail.layers.n = 0;
        snprintf(out->bare_prefix, sizeof out->bare_prefix, "%sbare-", first->prefix);
        TRY(study_families_sort(out->bare_case, first->flown, out->bare_prefix, &out->bare));
        wanted[(*n)++] = &out->bare;
    }
    return status_ok();
}

void study_repeated_found(repeated_rail *r, const grain_families *first, const uncertain_inputs *u)
{
    study_uncertain_widen(u, first, &r->warm);
    study_uncertain_widen(u, first, &r->bare);
    r->warm.prefix = r->bare.prefix = "";
}

mc_surface study_repeated_surface(const repeated_rail *r, const grain_families *first)
{
    return (mc_surface){ .grains = first,
                         .size_factor = 1.0,
                         .along = r->along,
                         .warm = r->warm_case ? &r->warm : NULL,
                         .warm_rise = r->rise,
                         .bare = r->bare_case ? &r->bare : NULL };
}

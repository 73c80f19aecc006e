/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/repeated.h"

#include "coupling/gouge/impact_scene.h"
#include "coupling/study/rail_left.h"
#include "coupling/study/sampling/gouge_law.h"
#include "coupling/study/warm_rail.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Changes that are less are not looked at: 10 K move a threshold by less than 0.5 % (docs/theory/onset.md); thinner
 * layers than 1 um a case does not have. [K, m, m] */
static const double LEAST[MC_CHANGES] = { [MC_WARMTH] = 10.0, [MC_WEAR] = 1e-6, [MC_METAL] = 1e-6 };
static const char *const NAMES[MC_CHANGES] = { [MC_WARMTH] = "warm", [MC_WEAR] = "worn", [MC_METAL] = "plated" };
static const double RISE_STEP = 25.0; /* so that scenes are shared [K] */

static void changed_free(changed_rail *r)
{
    study_families_free(&r->grains);
    free(r->layers.item);
    free(r->c);
}

void study_repeated_free(repeated_rail *r)
{
    for (int k = 0; k < MC_CHANGES; k++) changed_free(&r->changed[k]);
    changed_free(&r->bare);
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
static double largest(const mc_along *a, mc_change change, double slowest)
{
    double most = 0.0;
    for (int k = 0; k <= MC_PLACES; k++)
        if (a->v[k] >= slowest) most = fmax(most, a->left[change][k]);
    return most;
}

static bool is_carried(const case_onset *c, mc_change change)
{
    if (change == MC_METAL) return !isnan(c->study.deposit_kept);
    bool wears = change == MC_WARMTH;
    for (int i = 0; i < c->impact.rail.layers.n; i++) wears = wears || !isnan(c->impact.rail.layers.item[i].wear_rate);
    return wears;
}

/* What is known from shot to shot. */
typedef struct {
    warm_rail warm;
    rail_left last;                /* by the last flight */
    double pressed[MC_PLACES + 1]; /* by all shots so far [N/m] */
} flights;

/* What shot `number` finds of the one before. */
static void carry_on(const case_onset *c, flights *f, mc_along *along, int number)
{
    for (int k = 0; k <= MC_PLACES; k++) {
        double *metal = &along[number].left[MC_METAL][k];
        f->pressed[k] += f->last.pressed[k];
        along[number].left[MC_WARMTH][k] = rise_at(f->warm.rise, (double)k / MC_PLACES);
        along[number].left[MC_WEAR][k] = study_layers_worn(&c->impact.rail.layers, f->pressed[k]);
        *metal = is_carried(c, MC_METAL) ? c->study.deposit_kept * (*metal + f->last.metal[k]) : 0.0;
    }
}

/* The next shot, through rails that are warmer in the mean; the same flight as the last where they hardly are. */
static status fly(session *s, flights *f, repeated_rail *out)
{
    const case_onset *c = f->warm.c;
    const int number = f->warm.number;
    bool is_flown;
    shot_outcome flown;
    shot_record record;
    TRY(study_warm_rail_shoot(s, &f->warm, &is_flown, &flown, &record));
    out->along[number] = out->along[number - 1];
    out->shot[number].muzzle_velocity = out->shot[number - 1].muzzle_velocity;
    carry_on(c, f, out->along, number);
    if (is_flown) {
        study_mc_velocities(&flown, c->launcher.barrel.length, out->along[number].v);
        study_rail_left_of(c, &flown, &f->last);
        out->shot[number].muzzle_velocity = record.is.muzzle_velocity;
        gouge_shot_outcome_free(&flown);
    }
    for (int k = 0; k < MC_CHANGES; k++)
        out->shot[number].most[k] = is_carried(c, k) ? largest(&out->along[number], k, c->study.velocity_low) : NAN;
    return status_ok();
}

static status fly_all(session *s, const grain_families *first, const shot_record *flight, repeated_rail *out)
{
    flights *f = calloc(1, sizeof *f);
    CHECK(f, STATUS_MEMORY, "no memory for %d shots", out->shots);
    f->warm = study_warm_rail_begin(first->c, first->flown);
    study_rail_left_of(first->c, first->flown, &f->last);
    study_mc_velocities(first->flown, first->c->launcher.barrel.length, out->along[0].v);
    out->shot[0].muzzle_velocity = flight->is.muzzle_velocity;
    for (int k = 0; k < MC_CHANGES; k++) out->shot[0].most[k] = is_carried(first->c, k) ? 0.0 : NAN;
    status done = status_ok();
    while (done.code == STATUS_OK && f->warm.number < out->shots) done = fly(s, f, out);
    free(f);
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
static status begin_rail(const grain_families *first, const char *name, changed_rail *out)
{
    out->c = malloc(sizeof *out->c);
    CHECK(out->c, STATUS_MEMORY, "no memory for a case");
    *out->c = *first->c;
    snprintf(out->prefix, sizeof out->prefix, "%s%s-", first->prefix, name);
    return status_ok();
}

/* The widest cell of the searches of grains of their middle size [m] */
static double widest_cell(const grain_families *f)
{
    double radius = 0.0;
    for (int k = 0; k < f->n; k++) radius = fmax(radius, f->family[k].plan.size[f->family[k].plan.reference]);
    return radius / f->c->study.fine_cells_per_radius;
}

/* Is the armature's metal thick enough for scenes?  Said where it is not. */
static bool is_resolved(session *s, const grain_families *first, double thickness)
{
    const double cell = widest_cell(first);
    if (gouge_cells_across(&first->c->impact.scene, cell, thickness) >= 1.0) return true;
    run_session_warn(
        s,
        "study.shots: armature metal on the rail, %.3g um at most, is thinner than a cell of %.3g um and has none "
        "of its own (scene.cells_per_layer): the thresholds are those without it",
        1e6 * thickness, 1e6 * cell);
    return false;
}

static void warn_of_unworn(session *s, const case_onset *c)
{
    for (int i = 0; i < c->impact.rail.layers.n; i++)
        if (isnan(c->impact.rail.layers.item[i].wear_rate))
            run_session_warn(s,
                             "study.shots: a layer of %s has no wear_rate: only gouges wear it, and what is below it",
                             c->impact.rail.layers.item[i].material);
}

static status lay_metal(const case_onset *c, double thickness, case_layers *out)
{
    case_layer metal = {
        .thickness = thickness, .bond_strength = NAN, .yield_scale = 1.0, .cold_work = NAN, .wear_rate = NAN
    };
    memcpy(metal.material, c->impact.armature.material, sizeof metal.material);
    TRY(study_layers_without(&c->impact.rail.layers, 0.0, out));
    return case_layers_add(out, out->n, &metal);
}

/* Largest of all shots where the armature is fast enough to be looked at; NAN: not carried on [K, m, m] */
static double most_of(const repeated_rail *r, mc_change change)
{
    double most = NAN;
    for (int k = 0; k < r->shots; k++) most = fmax(most, r->shot[k].most[change]);
    return most;
}

/* The rail where it is changed most. */
static status change(const grain_families *first, mc_change how, double most, changed_rail *out)
{
    TRY(begin_rail(first, NAMES[how], out));
    out->most = most;
    if (how == MC_WARMTH) {
        const double rounded = RISE_STEP * ceil(most / RISE_STEP);
        if (rounded < study_warm_rail_melting_rise(first->c)) out->most = rounded;
        out->c->impact.rail.temperature += out->most;
    } else {
        TRY(how == MC_WEAR ? study_layers_without(&first->c->impact.rail.layers, most, &out->layers)
                           : lay_metal(first->c, most, &out->layers));
        out->c->impact.rail.layers = out->layers;
    }
    return study_families_sort(out->c, first->flown, out->prefix, &out->grains);
}

status study_repeated_want(session *s, const grain_families *first, repeated_rail *out, grain_families **wanted, int *n)
{
    *n = 0;
    if (out->shots == 0) return status_ok();
    warn_of_unworn(s, first->c);
    const bool is_met = deepest_gouge(first) > 0.0 || is_renewed(first);
    for (int k = 0; k < MC_CHANGES; k++) {
        const double most = most_of(out, k);
        if (!(is_met && most >= LEAST[k]) || (k == MC_METAL && !is_resolved(s, first, most))) continue;
        TRY(change(first, k, most, &out->changed[k]));
        wanted[(*n)++] = &out->changed[k].grains;
    }
    if (wears_layers_through(first)) {
        TRY(begin_rail(first, "bare", &out->bare));
        out->bare.c->impact.rail.layers.n = 0;
        TRY(study_families_sort(out->bare.c, first->flown, out->bare.prefix, &out->bare.grains));
        wanted[(*n)++] = &out->bare.grains;
    }
    return status_ok();
}

void study_repeated_found(repeated_rail *r, const grain_families *first, const uncertain_inputs *u)
{
    for (int k = 0; k <= MC_CHANGES; k++) {
        grain_families *found = k < MC_CHANGES ? &r->changed[k].grains : &r->bare.grains;
        study_uncertain_widen(u, first, found);
        found->prefix = "";
    }
}

mc_surface study_repeated_surface(const repeated_rail *r, const grain_families *first)
{
    mc_surface out = {
        .grains = first, .size_factor = 1.0, .along = r->along, .bare = r->bare.c ? &r->bare.grains : NULL
    };
    for (int k = 0; k < MC_CHANGES; k++)
        out.changed[k] = (mc_changed){ r->changed[k].c ? &r->changed[k].grains : NULL, r->changed[k].most };
    return out;
}

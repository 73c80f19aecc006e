/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/repeated.h"
#include "coupling/gouge/session_shot.h"

#include "coupling/study/sampling/gouge_law.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double LEAST_RISE = 10.0;  /* below, a threshold moves by less than 0.5 % (docs/theory/onset.md) [K] */
static const double RISE_STEP = 25.0;   /* so that scenes are shared [K] */
static const double NEAR_MELTING = 0.8; /* of the rise to melting, by the first shot alone */
static const double SAME_FLIGHT = 1.0;  /* of the rails' mean temperature [K] */

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

typedef double rises[CIRCUIT_SHOT_PIECES];

static double mean_of(const rises rise)
{
    double sum = 0.0;
    for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++) sum += rise[k];
    return sum / CIRCUIT_SHOT_PIECES;
}

/* Of the piece's middles linearly, even before the first and after the last. */
static double rise_at(const rises rise, double share_of_barrel)
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

/* Rise at which the rail melts. */
static double melting_rise(const case_onset *c)
{
    return case_material(&c->impact.materials, c->impact.rail.material)->melting_temperature -
           c->impact.rail.temperature;
}

static status no_melting(const case_onset *c, int number, const rises rise)
{
    const double melting = melting_rise(c);
    for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++)
        CHECK(rise[k] < melting, STATUS_BAD_INPUT,
              "study.shots: shot %d would find the rail at %.0f K %.3g m from the breech, %s melts at %.0f K; lower "
              "study.shots or study.heat_kept = %g",
              number, c->impact.rail.temperature + rise[k], (k + 0.5) * c->launcher.barrel.length / CIRCUIT_SHOT_PIECES,
              c->impact.rail.material, c->impact.rail.temperature + melting, c->study.heat_kept);
    return status_ok();
}

/* The shot of this number, from 1, through rails that are warmer in the mean; the same flight as the last where they
 * hardly are. */
static status fly(session *s, const case_onset *c, int number, const rises rise, double *flown_at, rises left,
                  repeated_rail *out)
{
    const double mean = mean_of(rise);
    out->along[number] = out->along[number - 1];
    out->shot[number].muzzle_velocity = out->shot[number - 1].muzzle_velocity;
    if (fabs(mean - *flown_at) < SAME_FLIGHT) return status_ok();
    case_flight warm = case_flight_of(c);
    shot_outcome flown;
    shot_record record;
    warm.launcher.rails.initial_temperature += mean;
    const status done = gouge_session_shot(s, &warm, NULL, false, &flown, &record);
    if (done.code == STATUS_OK) {
        study_mc_velocities(&flown, c->launcher.barrel.length, out->along[number].v);
        out->shot[number].muzzle_velocity = record.is.muzzle_velocity;
        memcpy(left, flown.rail_rise, sizeof(rises));
        *flown_at = mean;
    }
    gouge_shot_outcome_free(&flown);
    return done;
}

static status fly_all(session *s, const grain_families *first, const shot_record *flight, repeated_rail *out)
{
    const case_onset *c = first->c;
    rises rise = { 0.0 }, left;
    double flown_at = 0.0;
    memcpy(left, first->flown->rail_rise, sizeof left);
    study_mc_velocities(first->flown, c->launcher.barrel.length, out->along[0].v);
    out->shot[0].muzzle_velocity = flight->is.muzzle_velocity;
    for (int n = 1; n < out->shots; n++) {
        for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++) rise[k] = c->study.heat_kept * (rise[k] + left[k]);
        TRY(no_melting(c, n + 1, rise));
        TRY(fly(s, c, n, rise, &flown_at, left, out));
        for (int k = 0; k <= MC_PLACES; k++) out->along[n].rise[k] = rise_at(rise, (double)k / MC_PLACES);
        out->shot[n].rise = warmest(&out->along[n], c->study.velocity_low);
        out->rise = fmax(out->rise, out->shot[n].rise);
    }
    return status_ok();
}

/* Would the rail come near melting if every shot left what the first one leaves? */
static bool may_melt(const case_onset *c, const rises left)
{
    double rise = 0.0, most = 0.0;
    for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++) most = fmax(most, left[k]);
    for (int n = 1; n < c->study.shots; n++) rise = c->study.heat_kept * (rise + most);
    return rise > NEAR_MELTING * melting_rise(c);
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
    for (int k = 0; k < f->n; k++)
        depth = fmax(depth, study_gouge_law_depth(&f->family[k], f->c->impact.scene.limit_severity));
    return depth;
}

/* A copy of what the first shot was given, to be changed. */
static status copy_case(const grain_families *first, case_onset **out)
{
    *out = malloc(sizeof **out);
    CHECK(*out, STATUS_MEMORY, "no memory for a case");
    **out = *first->c;
    return status_ok();
}

status study_repeated_search(session *s, const grain_families *first, repeated_rail *out)
{
    if (out->shots == 0) return status_ok();
    const double depth = deepest_gouge(first);
    const bool warm = out->rise >= LEAST_RISE && (depth > 0.0 || is_renewed(first));
    const bool bare =
        first->c->impact.rail.layers.n > 0 && depth > case_layers_thickness(&first->c->impact.rail.layers);
    grain_families *all[2];
    int n = 0;
    const double rounded = RISE_STEP * ceil(out->rise / RISE_STEP);
    if (!warm || rounded < melting_rise(first->c)) out->rise = warm ? rounded : 0.0;
    if (warm) {
        TRY(copy_case(first, &out->warm_case));
        out->warm_case->impact.rail.temperature += out->rise;
        TRY(study_families_sort(out->warm_case, first->flown, "warm-", &out->warm));
        all[n++] = &out->warm;
    }
    if (bare) {
        TRY(copy_case(first, &out->bare_case));
        out->bare_case->impact.rail.layers.n = 0;
        TRY(study_families_sort(out->bare_case, first->flown, "bare-", &out->bare));
        all[n++] = &out->bare;
    }
    return n > 0 ? study_families_search(s, all, n) : status_ok();
}

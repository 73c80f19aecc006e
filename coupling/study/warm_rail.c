/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/warm_rail.h"

#include <math.h>
#include <string.h>

static const double SAME_FLIGHT = 1.0;  /* of the rails' mean temperature [K] */
static const double NEAR_MELTING = 0.8; /* of the rise to melting, by the first shot alone */

static double mean_of(const double rise[CIRCUIT_SHOT_PIECES])
{
    double sum = 0.0;
    for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++) sum += rise[k];
    return sum / CIRCUIT_SHOT_PIECES;
}

/* Of the circuit's rail and of the scenes', where a case gives them apart the warmer [K] */
static double temperature_of(const case_onset *c)
{
    return fmax(c->launcher.rails.initial_temperature, c->impact.rail.temperature);
}

double study_warm_rail_melting_rise(const case_onset *c)
{
    const mpm_material *rail = case_material(&c->impact.materials, c->impact.rail.material);
    return rail && !isnan(rail->melting_temperature) ? rail->melting_temperature - temperature_of(c) : INFINITY;
}

static status no_melting(const warm_rail *w)
{
    const case_onset *c = w->c;
    const double melting = study_warm_rail_melting_rise(c), cold = temperature_of(c);
    for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++)
        CHECK(w->rise[k] < melting, STATUS_BAD_INPUT,
              "study.shots: shot %d would find the rail at %.0f K %.3g m from the breech, %s melts at %.0f K; lower "
              "study.shots or study.heat_kept = %g",
              w->number, cold + w->rise[k], (k + 0.5) * c->launcher.barrel.length / CIRCUIT_SHOT_PIECES,
              c->impact.rail.material, cold + melting, c->study.heat_kept);
    return status_ok();
}

warm_rail study_warm_rail_begin(const case_onset *c, const shot_outcome *flown)
{
    warm_rail w = { .c = c, .number = 1 };
    memcpy(w.left, flown->rail_rise, sizeof w.left);
    return w;
}

status study_warm_rail_shoot(session *s, warm_rail *w, bool *is_flown, shot_outcome *out, shot_record *record)
{
    w->number++;
    for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++) w->rise[k] = w->c->study.heat_kept * (w->rise[k] + w->left[k]);
    TRY(no_melting(w));
    const double mean = mean_of(w->rise);
    *is_flown = fabs(mean - w->flown_at) >= SAME_FLIGHT;
    if (!*is_flown) return status_ok();
    case_flight flight = case_flight_of(w->c);
    flight.launcher.rails.initial_temperature += mean;
    const status done = gouge_session_shot(s, &flight, NULL, false, out, record);
    if (done.code == STATUS_OK) {
        memcpy(w->left, out->rail_rise, sizeof w->left);
        w->flown_at = mean;
    } else {
        gouge_shot_outcome_free(out);
    }
    return done;
}

/* Would the rail come near melting if every shot left what the first one leaves? */
static bool may_melt(const case_onset *c, const double left[CIRCUIT_SHOT_PIECES])
{
    double rise = 0.0, most = 0.0;
    for (int k = 0; k < CIRCUIT_SHOT_PIECES; k++) most = fmax(most, left[k]);
    for (int n = 1; n < c->study.shots; n++) rise = c->study.heat_kept * (rise + most);
    return rise > NEAR_MELTING * study_warm_rail_melting_rise(c);
}

status study_warm_rail_follows(session *s, const case_onset *c, const shot_outcome *flown)
{
    if (c->study.shots < 2 || !may_melt(c, flown->rail_rise)) return status_ok();
    warm_rail w = study_warm_rail_begin(c, flown);
    while (w.number < c->study.shots) {
        bool is_flown;
        shot_outcome out;
        shot_record record;
        TRY(study_warm_rail_shoot(s, &w, &is_flown, &out, &record));
        if (is_flown) gouge_shot_outcome_free(&out);
    }
    return status_ok();
}

status study_warm_rail_possible(const case_onset *c)
{
    if (c->study.shots < 2) return status_ok();
    session silent = { .threads = 1 };
    const case_flight flight = case_flight_of(c);
    shot_outcome flown;
    shot_record record;
    host_progress_open(&silent.progress, stderr, true);
    host_timing_open(&silent.timing);
    status s = gouge_session_shot(&silent, &flight, NULL, false, &flown, &record);
    if (s.code == STATUS_OK) s = study_warm_rail_follows(&silent, c, &flown);
    gouge_shot_outcome_free(&flown);
    return s.code == STATUS_BAD_INPUT ? s : status_ok(); /* the run tells what else may happen */
}

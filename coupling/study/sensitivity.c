/* SPDX-License-Identifier: BSD-3-Clause */
#include "coupling/study/sensitivity.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double CHANGE = 0.05; /* relative */

typedef struct {
    const char *input;
    void (*change)(circuit_shot_config *c, double factor); /* of a copy; NULL: the grains' size */
} changed_input;

/* Of a launcher whose supplies are copies (own_supplies). */
static void change_charge(circuit_shot_config *c, double factor)
{
    for (int k = 0; k < CIRCUIT_SUPPLY_KINDS; k++)
        circuit_supply_recharge((circuit_supply_kind_index)k, (void *)c->supplies[k].item, c->supplies[k].n, factor);
}

static void change_mass(circuit_shot_config *c, double factor)
{
    c->armature.mass *= factor;
}

static void change_friction(circuit_shot_config *c, double factor)
{
    c->armature.friction_dry *= factor;
    c->armature.friction_melted *= factor;
    c->armature.film_viscosity *= factor;
}

static const changed_input inputs[] = {
    { "charge of the supplies", change_charge }, /* a coil's battery and a given current too */
    { "armature.mass", change_mass },
    { NULL, change_friction }, /* named by its keys: friction_keys */
    { "grain size", NULL },
};
enum { INPUTS = sizeof inputs / sizeof inputs[0], MOST = INPUTS + UNCERTAIN_MAX };

/* The keys of the case that the law of friction reads. */
static const char *friction_keys(const circuit_shot_armature *a)
{
    return a->friction_law == CIRCUIT_SHOT_FRICTION_FILM ? "armature.friction_dry, armature.film_viscosity"
                                                         : "armature.friction_dry, armature.friction_melted";
}

/* Copies of the supplies that can be changed; copy[] is owned. */
static status own_supplies(circuit_shot_config *c, void *copy[CIRCUIT_SUPPLY_KINDS])
{
    for (int k = 0; k < CIRCUIT_SUPPLY_KINDS; k++) {
        const size_t bytes = (size_t)c->supplies[k].n * circuit_supply_size((circuit_supply_kind_index)k);
        if (bytes == 0) continue;
        copy[k] = malloc(bytes);
        CHECK(copy[k], STATUS_MEMORY, "no memory for the supplies");
        memcpy(copy[k], c->supplies[k].item, bytes);
        c->supplies[k].item = copy[k];
    }
    return status_ok();
}

/* The shot with one input changed; of grain size the shot as it was. */
static status fly_changed(session *s, const onset_answer *a, const changed_input *input, shot_outcome *flown,
                          shot_record *record)
{
    case_flight flight = case_flight_of(a->grains.c);
    void *copy[CIRCUIT_SUPPLY_KINDS] = { NULL };
    *record = a->shot;
    if (!input->change) return status_ok();
    status done = own_supplies(&flight.launcher, copy);
    if (done.code == STATUS_OK) {
        input->change(&flight.launcher, 1.0 + CHANGE);
        done = gouge_session_shot(s, &flight, NULL, false, flown, record);
    }
    for (int k = 0; k < CIRCUIT_SUPPLY_KINDS; k++) free(copy[k]);
    return done;
}

/* An input changed: of the shot (the same grains in another one), or of the scenes (other thresholds). */
typedef struct {
    const char *input;
    double change;
    shot_outcome flown; /* owned; empty where the shot is as it was */
    shot_record record;
    grain_families grains; /* borrows */
    double size_factor;
} changed;

static void conclude(const onset_answer *a, const changed *with, const mc_result *drawn, int k)
{
    onset_sensitivity *out = &a->sensitivity[k];
    double radius;
    const grain_family *leading = study_onset_leading_grain(a, &radius);
    const grain_family *f = leading ? study_family_alike(&with->grains, leading) : NULL;
    const double v = f ? study_surface_at(&f->surface, with->size_factor * radius).velocity : NAN;
    snprintf(out->input, sizeof out->input, "%s", with->input);
    out->change = with->change;
    out->muzzle_velocity = with->record.is.muzzle_velocity;
    out->threshold_velocity = v;
    out->threshold_position = gouge_trace_place(with->grains.flown, v);
    /* of both the mean over the same random numbers: what differs is the input's doing */
    out->expected_gouges = a->result.expected_gouges + (drawn->of[k + 1].gouges - drawn->of[0].gouges);
}

static status draw_all(session *s, const onset_answer *a, const changed *with, int n, mc_result *drawn)
{
    const case_onset *c = a->grains.c;
    mc_surface surface[MOST + 1] = { { .grains = &a->grains, .size_factor = 1.0 } };
    for (int k = 0; k < n; k++)
        surface[k + 1] = (mc_surface){ .grains = &with[k].grains, .size_factor = with[k].size_factor };
    const mc_plan plan = { .histories = c->study.sampled / 10 + 1,
                           .shots = 1,
                           .seed = c->study.seed,
                           .length = c->launcher.barrel.length,
                           .n = n + 1,
                           .surface = surface,
                           .stop = s->stop,
                           .progress = &s->progress };
    return study_mc_run(&plan, drawn);
}

/* The shots with each input changed, then the searches with each uncertain one. */
static status change_all(session *s, onset_answer *a, changed *with)
{
    for (int k = 0; k < INPUTS; k++) {
        changed *to = &with[k];
        TRY(fly_changed(s, a, &inputs[k], &to->flown, &to->record));
        to->input = inputs[k].input ? inputs[k].input : friction_keys(&a->grains.c->launcher.armature);
        to->change = CHANGE;
        to->grains = a->grains;
        to->grains.flown = inputs[k].change ? &to->flown : &a->flown;
        to->size_factor = inputs[k].change ? 1.0 : 1.0 + CHANGE;
    }
    for (int k = 0; k < a->uncertain.n; k++) {
        const uncertain_input *u = &a->uncertain.of[k];
        with[INPUTS + k] = (changed){
            .input = u->input, .change = u->change, .record = a->shot, .grains = u->grains, .size_factor = 1.0
        };
    }
    return status_ok();
}

status study_sensitivities_run(session *s, onset_answer *a)
{
    const int n = INPUTS + a->uncertain.n;
    changed with[MOST] = { { .input = NULL } };
    mc_result drawn = { .of = NULL };
    if (!a->grains.c->study.sensitivities || a->grains.n == 0) return status_ok();
    a->sensitivity = calloc((size_t)n, sizeof *a->sensitivity);
    CHECK(a->sensitivity, STATUS_MEMORY, "no memory for the sensitivities");
    status done = change_all(s, a, with);
    if (done.code == STATUS_OK) done = draw_all(s, a, with, n, &drawn);
    if (done.code == STATUS_OK) {
        for (int k = 0; k < n; k++) conclude(a, &with[k], &drawn, k);
        a->result.sensitivities = a->sensitivity;
        a->result.n_sensitivities = n;
    }
    for (int k = 0; k < n; k++) gouge_shot_outcome_free(&with[k].flown);
    study_mc_free(&drawn);
    return done;
}

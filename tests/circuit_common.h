/* SPDX-License-Identifier: BSD-3-Clause */
/* Shots for tests and benchmarks: the 200 kJ unit of cases/pulse_unit_200kJ, a plain barrel, a notebook of events. */
#ifndef BREECH_TESTS_CIRCUIT_COMMON_H
#define BREECH_TESTS_CIRCUIT_COMMON_H

#include "circuit/shot.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    int n, count[CIRCUIT_SHOT_EVENT_COUNT];
    double time[CIRCUIT_SHOT_EVENT_COUNT]; /* of the last event of each kind [s] */
    double worst_error;                    /* of the energy, over what was given by the end [1] */
    double most;                           /* given so far [J] */
    double worst;                          /* |energy error| x given so far [J] */
} shot_notes;

static inline bool note_event(void *user, circuit_shot *s, const circuit_shot_event *e)
{
    shot_notes *notes = user;
    (void)s;
    notes->n++;
    notes->count[e->kind]++;
    notes->time[e->kind] = e->state.t;
    return true;
}

static inline bool note_sample(void *user, const circuit_shot *s, const circuit_shot_state *state)
{
    shot_notes *notes = user;
    const double given = state->ledger.start + state->ledger.supplied;
    (void)s;
    notes->most = fmax(notes->most, given);
    notes->worst = fmax(notes->worst, fabs(state->ledger.energy_error) * given);
    notes->worst_error = notes->most > 0.0 ? notes->worst / notes->most : 0.0;
    return true;
}

static inline circuit_shot_sink notes_sink(shot_notes *notes)
{
    memset(notes, 0, sizeof *notes);
    return (circuit_shot_sink){ note_event, note_sample, notes };
}

static inline circuit_shot_module unit_200kJ(int count, double fire_at)
{
    circuit_shot_module m;
    base_params_default(circuit_supply_capacitor_params, &m);
    m.count = count;
    m.capacitance = 3.594e-3;
    m.charge = 10.55e3;
    m.inductance = 12.56e-6;
    m.resistance = 4.10e-3;
    m.crowbar_drop = 1.48;
    m.crowbar_resistance = 0.43e-3;
    m.fire_at = fire_at;
    return m;
}

/* 25 x 20 x 25 mm rails of constant gradients, a 0.25 kg armature with all losses but wear, 5 m; nothing drives it yet.
 */
static inline circuit_shot_config plain_barrel(void)
{
    circuit_shot_config c = { .n_sites = 0 };
    base_params_default(circuit_shot_rails_params, &c.rails);
    base_params_default(circuit_shot_barrel_params, &c.barrel);
    base_params_default(circuit_shot_armature_params, &c.armature);
    base_params_default(circuit_shot_options_params, &c.options);
    c.rails.level = CIRCUIT_SHOT_RAILS_CONSTANT;
    c.rails.height = 0.025;
    c.rails.thickness = 0.020;
    c.rails.separation = 0.025;
    c.rails.inductance_gradient = 0.5e-6;
    c.rails.resistance_gradient = 1e-4;
    c.barrel.length = 5.0;
    c.barrel.start = 0.1;
    c.armature.mass = 0.25;
    c.armature.resistance = 20e-6;
    c.armature.contact_voltage = 30.0;
    c.armature.friction_dry = 0.3;
    c.armature.friction_melted = 0.05;
    c.armature.preload = 5e3;
    c.armature.spreading = 3e-8;
    return c;
}

enum { DEFAULT_SHOT_GROUPS = 13 };

/* The shot of cases/default_shot: fifteen units, three at the start, then one every 0.22 ms; its rails and armature. */
static inline circuit_shot_config default_shot(circuit_shot_module modules[DEFAULT_SHOT_GROUPS])
{
    circuit_shot_config c = plain_barrel();
    for (int k = 0; k < DEFAULT_SHOT_GROUPS; k++) {
        modules[k] = unit_200kJ(k == 0 ? 3 : 1, 0.22e-3 * k);
        modules[k].cable_inductance = 1e-6;
        modules[k].cable_resistance = 1e-3;
    }
    c.supplies[CIRCUIT_SUPPLY_capacitor] = (circuit_supply_list){ DEFAULT_SHOT_GROUPS, modules };
    base_params_default(circuit_shot_rails_params, &c.rails);
    c.rails.height = c.rails.separation = 0.025;
    c.rails.thickness = 0.020;
    c.barrel.length = 3.0;
    c.armature.preload = 3.1e3;
    c.armature.spreading = 8e-9;
    c.armature.contact_length = 16.5e-3;
    c.armature.contact_width = 25e-3;
    return c;
}

/* Rails of no length and an armature that nothing moves: a short circuit. */
static inline circuit_shot_config short_circuit(void)
{
    circuit_shot_config c = plain_barrel();
    c.barrel.start = 0.0;
    c.armature.preload = 1e9;
    c.armature.resistance = 0.0;
    c.armature.contact_voltage = 0.0;
    return c;
}

/* Largest distance of a shot's current from a published pulse (rows `t,i`, others are skipped) over the pulse's peak;
 * NaN: no such file, or the shot stopped. */
static inline double pulse_misfit(circuit_shot *s, const char *path, int *rows)
{
    FILE *file = fopen(path, "r");
    char line[200];
    double t, i, worst = 0.0, peak = 0.0;
    bool fine = file != NULL;
    *rows = 0;
    while (fine && fgets(line, sizeof line, file)) {
        if (sscanf(line, "%lf,%lf", &t, &i) != 2) continue;
        fine = circuit_shot_advance(s, t, NULL).code == STATUS_OK;
        worst = fmax(worst, fabs(circuit_shot_now(s).current - i));
        peak = fmax(peak, i);
        ++*rows;
    }
    if (file) fclose(file);
    return fine ? worst / peak : NAN;
}

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* A shot under way, and who does what to it (internal to circuit/):
 *   shot_create.c  makes it from its configuration        shot.c         drives the integration, hands out events
 *   shot_switch.c  switchings of supplies and armature    shot_state.c   reads it: ledger, state, summary
 *   shot_limits.c  temperatures and limits                    shot_heat.c    heat left in the rails */
#ifndef BREECH_CIRCUIT_SHOT_INTERNAL_H
#define BREECH_CIRCUIT_SHOT_INTERNAL_H

#include "circuit/armature/lead_face.h"
#include "circuit/dae.h"
#include "circuit/rails/rails_heat.h"
#include "circuit/shot_model.h"

/* Times closer than this are one instant [s]. */
#define SHOT_INSTANT 1e-12

typedef struct {
    circuit_shot_event_kind kind;
    int index;
} pending;

typedef struct {
    double position;
    int index; /* in the order given */
} shot_place;

/* What the rails' heat by place needs of an accepted step. */
typedef struct {
    double t, x, v, shunt;
    double contact;           /* of the contact's heat and friction so far, what went into the rails [J] */
    double I[SHOT_MAX_FEEDS]; /* of every segment behind the armature [A] */
} shot_heat_instant;

struct circuit_shot {
    shot_model model;
    circuit_shot_options options;
    dae *solver;
    arrow *matrix;
    void *supplies;    /* the groups' parameters, SUPPLY_BYTES each */
    shot_place *sites; /* by position */
    pending *queue;    /* events not yet handed out: queue[head] .. queue[tail - 1] */
    double *scale;     /* of every unknown */
    double *later;     /* room for the first step: unknowns, rates */
    bool *forced;      /* groups that a root says conduct now; then room for the firing, two times as long */
    int n_sites, passed, head, tail, capacity;
    int switchings, switchings_limit;
    bool restart, started;
    double t, rail_temperature, armature_temperature;
    double start_energy, exit_action;
    circuit_shot_rails rails; /* their section and metal, as given */
    double sheet;             /* P of (C-17): mean surface current of a rail over I/height [1] */
    circuit_shot_limits limits;
    circuit_lead_face lead_face;
    double worn, wear_rate, worn_until; /* velocity skin effect: thickness off the trailing edge [m], [m/s], [s] */
    circuit_rails_heat heat;
    double rail_capacity; /* of all rails [J/K/m] */
    shot_heat_instant heat_until;
    double momentum_jumps, mass_jumps, energy_jumps;
    double exit_kinetic, last_current, last_slope, last_t;
    circuit_shot_summary result;
    circuit_shot_state at_exit; /* the last of the armature in the barrel; of zeros before */
};

double *circuit_shot_y(const circuit_shot *s); /* all unknowns */
double *circuit_shot_z(const circuit_shot *s); /* the tail's */
shot_drive circuit_shot_drive_now(const circuit_shot *s);
shot_forces circuit_shot_forces_now(const circuit_shot *s);
circuit_shot_ledger circuit_shot_ledger_now(const circuit_shot *s);

/* ---- temperatures and limits; *st as far as it is filled before them ---- */

double circuit_shot_face_temperature(const circuit_shot *s, const shot_forces *f); /* [K] */
void circuit_shot_lead_face_start(circuit_shot *s);
void circuit_shot_lead_face_update(circuit_shot *s, const shot_forces *f); /* after every accepted step */
double circuit_shot_lead_face_temperature(const circuit_shot *s);          /* NAN: no throat_area [K] */
double circuit_shot_film_thickness(const circuit_shot *s, const shot_forces *f, const circuit_shot_state *st); /* [m] */
double circuit_shot_film_temperature(const circuit_shot *s, const shot_forces *f,
                                     const circuit_shot_state *st);                                       /* [K] */
double circuit_shot_rail_flux(const circuit_shot *s, const shot_forces *f, const circuit_shot_state *st); /* [W/m^2] */
status circuit_shot_rail_sheet_start(circuit_shot *s);
double circuit_shot_rail_sheet(const circuit_shot *s, const circuit_shot_state *st); /* [A/m] */
double circuit_shot_rail_behind_temperature(const circuit_shot *s, const shot_forces *f,
                                            const circuit_shot_state *st); /* [K] */
void circuit_shot_limits_start(circuit_shot *s);
void circuit_shot_limits_update(circuit_shot *s, const shot_forces *f);

/* ---- heat left in the rails ---- */

status circuit_shot_heat_start(circuit_shot *s, const circuit_shot_config *c);
void circuit_shot_heat_update(circuit_shot *s, const shot_drive *d); /* after every accepted step */

/* ---- switchings ---- */

/* All that is due now: `found` as circuit_dae_found, NULL where no root was reported.  Asks for a restart where
 * something switched. */
void circuit_shot_settle(circuit_shot *s, const int *found);
bool circuit_shot_any_current(const circuit_shot *s);
double circuit_shot_next_firing(const circuit_shot *s); /* infinite: none */
/* At rest after a stop: held where the current's push is too weak, else free again. */
void circuit_shot_come_to_rest(circuit_shot *s);

#endif

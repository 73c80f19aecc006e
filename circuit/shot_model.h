/* SPDX-License-Identifier: BSD-3-Clause */
/* The equations of a shot between two switchings (internal to circuit/; their tags: docs/theory/circuit.md).
 *
 * Unknowns, in this order: those of every group (circuit/supply/supply_kind.h), then the tail z: those of shot_unknown,
 * the voltages of the feeds after the breech, and the rails' memory, two a rung (circuit/rails/rails.h) of every
 * segment. Feed f is a position at which groups join the rails, feed 0 the breech; segment f runs from there to the
 * next feed, or as far as the armature has come.  A group does not conduct before the armature has passed its feed.
 * A switching changes gate, stage, phase or `reached`, never the list of unknowns. */
#ifndef BREECH_CIRCUIT_SHOT_MODEL_H
#define BREECH_CIRCUIT_SHOT_MODEL_H

#include "circuit/armature/film.h"
#include "circuit/rails/rails.h"
#include "circuit/shot.h"
#include "circuit/supply/supply_kind.h"

enum { SHOT_MAX_FEEDS = 64 };

typedef enum {
    Y_ACTION, /* integral of the armature's current squared [A^2 s]; from here down to Y_BREECH all is only summed up */
/* Y_COIL ...: energies so far [J], the supplies' heats in the order of supply_heat. */
#define INTEGRAL(place, member, column, text) Y_##place,
#define GIVEN(place, member, column, text) Y_##place,
#include "circuit/ledger.def"
    Y_BREECH, /* voltage [V], algebraic, as those of the other feeds */
    Y_X,      /* [m] */
    Y_V,      /* [m/s] */
    Y_MASS,   /* [kg] */
    Y_SHUNT,  /* current of the muzzle shunt [A] */
    Y_COUNT,
    Y_SUMS = Y_BREECH /* how many are only summed up */
} shot_unknown;

enum {
    ROOT_MOTION,
    ROOT_MELT,
    ROOT_SITE,
    ROOT_MUZZLE,
    ROOT_FEED,
    ROOT_GROUPS
}; /* then two a group: stage or waiting, current */

typedef struct {
    supply_group *groups; /* owned by the shot */
    int n, start;         /* groups; first unknown of the tail */
    double feed[SHOT_MAX_FEEDS];
    int feeds, reached; /* all; those the armature has passed, always at least the breech */
    circuit_shot_barrel barrel;
    circuit_shot_armature armature;
    circuit_rails_load rails;
    double faces; /* contact faces, one a rail; each carries its part of the current, 2/faces [1] */
    double bore_area, contact_area, sound_speed; /* of one contact face; of the gas [m^2, m^2, m/s] */
    double wear_heat;                            /* heat that melts off one kilogram [J/kg] */
    melt_film film;                              /* friction_law film */
    bool melted;                                 /* the armature slides on it */
    double knee;                                 /* of the contact voltage, where currents can reverse; else 0 [A] */
    bool shunt;                                  /* there is one at the muzzle */
    circuit_shot_phase phase;
    double next_site;    /* [m]; infinite when none is left */
    const double *scale; /* of every unknown, for the Jacobian's differences */
} shot_model;

/* What the groups do to the rest: sums over all of them. */
typedef struct {
    bool any;                                                             /* one conducts */
    double I[SHOT_MAX_FEEDS], push[SHOT_MAX_FEEDS], pull[SHOT_MAX_FEEDS]; /* by feed */
    double heat[HEAT_PLACES], supplied, source[SHOT_MAX_FEEDS];           /* source: current of given profiles [A] */
} shot_drive;

typedef struct {
    double I, shunt;                                /* rails' current behind the armature, shunt's ahead of it [A] */
    double R, drop;                                 /* resistance and constant voltage of armature or muzzle arc */
    double voltage;                                 /* across it [V] */
    double force, contact, mu, friction, drag, net; /* [N], mu [1] */
    double film;                                    /* thickness of the melt [m] */
} shot_forces;

int circuit_shot_unknowns(const shot_model *m);
shot_drive circuit_shot_drive_at(const shot_model *m, double t, const double *y);
double circuit_shot_total_current(const shot_drive *d, const shot_model *m);                  /* [A] */
double circuit_shot_current_slope(const shot_model *m, const shot_drive *d, const double *z); /* of the total [A/s] */
int circuit_shot_feed_unknown(int feed);                                              /* of its voltage, in the tail */
status circuit_shot_rails_fit(const circuit_shot_config *c, circuit_rails_load *out); /* circuit/shot_rails.c */
double circuit_shot_rails_field(const shot_model *m, const shot_drive *d, const double *z); /* [J] */
double circuit_shot_rails_warming(const shot_model *m, int f, const double *z);             /* of segment f [1] */

/* ---- the armature: circuit/shot_armature.c ---- */

double circuit_shot_hold_force(const shot_model *m, double I);     /* static friction of all faces [N] */
double circuit_shot_push(const shot_model *m, double v, double I); /* electromagnetic force at the speed v [N] */
shot_forces circuit_shot_forces_at(const shot_model *m, const shot_drive *d, const double *z);
void circuit_shot_armature_rates(const shot_model *m, const double *z, const shot_forces *f, double *q);
double circuit_shot_crowding(const shot_model *m, const shot_forces *f,
                             double v); /* densest current over the mean [1] */
/* Heat per area of one face, both bodies' shares together [W/m^2]. */
double circuit_shot_friction_heat(const shot_model *m, const shot_forces *f, double v);
double circuit_shot_current_heat(const shot_model *m, const shot_forces *f); /* mean over the face */
double circuit_shot_face_rise(const shot_model *m, const shot_forces *f,
                              const double *z); /* above `temperature`, (C-7) [K] */
/* Rises through 0 as the face melts, or as one that is hot enough already sets off: at rest it is solid. */
double circuit_shot_melting(const shot_model *m, const shot_forces *f, const double *z);

/* The feeds' voltages that the currents and the groups' push and pull ask for, into z. */
void circuit_shot_voltages(const shot_model *m, const shot_drive *d, double *z);

/* d[j] = dy_j/dt where y_j is differential, = the value y_j must have where it is algebraic. */
void circuit_shot_rates(const shot_model *m, double t, const double *y, double *d);
bool circuit_shot_is_algebraic(const shot_model *m, int j);

/* For circuit/dae.h. */
void circuit_shot_residual(const void *model, double t, const double *y, const double *yp, double *r);
void circuit_shot_roots(const void *model, double t, const double *y, double *g);
void circuit_shot_jacobian(const void *model, double t, double cj, const double *y, arrow *J);

#endif

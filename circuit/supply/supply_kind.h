/* SPDX-License-Identifier: BSD-3-Clause */
/* What a kind of supply is to the circuit (internal to circuit/).
 *
 * A unit has up to SUPPLY_UNKNOWNS unknowns: y[0] = its current i [A], positive into the rails, the others its own.
 * Between two switchings, V the voltage where it joins the rails,
 *     di/dt = push - pull V,    dy_j/dt = rate_j for j > 0                                      (S-1)
 * or, for an unknown that is algebraic, y_j = rate_j.  A unit that does not conduct has i = 0.
 * Law for every kind, stage and state, which tests/test_circuit_supplies.c checks:
 *     supplied + (source ? V i : 0) - V i - sum of heats = d(stored)/dt,  heats >= 0            (S-2)
 * The gate is the driver's (circuit/shot_switch.c); a stage is the kind's: it ends when `root` falls through zero, and
 * `next` then changes the unknowns to those of the stage that follows. */
#ifndef BREECH_CIRCUIT_SUPPLY_KIND_H
#define BREECH_CIRCUIT_SUPPLY_KIND_H

#include "circuit/arrow.h"
#include "circuit/shot.h"

enum { SUPPLY_UNKNOWNS = ARROW_BLOCK, SUPPLY_BYTES = 512 };

typedef enum { GATE_UNFIRED, GATE_WAITING, GATE_ON, GATE_BLOCKED } supply_gate;

/* HEAT_COIL ... and STORE_CAPACITOR ...: the supplies' places of circuit/ledger.def. */
typedef enum {
#define SUPPLY_HEAT(place, member, column, text) HEAT_##place,
#include "circuit/ledger.def"
    HEAT_PLACES
} supply_heat;
typedef enum {
#define SUPPLY_STORED(place, member, column, text) STORE_##place,
#include "circuit/ledger.def"
    STORE_PLACES
} supply_store;

typedef struct supply_kind supply_kind;

/* A group as it stands. */
typedef struct {
    const supply_kind *kind;
    const void *p;            /* the kind's struct, owned */
    circuit_supply_common at; /* its common part */
    double n;                 /* count as a number */
    void *curve;              /* the kind's own memory, owned; NULL for most */
    supply_gate gate;
    int stage;
    int pulses;    /* times it may still begin to conduct, after the first */
    bool reverses; /* its current may be negative */
    int feed;      /* where it joins the rails: circuit/shot_model.h */
    int first;     /* its first unknown in y */
    int unknowns;
} supply_group;

/* Of one unit. */
typedef struct {
    double push, pull;            /* [A/s, A/s/V] */
    double rate[SUPPLY_UNKNOWNS]; /* rate[0] only where i is algebraic */
    double heat[HEAT_PLACES];     /* [W] */
    double supplied;              /* by a battery [W] */
} supply_flow;

/* What its quantities can reach: scales of the absolute tolerances. */
typedef struct {
    double y[SUPPLY_UNKNOWNS];
    double voltage, energy; /* [V], [J] */
} supply_scale;

struct supply_kind {
    const char *name;
    const base_param *params;
    size_t size;
    size_t charge;  /* offset of the double that it is charged to, or that scales a given current */
    size_t battery; /* offset of the voltage that charges it on; 0: none */
    bool source;    /* the power it gives is that at the rails */
    status (*check)(const void *p, const char *where); /* beyond the table's ranges; NULL: nothing */
    status (*prepare)(supply_group *g);                /* fills curve; NULL: nothing */
    void (*release)(supply_group *g);                  /* frees curve; NULL with prepare */
    int (*unknowns)(const void *p);                    /* 1 .. SUPPLY_UNKNOWNS */
    bool (*reverses)(const void *p);                   /* its current may be negative; NULL: never */
    int (*pulses)(const void *p);                      /* NULL: one */
    bool (*stays)(const supply_group *g);              /* without current it waits for more; NULL: it has ended */
    double (*rise)(const void *p);                     /* time to its peak, roughly [s] */
    void (*start)(const void *p, double *y, supply_scale *scale);                   /* state at t = 0 */
    void (*flow)(const supply_group *g, double t, const double *y, supply_flow *f); /* f comes zeroed */
    bool (*algebraic)(const supply_group *g, int j);                                /* NULL: none */
    double (*scale)(const supply_group *g, int j);                     /* of y_j in this stage; NULL: that of `start` */
    double (*knot)(const supply_group *g, double t);                   /* first time > t not to step over; NULL: none */
    double (*root)(const supply_group *g, double t, const double *y);  /* of order 1; NULL: one stage */
    circuit_shot_event_kind (*next)(supply_group *g, double *y);       /* the stage that follows, and what to call it */
    void (*ended)(const supply_group *g, double *y, double *heat);     /* its current is over for good: what flows on
                                                                          inside it becomes heat [J]; NULL: nothing */
    void (*stored)(const supply_group *g, const double *y, double *e); /* adds to e[STORE_PLACES] [J] */
    double (*voltage)(const supply_group *g, const double *y);         /* of capacitor, switch or machine [V] */
};

/* The line of every kind's table for `position`. */
#define SUPPLY_POSITION(type)                        \
    PARAM_DOUBLE(type, position, "m", 0.0, 0.0, 1e3, \
                 "where it joins the rails, from the breech; conducts once the armature has passed there")

extern const supply_kind *const circuit_supply_kinds[]; /* CIRCUIT_SUPPLY_KINDS */

circuit_supply_common circuit_supply_common_of(const void *p); /* p: any kind's struct */
bool circuit_supply_conducts(const supply_group *g);
/* Its thyristor or diode ends it when its current has come to zero; a given current goes on through zero. */
bool circuit_supply_blocks(const supply_group *g);
/* The group's flow and rates: d[j] = dy_j/dt, or the value y_j must have where it is algebraic. */
void circuit_supply_rates(const supply_group *g, double t, const double *y, double V, double *d, supply_flow *f);
bool circuit_supply_algebraic(const supply_group *g, int j);
double circuit_supply_stage_root(const supply_group *g, double t, const double *y); /* 1 where the stage has no end */

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* What can drive a shot: the parameters of every kind of supply.
 *
 * `count` equal units side by side, fired together, are a group; groups of all kinds stand in parallel on the rails.
 * To add a kind: its struct here, circuit/supply/supply_<kind>.c (the rules: circuit/supply/supply_kind.h), one line in
 * circuit/supply/supply.def. Reader, manual, used.yaml, checks and tests/test_circuit_supplies.c walk the table. */
#ifndef BREECH_CIRCUIT_SUPPLY_H
#define BREECH_CIRCUIT_SUPPLY_H

#include "base/param.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Every kind's struct begins with these. */
#define SUPPLY_COMMON                                   \
    int count;       /* equal units, solved once */     \
    double fire_at;  /* [s]; NAN or infinity = never */ \
    double position; /* where it joins the rails; it conducts once the armature has passed there [m] */

typedef struct {
    SUPPLY_COMMON
} circuit_supply_common;

/* Capacitor, crowbar diode across it, switch, pulse-forming coil, cable to the rails, all in series but the diode.  The
 * gate is held from fire_at until the switch has conducted; with a series diode (or a thyristor for the switch) it is
 * off for good once its current has come back to zero, without one the current may reverse. */
typedef struct {
    SUPPLY_COMMON
    double capacitance;        /* of one module [F] */
    double charge;             /* voltage at t = 0 [V] */
    double inductance;         /* pulse-forming coil [H] */
    double resistance;         /* coil, capacitor and switch in series [ohm] */
    double cable_inductance;   /* [H] */
    double cable_resistance;   /* [ohm] */
    double crowbar_drop;       /* diode's forward drop [V] */
    double crowbar_resistance; /* diode's slope [ohm] */
    bool crowbar;              /* there is a crowbar diode */
    bool series_diode;         /* the current cannot reverse */
    double damping_resistance; /* across the coil [ohm]; NAN = none */
} circuit_shot_module;

/* A coil charged by a battery through a closed switch across the output.  At fire_at the switch opens: its arc holds
 * opening_voltage until the current has gone over into the rails; battery and coil then stay in series with them. */
typedef struct {
    SUPPLY_COMMON
    double inductance;       /* of the store [H] */
    double resistance;       /* of store, battery and leads [ohm] */
    double current;          /* in the store at t = 0 [A] */
    double battery_voltage;  /* open circuit [V] */
    double opening_voltage;  /* across the opening switch while it commutates [V] */
    double cable_inductance; /* [H] */
    double cable_resistance; /* [ohm] */
} circuit_supply_inductor;

/* A disc in a field: voltage flux x speed, torque flux x current. */
typedef struct {
    SUPPLY_COMMON
    double flux;       /* [V s/rad] */
    double inertia;    /* [kg m^2] */
    double speed;      /* at t = 0 [rad/s] */
    double windage;    /* braking torque over speed [N m s/rad] */
    double inductance; /* machine and leads [H] */
    double resistance; /* [ohm] */
} circuit_supply_homopolar;

/* One phase of a pulse alternator (compulsator) behind a thyristor: voltage flux x speed x sin(pole_pairs x angle +
 * phase), at constant excitation.  Gives `pulses` half waves, each from the instant its voltage exceeds that of the
 * rails. */
typedef struct {
    SUPPLY_COMMON
    double flux; /* peak [V s/rad] */
    int pole_pairs;
    double phase;      /* electrical, at t = 0 [rad] */
    int pulses;        /* half waves it is let through for */
    double inertia;    /* [kg m^2] */
    double speed;      /* mechanical, at t = 0 [rad/s] */
    double windage;    /* braking torque over speed [N m s/rad] */
    double inductance; /* compensated winding and leads [H] */
    double resistance; /* [ohm] */
} circuit_supply_alternator;

typedef struct {
    double time, current; /* after fire_at; of one unit [s, A] */
} circuit_supply_point;

/* A current that is given: what the source is does not matter.  Monotone cubic between its points, first and last zero.
 */
typedef struct {
    SUPPLY_COMMON
    double scale;   /* factor on the points' currents [1] */
    char file[400]; /* a path: where the points came from; circuit/ does not open it */
    struct {
        int n;
        circuit_supply_point *item; /* n, times ascending from 0; borrowed until circuit_shot_create returns */
    } points;
} circuit_supply_profile;

typedef enum {
#define SUPPLY(kind, type, section, lists, text) CIRCUIT_SUPPLY_##kind,
#include "circuit/supply/supply.def"
#undef SUPPLY
    CIRCUIT_SUPPLY_KINDS
} circuit_supply_kind_index;

/* The groups of one kind. */
typedef struct {
    int n;
    const void *item; /* n structs of the kind; borrowed until circuit_shot_create returns */
} circuit_supply_list;

/* Keys, units, defaults, ranges and texts, a table a kind. */
#define SUPPLY(kind, type, section, lists, text) extern const base_param circuit_supply_##kind##_params[];
#include "circuit/supply/supply.def"
#undef SUPPLY
extern const base_param circuit_supply_point_params[];

extern const char *const circuit_supply_sections[]; /* of the case file, by kind, NULL at the end */

size_t circuit_supply_size(circuit_supply_kind_index kind); /* of the kind's struct */
/* What n units of a kind are charged to (voltage, current, speed), a battery's voltage or a given current, times
 * `factor`. */
void circuit_supply_recharge(circuit_supply_kind_index kind, void *item, int n, double factor);

#ifndef BREECH_INSIDE
#undef SUPPLY_COMMON
#endif

#ifdef __cplusplus
}
#endif

#endif

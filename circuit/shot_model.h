/* The equations of a shot between two switchings (internal to circuit/; docs/shot.md has them with their tags).
 *
 * Unknowns, in this order: two a group, then those of shot_unknown.
 *   y[2k]      capacitor voltage u [V]; once the crowbar conducts, its current i_D [A] instead, u = -V_d - R_d i_D
 *   y[2k + 1]  module current i [A]
 *   and after shot_unknown's the rails' memory, two a rung (circuit/rails.h)
 * A switching changes `mode` or `phase`, never the list of unknowns. */
#ifndef BREECH_CIRCUIT_SHOT_MODEL_H
#define BREECH_CIRCUIT_SHOT_MODEL_H

#include "circuit/rails.h"
#include "circuit/shot.h"

typedef enum { GROUP_UNFIRED, GROUP_WAITING, GROUP_ON, GROUP_CROWBAR, GROUP_BLOCKED } group_mode;

typedef struct {
    shot_module p;
    double L, R, n; /* coil + cable [H, ohm]; count as a number */
    group_mode mode;
} shot_group;

typedef enum {
    Y_BREECH, /* voltage [V], the algebraic unknown */
    Y_X,      /* [m] */
    Y_V,      /* [m/s] */
    Y_MASS,   /* [kg] */
    Y_ACTION, /* [A^2 s] */
    Y_COIL,   /* this and all below: heat or work so far [J] */
    Y_CABLE,
    Y_CROWBAR,
    Y_RAILS,
    Y_ARMATURE,
    Y_CONTACT,
    Y_FRICTION,
    Y_DRAG,
    Y_MUZZLE,
    Y_WEAR,
    Y_COUNT
} shot_unknown;

enum { ROOT_MOTION, ROOT_SITE, ROOT_MUZZLE, ROOT_GROUPS }; /* then two a group: voltage, current */

typedef struct {
    shot_group *groups; /* owned by the shot */
    int n;
    shot_barrel barrel;
    shot_armature armature;
    rails_load rails;
    double bore_area, contact_area, sound_speed; /* of one contact face; of the gas [m^2, m^2, m/s] */
    double wear_heat;                            /* heat that melts off one kilogram [J/kg] */
    shot_phase phase;
    double next_site; /* [m]; infinite when none is left */
} shot_model;

typedef struct {
    double I, R, drop; /* rails' current; resistance and constant voltage of armature or muzzle */
    double force, contact, mu, friction, drag, net; /* [N], mu [1] */
} shot_forces;

bool shot_group_conducts(const shot_group *g);
double shot_group_voltage(const shot_group *g, double w);     /* capacitor voltage from the unknown w = y[2k] [V] */
double shot_hold_force(const shot_model *m, double I);        /* static friction of both faces [N] */
status shot_rails_fit(const shot_config *c, rails_load *out); /* circuit/shot_rails.c */
int shot_unknowns(const shot_model *m);
double shot_push(const shot_model *m, double v, double I); /* electromagnetic force at the speed v [N] */
rails_flow shot_rails_flow(const shot_model *m, const double *y);
shot_forces shot_forces_at(const shot_model *m, const double *y);
double shot_breech_voltage(const shot_model *m, const double *y); /* from currents and capacitors [V] */

/* d[j] = dy_j/dt where y_j is differential, = the value y_j must have where it is algebraic. */
void shot_rates(const shot_model *m, const double *y, double *d);
void shot_residual(const void *model, const double *y, const double *yp, double *r);
void shot_roots(const void *model, const double *y, double *g);
bool shot_is_algebraic(const shot_model *m, int j);

#endif

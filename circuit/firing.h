/* Firing times of a bank that suit a wish, found by a simplex search (Nelder and Mead, as GSL has it).
 *
 * Moved are the firing times of all capacitor groups that fire and join at the breech, but the first of them; for the
 * goal `velocity` all charges too, by one factor.  The rails' ladder is fitted once.  A search finds a good place near
 * where it starts, not the best of all. */
#ifndef BREECH_CIRCUIT_FIRING_H
#define BREECH_CIRCUIT_FIRING_H

#include "circuit/shot.h"

/* flat: least mean over the way of ((I - peak_current)/peak_current)^2, what exceeds the peak counting ten thousand
 * times: the peak is kept to about a thousandth.
 * velocity: muzzle_velocity at the least energy stored at the start; a peak_current that is given is kept to alike. */
typedef enum { FIRING_FLAT, FIRING_VELOCITY } firing_goal;

typedef struct {
    int goal;               /* firing_goal */
    double peak_current;    /* of the rails [A]; NAN = none (goal velocity) */
    double muzzle_velocity; /* goal velocity [m/s] */
    double spread;          /* first steps of the search [s] */
    double tolerance;       /* it ends when the simplex is this small [s] */
    int evaluations;        /* at most, of the wish's measure */
} firing_wish;

extern const param circuit_firing_wish_params[];

typedef struct {
    double before, after;   /* the measure: flat [1]; velocity: stored energy [J] */
    double charge_scale;    /* all charges times this [1] */
    double stored_energy;   /* then, at the start [J] */
    int evaluations, shots; /* of the measure; shots run for them */
} firing_result;

/* Times and charges are written into `modules`, a copy of the configuration's capacitor groups that the caller owns.
 * STATUS_BAD_INPUT: nothing to move, or a wish without its number; STATUS_NUMERICAL: no charge reaches the velocity.
 * stop (may be NULL): true ends the search, STATUS_STOPPED. */
status circuit_firing_optimise(const shot_config *c, const firing_wish *wish, bool (*stop)(void), shot_module *modules,
                               firing_result *out);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* Looks for firing times of a bank that meet a goal, by a simplex search (Nelder and Mead's, of GSL).
 *
 * The search moves the firing times of all capacitor groups that fire and join at the breech, except the first.  For
 * the goal `velocity` it also scales all charges by one factor, and that alone where no time can move.  The rails'
 * ladder is fitted once; at level skin without a frequency, whose gradients follow from the firing times, once a trial.
 * A simplex search finds a local minimum near its start, not the global one. */
#ifndef BREECH_CIRCUIT_FIRING_H
#define BREECH_CIRCUIT_FIRING_H

#include "circuit/shot.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* flat: minimise the mean along the barrel of ((I - peak_current)/peak_current)^2.  Current above peak_current counts
 * ten thousand times, so the peak is exceeded by about a thousandth at most.
 * velocity: reach muzzle_velocity with the least energy stored at the start; peak_current, if given, is a limit as in
 * `flat`. */
typedef enum { CIRCUIT_FIRING_FLAT, CIRCUIT_FIRING_VELOCITY } circuit_firing_goal;

typedef struct {
    int goal;               /* circuit_firing_goal */
    double peak_current;    /* of the rails [A]; NAN = none (goal velocity) */
    double muzzle_velocity; /* goal velocity [m/s] */
    double spread;          /* first steps of the search [s] */
    double tolerance;       /* the search ends when the simplex is this small [s] */
    int evaluations;        /* of the objective, at most */
} circuit_firing_wish;

extern const base_param circuit_firing_wish_params[];

typedef struct {
    double before, after;   /* objective: flat [1]; velocity: stored energy [J] */
    double charge_scale;    /* all charges times this [1] */
    double stored_energy;   /* then, at the start [J] */
    int evaluations, shots; /* of the objective; shots that were run for them */
} circuit_firing_result;

/* A trial of the search: what it measured, and from what the next one goes on. */
typedef struct {
    double value, charge_scale;
    int64_t shots; /* run so far */
} circuit_firing_trial;

typedef struct {
    bool (*stop)(void); /* true ends the search, BASE_STATUS_STOPPED; NULL: never */
    int n_known;
    const circuit_firing_trial *known; /* n_known, the first of the same search: taken as they are, not run again */
    /* Told of every trial that was run, in their order; an error that it returns ends the search.  NULL: no one is. */
    base_status (*keep)(void *user, const circuit_firing_trial *trial);
    void *user;
} circuit_firing_host;

/* BASE_STATUS_BAD_INPUT: no group's time can move (flat), none fires (velocity), or the goal's number is missing. */
base_status circuit_firing_check(const circuit_shot_config *c, const circuit_firing_wish *wish);

/* Times and charges are written into `modules`, a copy of the configuration's capacitor groups that the caller owns.
 * BASE_STATUS_BAD_INPUT as circuit_firing_check.  BASE_STATUS_NUMERICAL: no charge reaches the velocity.
 * stop (may be NULL): true ends the search, BASE_STATUS_STOPPED. */
base_status circuit_firing_optimise(const circuit_shot_config *c, const circuit_firing_wish *wish, bool (*stop)(void),
                                    circuit_shot_module *modules, circuit_firing_result *out);
/* The same of a search whose trials are kept: one that was stopped goes on from them, to the same bits. */
base_status circuit_firing_resume(const circuit_shot_config *c, const circuit_firing_wish *wish,
                                  const circuit_firing_host *host, circuit_shot_module *modules,
                                  circuit_firing_result *out);

#ifdef __cplusplus
}
#endif

#endif

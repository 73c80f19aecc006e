/* SPDX-License-Identifier: BSD-3-Clause */
/* What a projectile has done to its target, from the series of the scene it arrived in (arrival.h, scene_probe.h).
 *
 * The class is decided by intact metal alone (damage below 1), at the scene's end; a projectile of whose mass more than
 * a tenth has left through the window's ends, or that has no intact metal left, at the last time before that.
 * With v0 the arrival velocity, m the projectile's mass, u its speed along the flight less that of what stays of the
 * target (probe `passage`: metal slower than v0 / 10 or 20 m/s):
 *   pierced     u > v0 / 50; what still stands in its way weighs less than m / 1000; and in the last tenth of the scene
 *               its speed changed by less than u / 10: metal that gives way before it, a bulge or a plug that is still
 *               held, would slow it down
 *   unfinished  else, if it never met the target, if u > v0 / 50, or if its speed changed by more than v0 / 50 in the
 *               last tenth of the scene: a longer scene decides
 *   torn        else, with strike.plate: new holes in the whole plate, of the area of four columns of its map (each two
 *               cells wide)
 *   bulged      else, with strike.plate
 *   rebound     else, u < -v0 / 50
 *   stopped     else
 * Of a wave that a piston has sent, the plate decides: torn with holes as above; else bulged, if its deflection grew by
 * less than a tenth of itself in the last tenth of the scene; else unfinished.
 * What the projectile has lost before its intact metal came within a cell of such an end was eroded; what it loses from
 * then on has left. */
#ifndef BREECH_COUPLING_STRIKE_OUTCOME_H
#define BREECH_COUPLING_STRIKE_OUTCOME_H

#include "coupling/scene/scene_bodies.h"
#include "coupling/strike/arrival.h"

typedef enum {
    STRIKE_REBOUND,
    STRIKE_STOPPED,
    STRIKE_PIERCED,
    STRIKE_BULGED,
    STRIKE_TORN,
    STRIKE_UNFINISHED
} strike_class;
extern const char *const strike_class_names[]; /* "rebound", ..., NULL */

/* What the class is decided by. */
typedef struct {
    double arrival;          /* velocity [m/s] */
    double mass;             /* of the whole projectile [kg] */
    double speed;            /* of its intact metal at the end [m/s] */
    double rest_speed;       /* of what stays of the target; NAN: nothing does [m/s] */
    double change;           /* of its speed over the last tenth of the scene [m/s] */
    double ahead;            /* intact metal in its way, of the whole [kg] */
    bool touched;            /* it has met the target */
    bool plate;              /* there is one to look at */
    double hole, least_hole; /* in the plate; the least that counts [m2] */
    bool piston;             /* a piston drove water onto it: the plate alone decides */
    double swelling;         /* growth of the deflection over the last tenth of the scene, over itself [1] */
} strike_state;
strike_class strike_class_of(const strike_state *s);

/* Of the whole, mirror parts included. */
typedef struct {
    double muzzle_velocity;       /* NAN: no shot [m/s] */
    double flight_time;           /* NAN: no shot [s] */
    double impact_velocity;       /* at arrival [m/s] */
    double projectile_mass;       /* [kg] */
    int class;                    /* strike_class */
    double residual_velocity;     /* along the flight, of its intact metal [m/s] */
    double energy_arrival;        /* of the projectile's motion [J] */
    double energy_absorbed;       /* of that, what its motion has lost at the end [J] */
    double energy_share;          /* over energy_arrival [1] */
    double peak_force, peak_time; /* against the flight, largest mean over strike.filter; its end [N, s] */
    double impulse;               /* against the flight, of contact [N s] */
    double deflection;            /* farthest that intact metal of the target has gone that stays there [m] */
    double hole_diameter;         /* of a circle with the area of the plate's holes; NAN: no plate [m] */
    double target_mass;           /* of the target at the start, in the window [kg] */
    double failed_volume;         /* of the target [m3] */
    double debris_mass;           /* of the target: what flies, and what has left the window or was eroded [kg] */
    double ahead;                 /* intact metal in the projectile's way at the end [kg] */
    double speed_change;          /* of the projectile in the last tenth of the scene [m/s] */
    double cavitated_volume;      /* largest of any time; NAN: there is no fluid [m3] */
    double judged_time;           /* of which its velocity and class are: the scene's end, or earlier [s] */
    double left_share;            /* of the projectile: left through the window's ends [1] */
    double lost_mass;             /* of the projectile: left through the window's ends, or was eroded [kg] */
    bool open;                    /* the plate has a hole that counts */
    bool gone;                    /* at the end nearly none of its intact metal is in the window */
} strike_outcome;

/* Of the scene of this name that has ended with this result; muzzle_velocity and flight_time are the caller's. */
status strike_outcome_read(history *h, const char *scene, const strike_projectile *p, const case_bodies *bodies,
                           double filter, double velocity, const scene_bodies_result *r, strike_outcome *out);

#endif

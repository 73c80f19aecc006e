/* SPDX-License-Identifier: BSD-3-Clause */
/* Life of a launcher's rail: after how many shots it cracks, where along the barrel, how deep, by what.
 *
 * The case's shot is flown; at places along the barrel it says how fast the armature passes, how hard it presses and
 * drags, and what heat it leaves (gouge/site_state.h).  life/along.h makes strain and lost life of that.  With
 * study.shots the rails of later shots are warmer by what the shots before have left there, warm_rail.h. */
#ifndef BREECH_COUPLING_STUDY_RAIL_LIFE_H
#define BREECH_COUPLING_STUDY_RAIL_LIFE_H

#include "coupling/life/along.h"
#include "coupling/run/session.h"
#include "coupling/run/shot_record.h"

typedef enum {
    RAIL_LIFE_CONTACT,
    RAIL_LIFE_HEAT,
    RAIL_LIFE_ENDLESS,
    RAIL_LIFE_TOO_FAST,
    RAIL_LIFE_UNREACHED
} rail_life_cause;
extern const char *const study_rail_life_cause_names[]; /* "contact", "heat", ..., NULL */

/* One place of the barrel.  Of the loads: by the first shot. */
typedef struct {
    double position, velocity, pressure, friction; /* [m, m/s, Pa, 1] */
    double moving_factor;                          /* K of (L-7) [1] */
    double rise, flux_rise;   /* of the face when the contact leaves it; by its flux alone, without a film [K] */
    double probe_rise;        /* largest at life.probe_depth [K] */
    double life, interval[2]; /* shots to a crack; at 5 and 95 %, NAN where the spread of A is not known [1] */
    double first;             /* shots until the first direction is cut */
    double depth, angle;      /* [m, rad] */
    double range;             /* largest of any direction at that depth [1] */
    double without_heat, depth_without_heat; /* shots; [m] */
    int cause;                               /* rail_life_cause */
} rail_life_place;

typedef struct {
    double life, quantiles[3];            /* of the weakest place [1] */
    double first;                         /* [1] */
    double position, depth, angle, range; /* of the crack there [m, m, rad, 1] */
    int cause;
    bool lasting;     /* no place cracks, and of some it is known that it never does */
    double depths[2]; /* of the cracks of all places, least and most [m] */
    double without_heat, without_heat_position, without_heat_depth; /* weakest place by its load alone [1, m, m] */
    double probability;                                             /* that a crack is there after the shots [1] */
    int shots, flights;                                             /* flown: one for all that are alike */
    double rayleigh_speed, rayleigh_position; /* [m/s]; from where on the armature is faster, NAN: nowhere [m] */
    int film_limited;                         /* places whose face would be warmer than the film */
    int n;
    rail_life_place *place; /* n, owned */
    double wall_seconds;    /* [s] */
} rail_life_result;

/* Of this metal; STATUS_BAD_INPUT names what it lacks. */
status study_rail_life_possible(const case_onset *c, const case_life *life, const mpm_material *metal);
/* *out needs study_rail_life_free, even on error.  record, NULL: not wanted, is the first shot's. */
status study_rail_life_run(session *s, const case_onset *c, const case_life *life, const mpm_material *metal,
                           bool with_history, rail_life_result *out, shot_record *record);
rail_life_result study_rail_life_none(void); /* nothing is known */
void study_rail_life_free(rail_life_result *r);

#endif

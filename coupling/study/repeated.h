/* SPDX-License-Identifier: BSD-3-Clause */
/* Shots fired one after the other at the same rail (study.shots): what each finds there of those before it.
 *
 * Heat: what the shots before have left (warm_rail.h).  Wear: what they have worn off the layers; metal: what their
 * armatures have left, of which study.deposit_kept is still there (both rail_left.h).  If the rail is changed in one
 * of these ways where grains may gouge, their thresholds are searched for once more where it is changed most, of all
 * places and shots (heat in steps of 25 K); in between they go linearly with the change.  Metal is a welded layer on
 * all others, of the armature's material as its file has it; where it is thinner than a cell and has none of its own
 * the scenes leave it out, and a warning says so.  A bare rail: where a gouge wears the layers through
 * (layer_wear.h), the rim that it leaves stands on the rail's own metal; thresholds for that are searched for too.
 * Rims themselves are drawn: montecarlo.h.  Nothing is searched for that no later shot can meet. */
#ifndef BREECH_COUPLING_REPEATED_H
#define BREECH_COUPLING_REPEATED_H

#include "coupling/run/shot_record.h"
#include "coupling/study/sampling/montecarlo.h"
#include "coupling/study/search/uncertain.h"

/* One shot. */
typedef struct {
    double muzzle_velocity;  /* NaN: the armature did not leave [m/s] */
    double most[MC_CHANGES]; /* of the rail before it, largest where the armature is fast enough to be looked at; NAN:
                                not carried on [K, m, m] */
} repeated_shot;

/* A rail that former shots have changed, and its search. */
typedef struct {
    double most;           /* change that it is for [K, m, m] */
    case_onset *c;         /* owned, borrows from the first's; NULL: not needed, all else is empty */
    case_layers layers;    /* its own, owned */
    grain_families grains; /* owned */
    char prefix[32];       /* of its scenes' names */
} changed_rail;

typedef struct {
    int shots;           /* 0: there is but one, all below is empty */
    repeated_shot *shot; /* [shots], owned */
    mc_along *along;     /* [shots], owned */
    changed_rail changed[MC_CHANGES], bare;
} repeated_rail;

/* The flights.  *out needs study_repeated_free even on error, before `first` goes.  STATUS_BAD_INPUT: the rail would
 * melt. */
status study_repeated_fly(session *s, const grain_families *first, const shot_record *flight, repeated_rail *out);
/* After the first shot's search: those of what further shots find, as far as any of them can meet it.  REPEATED_RAILS
 * at most are put into `wanted`, *n of them, for study_families_search; they are borrowed from *out, which must stay
 * where it is. */
enum { REPEATED_RAILS = MC_CHANGES + 1 };
status study_repeated_want(session *s, const grain_families *first, repeated_rail *out, grain_families **wanted,
                           int *n);
/* After that search: their thresholds are as uncertain as those of the first shot. */
void study_repeated_found(repeated_rail *r, const grain_families *first, const uncertain_inputs *u);
/* For the random shots. */
mc_surface study_repeated_surface(const repeated_rail *r, const grain_families *first);
void study_repeated_free(repeated_rail *r);

#endif

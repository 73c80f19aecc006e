/* SPDX-License-Identifier: BSD-3-Clause */
/* What a threshold owes to inputs of its scenes that are not well known: the search once more with each of them raised
 * by its stated uncertainty (study.strength_error, armature_error, friction_error; 0: not asked for).
 *
 * By as much as the threshold of the reference size then moves, the intervals of all sizes are widened: on either side
 * the allowance is the root of the sum of squares of what cells may change (threshold.h), of what the place of the grid
 * does (scatter.h), of all these and of what the case states without a search (study.interval_parts).
 * These searches go from 0.6 to 1.6 of the threshold, beyond the study's range too, have no whole craters, and go on
 * side by side. */
#ifndef BREECH_COUPLING_UNCERTAIN_H
#define BREECH_COUPLING_UNCERTAIN_H

#include "coupling/study/search/family.h"

enum { UNCERTAIN_MAX = 3 };

typedef struct {
    const char *input; /* its key */
    char prefix[32];   /* of its scenes' names */
    double change;     /* relative [1] */
    case_onset *c;     /* owned, borrows from the study's */
    grain_families grains;
} uncertain_input;

typedef struct {
    int n;
    uncertain_input of[UNCERTAIN_MAX];
} uncertain_inputs;

/* After the search of `grains`, whose thresholds it moves to the mean over the grids and whose intervals it widens.
 * *out needs study_uncertain_free even on error, before `grains` goes. */
status study_uncertain_run(session *s, grain_families *grains, uncertain_inputs *out);
/* The inputs that may be uncertain, k from 0 to UNCERTAIN_MAX - 1, by their keys. */
const char *study_uncertain_input(int k);
/* How far the k-th of them, raised by its uncertainty, moves a threshold of the family; NAN: none is stated [m/s]. */
double study_uncertain_moved(const uncertain_inputs *u, int k, grain_family *f, family_judge judge);
/* How far the part of study.interval_parts lets a threshold of the family lie lower or higher [m/s]. */
double study_uncertain_stated(const case_interval_part *part, grain_family *f, family_judge judge);
/* Moves and widens the families of another rail (repeated.h) by as much as those of `first`. */
void study_uncertain_widen(const uncertain_inputs *u, const grain_families *first, grain_families *other);
void study_uncertain_free(uncertain_inputs *u);

#endif

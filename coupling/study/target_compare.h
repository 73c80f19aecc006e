/* SPDX-License-Identifier: BSD-3-Clause */
/* Targets compared by what the same projectile does to each: that of the case and every entry of its list `targets`.
 *
 * With strike.limit the one with the higher limit velocity is better, told apart where the brackets of both do not
 * overlap.  Else, of one arrival: a target that holds the projectile is better than one that is torn, that than one
 * that is pierced, `unfinished` comes last, and is told apart from none, for it may yet hold; of two that are pierced
 * the one that leaves less velocity, told apart where it differs by more than a hundredth of the arrival's.
 * Deflections and holes order nothing: they do not settle as cells become smaller. */
#ifndef BREECH_COUPLING_STUDY_TARGET_COMPARE_H
#define BREECH_COUPLING_STUDY_TARGET_COMPARE_H

#include "coupling/study/strike_limit.h"

typedef struct {
    char target[SUMMARY_NAME_SIZE];
    strike_outcome is;
    double limit;             /* velocity; NAN: not asked for, or an end is not known [m/s] */
    double limit_interval[2]; /* NAN: that end is not known [m/s] */
    int tied;                 /* rank of the best of its group, from which it cannot be told; from 1 */
} target_entry;

typedef struct {
    int n;
    int by_limit;          /* 1: by limit velocity, 0: by one arrival */
    target_entry *ranking; /* [n] owned; the best first, once it is ranked */
    double wall_seconds;   /* [s] */
} target_ranking;

/* Best first; fills `tied`. */
void study_targets_rank(target_ranking *r);

#endif

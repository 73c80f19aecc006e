/* SPDX-License-Identifier: BSD-3-Clause */
/* A rail that stays warm from shot to shot (study.shots).
 *
 * Before a shot the rail has study.heat_kept of what it had before the last shot and of what that left
 * (circuit_shot_rail_rise), even over the section.  The armature flies through rails of that mean temperature; a shot
 * whose rails are hardly warmer than those of the last flight is like that one, and not flown. */
#ifndef BREECH_COUPLING_STUDY_WARM_RAIL_H
#define BREECH_COUPLING_STUDY_WARM_RAIL_H

#include "coupling/gouge/session_shot.h"

typedef struct {
    const case_onset *c;              /* borrowed */
    int number;                       /* of the shot, from 1 */
    double rise[CIRCUIT_SHOT_PIECES]; /* of the rail before this shot, above the case's [K] */
    double left[CIRCUIT_SHOT_PIECES]; /* by the last flight [K] */
    double flown_at;                  /* mean rise in which that was flown [K] */
} warm_rail;

/* At the first shot, which has been flown. */
warm_rail study_warm_rail_begin(const case_onset *c, const shot_outcome *flown);
/* The next shot.  *is_flown: it is a flight of its own, and *out the caller's to free, without history.
 * STATUS_BAD_INPUT: the rail would melt. */
status study_warm_rail_shoot(session *s, warm_rail *w, bool *is_flown, shot_outcome *out, shot_record *record);

/* STATUS_BAD_INPUT: before the last of the case's shots the rail would melt.  Shots after the first, which has been
 * flown, are flown only where that one makes it likely. */
status study_warm_rail_follows(session *s, const case_onset *c, const shot_outcome *flown);
/* The same before anything is flown, without a run. */
status study_warm_rail_possible(const case_onset *c);

/* From the case's temperature to melting; INFINITY: no melting point is known [K] */
double study_warm_rail_melting_rise(const case_onset *c);

#endif

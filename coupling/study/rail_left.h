/* SPDX-License-Identifier: BSD-3-Clause */
/* What the sliding armature does to the rail's surface in one shot, place by place, and what that makes of its layers.
 *
 * Wear: a force F that slides over the way s takes the volume k F s off a layer, k its wear_rate (archard1953).  The
 * contact face, w wide, passes a place of the rail with the whole of its length l, so the depth is
 *   h = k p l = k N/w                                                                              (O-6) [m]
 * N the force of one face.  N/w, added up over the shots, is all that has to be carried on: it wears the top layer
 * through, then the next one.  A layer without a wear_rate stays, and so does all below it.
 * Metal: what the faces melt off (M(x) by the place x) is left behind them, an equal part on each of
 * the n rails, spread over a face:
 *   d = (M(x + l/2) - M(x - l/2)) / (n rho w l)                                                    (O-7) [m]
 * as a thickness of solid armature.  All that melts is left: what leaves in front is run over, what burns or is blown
 * off is for the case to say (study.deposit_kept). */
#ifndef BREECH_COUPLING_STUDY_RAIL_LEFT_H
#define BREECH_COUPLING_STUDY_RAIL_LEFT_H

#include "coupling/study/sampling/montecarlo.h"

/* Of one flight, at the places of mc_along. */
typedef struct {
    double pressed[MC_PLACES + 1]; /* N/w [N/m] */
    double metal[MC_PLACES + 1];   /* d [m] */
} rail_left;

void study_rail_left_of(const case_onset *c, const shot_outcome *flown, rail_left *out);

double study_layers_worn(const case_layers *l, double pressed); /* thickness gone by pressed [N/m] in all [m] */
/* The layers without so much of their top.  What is left of one that is thinner than a case may give goes with it.
 * out->item is the caller's to free, even on error. */
status study_layers_without(const case_layers *l, double gone, case_layers *out);

#endif

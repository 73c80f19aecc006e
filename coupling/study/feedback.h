/* SPDX-License-Identifier: BSD-3-Clause */
/* What the gouges of a study do to its shot. */
#ifndef BREECH_COUPLING_FEEDBACK_H
#define BREECH_COUPLING_FEEDBACK_H

#include "coupling/study/onset.h"

/* The shot again with what gouges take: sites of the list that gouge, and what populations are expected to.  Sets
 * result.muzzle_velocity_feedback; NaN where nothing is taken or study.feedback is off. */
status study_feedback_shot(session *s, onset_answer *a);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* What `breech strike` answers. */
#ifndef BREECH_COUPLING_STUDY_STRIKE_H
#define BREECH_COUPLING_STUDY_STRIKE_H

#include "circuit/firing.h"
#include "coupling/study/strike_limit.h"

typedef struct {
    strike_outcome is;
    scene_bodies_result scene;    /* that it arrived in */
    strike_limit limit;           /* with strike.limit */
    circuit_firing_result firing; /* with `optimise`; all zero without */
} strike_result;

#endif

/* What `breech strike` answers. */
#ifndef BREECH_COUPLING_STUDY_STRIKE_H
#define BREECH_COUPLING_STUDY_STRIKE_H

#include "coupling/strike/outcome.h"
#include "coupling/study/study.h"

typedef struct {
    strike_outcome is;
    scene_bodies_result scene; /* that it arrived in */
} strike_result;

#endif

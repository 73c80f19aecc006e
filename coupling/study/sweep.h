/* SPDX-License-Identifier: BSD-3-Clause */
/* What `breech sweep` answers. */
#ifndef BREECH_COUPLING_STUDY_SWEEP_H
#define BREECH_COUPLING_STUDY_SWEEP_H

#include "coupling/study/study.h"

/* One combination. */
typedef struct {
    int n_inputs, n_outputs, n_errors;
    const summary_pair *inputs;  /* n_inputs: the varied keys, borrowed */
    const summary_pair *outputs; /* n_outputs, borrowed */
    const summary_pair *errors;  /* n_errors: of the outputs, over those of the finest run; 0 of them: none, borrowed */
    double wall_seconds;         /* of the run [s] */
} sweep_run;

typedef struct {
    char of[BASE_PARAM_TEXT_SIZE];         /* the study that was run */
    char resolution[BASE_PARAM_TEXT_SIZE]; /* the varied key that is one, "" if none is */
    int n_units, n_runs;
    const summary_pair *units; /* n_units: inputs, then outputs; borrowed */
    const sweep_run *run;      /* n_runs, borrowed */
    double wall_seconds;       /* [s] */
} sweep_result;

#endif

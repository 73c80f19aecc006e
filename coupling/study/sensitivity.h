/* SPDX-License-Identifier: BSD-3-Clause */
/* What a change of one input does to the answer, all else as it was and with the same random numbers: inputs of the
 * shot and the grains' size 5 % more, by the same thresholds; uncertain inputs of the scenes by what they are uncertain
 * (uncertain.h). */
#ifndef BREECH_COUPLING_SENSITIVITY_H
#define BREECH_COUPLING_SENSITIVITY_H

#include "coupling/study/onset.h"

/* Sets result.sensitivities, none where study.sensitivities is off.  Runs a shot for each input of the shot. */
status study_sensitivities_run(session *s, onset_answer *a);

#endif

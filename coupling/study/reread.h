/* SPDX-License-Identifier: BSD-3-Clause */
/* The case of the command line once more, with other values of some keys. */
#ifndef BREECH_COUPLING_STUDY_REREAD_H
#define BREECH_COUPLING_STUDY_REREAD_H

#include "coupling/study/study.h"

/* The case file is read again with its --set and then these n changes, as --set sets them, for the study y: units,
 * ranges and what follows from other keys are those of a case file.  STATUS_BAD_INPUT before anything is written: what
 * reading, making its scene, or the study itself can tell.  *about: the change that the error is about, whose --set its
 * text then does not name, or -1.  *out is for case_inputs_free, even on error. */
status study_reread(const study_case *of, const study *y, int n, const case_change *change, case_inputs **out,
                    int *about);
/* Is such an error about the change's key, not its value? */
bool study_reread_key(const status *s);

#endif

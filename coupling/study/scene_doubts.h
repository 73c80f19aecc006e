/* SPDX-License-Identifier: BSD-3-Clause */
/* What is doubtful in a case's scene before it is computed: a body with too few cells, a probe with nothing to read. */
#ifndef BREECH_COUPLING_STUDY_SCENE_DOUBTS_H
#define BREECH_COUPLING_STUDY_SCENE_DOUBTS_H

#include "coupling/study/study.h"

/* A line each, "warning: ...". */
void study_scene_doubts_print(const case_inputs *in, FILE *out);
/* Warnings of the session; not for one of several cases, whose first has said it. */
void study_scene_doubts_warn(session *s, const study_case *of);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* What `breech vessel` answers. */
#ifndef BREECH_COUPLING_STUDY_VESSEL_H
#define BREECH_COUPLING_STUDY_VESSEL_H

#include "coupling/vessel/vessel.h"

#include <stdio.h>

typedef struct {
    vessel_result is;
    double wall_seconds; /* [s] */
} vessel_answer;

void study_vessel_print_columns(FILE *out); /* of /vessel, for the manual */

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* What `breech life` answers. */
#ifndef BREECH_COUPLING_STUDY_LIFE_H
#define BREECH_COUPLING_STUDY_LIFE_H

#include "coupling/life/crack.h"

typedef struct {
    double peak_pressure;                  /* [Pa] */
    double normal_force, tangential_force; /* on a metre across the rail [N/m] */
    double life_first;                     /* cycles until the first direction is cut, closed field [1] */
    life_first first;                      /* that direction */
    double moving_factor;                  /* K of (L-7) [1] */
    life_crack crack;                      /* all NAN, 0 where life.until is first */
    double wall_seconds;                   /* [s] */
} life_result;

#endif

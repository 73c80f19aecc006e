/* SPDX-License-Identifier: BSD-3-Clause */
/* What `breech inductance` answers. */
#ifndef BREECH_COUPLING_STUDY_INDUCTANCE_H
#define BREECH_COUPLING_STUDY_INDUCTANCE_H

#include "coupling/output/summary.h"

typedef struct {
    int n;
    const double *frequency;          /* n [Hz], borrowed */
    const double *L_gradient;         /* n [H/m], borrowed */
    const double *R_gradient;         /* n [ohm/m], borrowed */
    double L_gradient_high_frequency; /* [H/m] */
    double L_gradient_direct_current; /* [H/m] */
    double R_gradient_direct_current; /* [ohm/m] */
    double L_gradient_kerrisk;        /* [H/m]; NAN where the formula does not apply */
    double kerrisk_error;             /* over L_gradient_high_frequency [1] */
    double perimeter_frequency;       /* [Hz] */
    int n_perimeter;
    const double *perimeter; /* n_perimeter [m], from the middle of the bore face to that of the back, borrowed */
    const double *perimeter_current; /* n_perimeter [A/m^2 per A], borrowed */
    const double *perimeter_heat;    /* n_perimeter [W/m^3 per A^2], borrowed */
} inductance_result;

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* `breech flow`: the flow stress of a material over plastic strain, at one rate, temperature and pressure. */
#ifndef BREECH_COUPLING_STUDY_FLOW_H
#define BREECH_COUPLING_STUDY_FLOW_H

#include "mpm/law/flow_curve.h"

#include <stdio.h>

/* Prints a table: strain, flow stress [MPa], temperature [K].  sets: n texts KEY=VALUE, of the keys of
 * mpm_flow_test_params, values with their units. */
status study_flow_print(const mpm_material *m, const char *const *sets, int n, FILE *out);

#endif

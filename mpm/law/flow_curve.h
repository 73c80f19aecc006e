/* SPDX-License-Identifier: BSD-3-Clause */
/* The flow stress of a material as a test of it would show: at one strain rate, by the code that the kernels use. */
#ifndef BREECH_MPM_FLOW_CURVE_H
#define BREECH_MPM_FLOW_CURVE_H

#include "mpm/material.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    double strain;      /* plastic strain at which the curve ends [1] */
    int points;         /* of the curve, behind its first at no strain */
    double rate;        /* [1/s] */
    double temperature; /* at the start [K] */
    double pressure;    /* held [Pa] */
    double cold_work;   /* plastic strain before the test; NAN: the material's [1] */
    double yield_scale; /* factor on the flow stress [1] */
    double heat;        /* share of the plastic work that warms it, 0: the temperature is held [1] */
} mpm_flow_test;

extern const base_param mpm_flow_test_params[];

typedef struct {
    double strain, stress, temperature; /* [1, Pa, K] */
} mpm_flow_point;

/* points + 1 entries of `curve`.  A fluid, and a material that lacks a constant, is refused. */
base_status mpm_flow_curve(const mpm_material *m, const mpm_flow_test *test, mpm_flow_point *curve);

#ifdef __cplusplus
}
#endif

#endif

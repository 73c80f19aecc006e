/* SPDX-License-Identifier: BSD-3-Clause */
/* A material's laws of strength, failure and state at one point, by the code that the kernels use: for models without
 * a grid. */
#ifndef BREECH_MPM_LAW_POINT_H
#define BREECH_MPM_LAW_POINT_H

#include "mpm/material.h"

typedef struct mpm_point_law mpm_point_law; /* owns its memory */

/* With damage, at a temperature that stays [K].  A material that lacks a constant is refused. */
status mpm_point_law_make(const mpm_material *m, double temperature, mpm_point_law **out);
void mpm_point_law_free(mpm_point_law *k); /* NULL allowed */

/* Of a solid. */
typedef struct {
    double strain;      /* equivalent plastic strain [1] */
    double rate;        /* of it [1/s] */
    double damage;      /* over that at which it fails [1] */
    double triaxiality; /* mean stress / von Mises stress, tension positive; the damage alone reads it [1] */
} mpm_law_point;

double mpm_point_law_flow(const mpm_point_law *k, const mpm_law_point *at); /* flow stress [Pa] */
/* What the last `plastic` of its strain adds to the damage [1]. */
double mpm_point_law_damage(const mpm_point_law *k, const mpm_law_point *at, double plastic);
double mpm_point_law_shear(const mpm_point_law *k); /* shear modulus at rest [Pa] */
/* Density under a pressure over that without, at the same temperature; NAN: its law reaches no such pressure [1]. */
double mpm_point_law_compression(const mpm_point_law *k, double pressure);

#endif

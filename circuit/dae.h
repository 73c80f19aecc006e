/* SPDX-License-Identifier: BSD-3-Clause */
/* Index-1 differential-algebraic system  F(t, y, y') = 0  with located roots, whose Newton matrix has the shape of
 * circuit/arrow.h.  The only door to SUNDIALS (IDA).
 *
 * The owner fills circuit_dae_y, circuit_dae_yp (consistent: F = 0), circuit_dae_atol, circuit_dae_differential and
 * circuit_dae_direction, then circuit_dae_restart; then circuit_dae_step as often as wanted.  After a discontinuity:
 * fill again, restart.  Roots are found in value and direction inside every step; circuit_dae_step then stops exactly
 * there.  Nothing is allocated between create and free but by IDA's restart. */
#ifndef BREECH_CIRCUIT_DAE_H
#define BREECH_CIRCUIT_DAE_H

#include "base/status.h"
#include "circuit/arrow.h"

typedef struct dae dae;

typedef struct {
    int n, n_roots;
    void (*residual)(const void *model, double t, const double *y, const double *yp, double *r);
    void (*roots)(const void *model, double t, const double *y, double *g);
    void (*jacobian)(const void *model, double t, double cj, const double *y,
                     arrow *J); /* dF/dy + cj dF/dy', J comes zeroed */
    const void *model;          /* borrowed */
    arrow *matrix;              /* its blocks' sizes filled; borrowed until circuit_dae_free */
} dae_problem;

typedef enum { DAE_STEP, DAE_STOP, DAE_ROOT } dae_outcome;

status circuit_dae_create(const dae_problem *problem, dae **out);
void circuit_dae_free(dae *d); /* NULL allowed */

double *
circuit_dae_y(const dae *d); /* n: the state at the last circuit_dae_step's time; to be filled before a restart */
double *circuit_dae_yp(const dae *d);           /* n */
double *circuit_dae_atol(const dae *d);         /* n: absolute tolerances */
double *circuit_dae_differential(const dae *d); /* n: 1 where y' enters F, 0 where not (left out of the error test) */
int *circuit_dae_direction(const dae *d);       /* n_roots: +1 rising, -1 falling, 0 both */
const int *circuit_dae_found(const dae *d);     /* n_roots: after DAE_ROOT, nonzero where a root was found */

/* first: step to begin with, 0 = IDA's own choice [s]. */
status circuit_dae_restart(dae *d, double t, double rtol, double first);
/* One accepted step, cut short at `stop` and at the first root.  *t is the time reached. */
status circuit_dae_step(dae *d, double stop, double *t, dae_outcome *outcome);

#endif

/* Index-1 differential-algebraic system  F(t, y, y') = 0  with located roots, whose Newton matrix has the shape of
 * circuit/arrow.h.  The only door to SUNDIALS (IDA).
 *
 * The owner fills dae_y, dae_yp (consistent: F = 0), dae_atol, dae_differential and dae_direction, then dae_restart; then
 * dae_step as often as wanted.  After a discontinuity: fill again, restart.  Roots are found in value and direction inside
 * every step; dae_step then stops exactly there.  Nothing is allocated between create and free but by IDA's restart. */
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
    arrow *matrix;              /* its blocks' sizes filled; borrowed until dae_free */
} dae_problem;

typedef enum { DAE_STEP, DAE_STOP, DAE_ROOT } dae_outcome;

status dae_create(const dae_problem *problem, dae **out);
void dae_free(dae *d); /* NULL allowed */

double *dae_y(const dae *d);            /* n: the state at the last dae_step's time; to be filled before a restart */
double *dae_yp(const dae *d);           /* n */
double *dae_atol(const dae *d);         /* n: absolute tolerances */
double *dae_differential(const dae *d); /* n: 1 where y' enters F, 0 where not (left out of the error test) */
int *dae_direction(const dae *d);       /* n_roots: +1 rising, -1 falling, 0 both */
const int *dae_found(const dae *d);     /* n_roots: after DAE_ROOT, nonzero where a root was found */

/* first: step to begin with, 0 = IDA's own choice [s]. */
status dae_restart(dae *d, double t, double rtol, double first);
/* One accepted step, cut short at `stop` and at the first root.  *t is the time reached. */
status dae_step(dae *d, double stop, double *t, dae_outcome *outcome);

#endif

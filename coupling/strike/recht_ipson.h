/* SPDX-License-Identifier: BSD-3-Clause */
/* Residual velocities over arrival velocities, as Recht and Ipson (Journal of Applied Mechanics 30 (1963) 384) have
 * them:
 *   v_r = k sqrt(v0^2 - v50^2)                                                                               
 * k = 1 where the target takes energy alone, less where it goes along. */
#ifndef BREECH_COUPLING_STRIKE_RECHT_IPSON_H
#define BREECH_COUPLING_STRIKE_RECHT_IPSON_H

typedef struct {
    double factor; /* k [1] */
    double limit;  /* v50 [m/s] */
    double error;  /* largest |v_r of the fit / v_r - 1|; NAN: fewer than three, which fit in any case [1] */
} strike_fit;

/* Least squares of v_r to first order, over n that pierced: linear in the squares of the velocities with weights
 * 1 / v_r^2.  All NAN: fewer than two velocities, or residual velocities that fall. */
strike_fit strike_recht_ipson(int n, const double *arrival, const double *residual);

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* Z'(s) of parallel filaments of one length, for every complex frequency s at once.
 *
 * (R + s L) i = e 1,  Z' = e/(1.i),  R diagonal.  With K = R^(-1/2) L R^(-1/2), b = R^(-1/2) 1, Lanczos' process from b
 * gives K = V T V^T, T tridiagonal, and
 *   Z'(s) = R_dc d_1,  d_k = 1 + s T_kk - s^2 T_k,k+1^2/d_k+1,  R_dc = 1/b.b                             (C-10)
 * a continued fraction of positive terms: passive however early the process stops.  Source: lanczos1950. */
#ifndef BREECH_CIRCUIT_IMPEDANCE_H
#define BREECH_CIRCUIT_IMPEDANCE_H

#include "base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    int n, m;            /* filaments, terms */
    double R_dc;         /* [ohm/m] */
    double omega_top;    /* beyond this the terms may be too few; the mesh gives it its sense [rad/s] */
    double *diagonal;    /* T_kk [s], m */
    double *coupling;    /* T_k,k+1 [s], m; the last is 0 */
    double *conductance; /* R^(-1/2) of the filaments [(m/ohm)^1/2], n */
    double *vectors;     /* V, m rows of n */
} circuit_impedance;

/* L: n x n, symmetric, row by row [H/m]; changed to K.  R: n [ohm/m].  Ends once Z' at i omega_top is settled to 1e-7.
 * *out is freed by circuit_impedance_free, also after an error. */
base_status circuit_impedance_create(int n, double *L, const double *R, double omega_top, circuit_impedance *out);
void circuit_impedance_free(circuit_impedance *z);

double _Complex circuit_impedance_at(const circuit_impedance *z, double _Complex s); /* Re s >= 0 [1/s] -> [ohm/m] */

/* Share of each filament in a total current of 1 at the frequency s; `share` has n places. */
base_status circuit_impedance_currents(const circuit_impedance *z, double _Complex s, double _Complex *share);

#ifdef __cplusplus
}
#endif

#endif

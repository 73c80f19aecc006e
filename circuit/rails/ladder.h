/* SPDX-License-Identifier: BSD-3-Clause */
/* A ladder of rungs in place of Z'(s): each an inductance beside a resistance, all in series,
 *   Z'(s) = R_dc + s L_inf + sum s L_k R_k/(R_k + s L_k),   R_dc, L_inf, L_k, R_k >= 0                   (C-11)
 * Passive by construction.  A ladder of no rungs is a pair of constant gradients. */
#ifndef BREECH_CIRCUIT_LADDER_H
#define BREECH_CIRCUIT_LADDER_H

#include "circuit/rails/impedance.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CIRCUIT_LADDER_MAX_RUNGS = 24 };

typedef struct {
    int n;                                                           /* rungs, slowest first */
    double R_dc, L_inf;                                              /* [ohm/m], [H/m] */
    double L[CIRCUIT_LADDER_MAX_RUNGS], R[CIRCUIT_LADDER_MAX_RUNGS]; /* [H/m], [ohm/m]; tau_k = L_k/R_k */
    double error; /* largest |Z' - ladder| over |Z' - s L_inf|, 0 < frequency <= the band's top [1] */
} circuit_ladder;

double _Complex circuit_ladder_at(const circuit_ladder *l, double _Complex s); /* [1/s] -> [ohm/m] */
double circuit_ladder_slow_inductance(const circuit_ladder *l);                /* L' at direct current [H/m] */

/* As many rungs as `error` [1] asks for up to omega_top [rad/s].  R_dc and the filaments' L' at infinite frequency are
 * met exactly, by Galerkin's projection on the current distributions of a few real frequencies
 * (docs/theory/circuit.md).  BASE_STATUS_NUMERICAL if CIRCUIT_LADDER_MAX_RUNGS do not do. */
base_status circuit_ladder_fit(const circuit_impedance *z, double omega_top, double error, circuit_ladder *out);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* Where along the barrel the rails' heat stays: the sums over all slices of circuit/rails/rails.h, slice by slice.
 *
 * The barrel in CIRCUIT_RAILS_PIECES pieces.  At the middle of each, from the instant at which the armature exposes it,
 * the current j_k of every rung's inductance.  Over a step the current I goes linearly; then u_k = I - j_k, which heats
 * R_k, has the closed form
 *   u' = I' - u/tau_k:  u(t) = I' tau_k + (u(0) - I' tau_k) exp(-t/tau_k)                             (C-23)
 * Exposed with j_k = a_k I, a piece starts with what that cost, 1/2 I^2 sum L_k (2 a_k - a_k^2 - f_k) a length  (C-2).
 * Law: the pieces add up to the heat of the shot's ledger, to within the piece that the armature starts and ends in. */
#ifndef BREECH_CIRCUIT_RAILS_HEAT_H
#define BREECH_CIRCUIT_RAILS_HEAT_H

#include "circuit/rails/rails.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { CIRCUIT_RAILS_PIECES = 64 };

typedef struct {
    double piece;                                             /* length of one [m] */
    double heat[CIRCUIT_RAILS_PIECES];                        /* of all rails together [J/m] */
    double j[CIRCUIT_RAILS_PIECES][CIRCUIT_LADDER_MAX_RUNGS]; /* [A] */
} circuit_rails_heat;

/* Of a stretch of rail behind or ahead of the armature. */
typedef struct {
    double t, x, v; /* of the armature [s, m, m/s] */
    double I;       /* along the stretch [A] */
} circuit_rails_instant;

void circuit_rails_heat_start(circuit_rails_heat *h, double length); /* no heat, no current */

/* The pieces with their middles in from .. to [m]: what happens to them between two instants.  warm:
 * circuit_rails_warming there. */
void circuit_rails_heat_carry(circuit_rails_heat *h, const circuit_rails_load *r, double warm, double from, double to,
                              const circuit_rails_instant *a, const circuit_rails_instant *b);

/* Pieces ahead of the armature carry the shunt's current i at both instants, evenly. */
void circuit_rails_heat_ahead(circuit_rails_heat *h, const circuit_rails_load *r, double x, double dt, double i0,
                              double i1);

/* E [J] of the contact's heat stays in the rails between x0 and x1. */
void circuit_rails_heat_slide(circuit_rails_heat *h, double x0, double x1, double E);

#ifdef __cplusplus
}
#endif

#endif

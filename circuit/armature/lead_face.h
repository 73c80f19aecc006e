/* SPDX-License-Identifier: BSD-3-Clause */
/* The current's way through the armature to its lead face (internal to circuit/).
 *
 * The field is behind the armature: its current begins on the rear face, K = I/width a metre of height there, and
 * diffuses forward through the metal, length l along the rail.  B = mu0 K on the rear, 0 on the lead face, D = rho/mu0:
 *   dB/dt = D d2B/dx2,   B = mu0 (K (1 - x/l) + sum b_n sin(n pi x/l)),
 *   db_n/dt = -D (n pi/l)^2 b_n - 2/(n pi) dK/dt,   J(l) = (K - sum n pi (-1)^n b_n)/l        (C-28)
 * exact for each mode while K is linear in time.  The metal's resistivity does not change with its heat; the rails'
 * velocity skin effect, which keeps the current at the rear for longer, is not in it. */
#ifndef BREECH_CIRCUIT_LEAD_FACE_H
#define BREECH_CIRCUIT_LEAD_FACE_H

#ifdef __cplusplus
extern "C" {
#endif

enum { CIRCUIT_LEAD_FACE_MODES = 32 };

typedef struct {
    double length;                        /* l [m] */
    double diffusivity;                   /* D [m^2/s] */
    double t, sheet;                      /* as far as it has been followed, K then [s, A/m] */
    double mode[CIRCUIT_LEAD_FACE_MODES]; /* b_1, b_2, .. [A/m] */
    double density;                       /* J(l) then [A/m^2] */
    double action;                        /* integral of J(l)^2 dt so far [A^2 s/m^4] */
} circuit_lead_face;

/* No current at t = 0.  length [m] and resistivity [ohm m] > 0. */
circuit_lead_face circuit_lead_face_start(double length, double resistivity);

/* To t >= f->t [s], K [A/m] linear on the way. */
void circuit_lead_face_advance(circuit_lead_face *f, double t, double sheet);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* The current's way through the armature to its lead face (internal to circuit/).
 *
 * The field is behind the armature: its current begins on the rear face, K = I/width a metre of height there, and
 * diffuses forward through the metal, length l along the rail, which it heats and so makes more resistive:
 *   mu0 dH/dt = d/dx (rho_e dH/dx),   J = -dH/dx,   rho c dT/dt = rho_e J^2,   rho_e = rho_0 (1 + alpha (T - T_0))
 * with H = K on the rear and 0 on the lead face                                                   (C-28)
 * A melted cell keeps the melting temperature and its resistivity.  The rails' velocity skin effect, which keeps the
 * current at the rear for longer, is not in it, nor is what enters through the sides. */
#ifndef BREECH_CIRCUIT_LEAD_FACE_H
#define BREECH_CIRCUIT_LEAD_FACE_H

#ifdef __cplusplus
extern "C" {
#endif

enum { CIRCUIT_LEAD_FACE_CELLS = 40 };

typedef struct {
    double resistivity, coefficient; /* rho_0 [ohm m], alpha [1/K], both at T_0 */
    double heat_capacity;            /* rho c [J/m^3/K] */
    double start, melting;           /* T_0, T_m >= T_0 [K] */
} circuit_lead_face_metal;

typedef struct {
    circuit_lead_face_metal metal;
    double length;                               /* l [m] */
    double t;                                    /* as far as it has been followed [s] */
    double field[CIRCUIT_LEAD_FACE_CELLS + 1];   /* H between cells, from the rear on [A/m] */
    double temperature[CIRCUIT_LEAD_FACE_CELLS]; /* [K] */
} circuit_lead_face;

/* No current at t = 0.  length [m] > 0. */
circuit_lead_face circuit_lead_face_start(const circuit_lead_face_metal *metal, double length);

/* To t > f->t [s], K linear on the way to `sheet` [A/m]; an earlier t does nothing. */
void circuit_lead_face_advance(circuit_lead_face *f, double t, double sheet);

#ifdef __cplusplus
}
#endif

#endif

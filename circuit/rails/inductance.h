/* SPDX-License-Identifier: BSD-3-Clause */
/* Inductance and resistance gradients of a set of rails, per unit length of the whole as one loop
 * (circuit/rails/section.h). */
#ifndef BREECH_CIRCUIT_INDUCTANCE_H
#define BREECH_CIRCUIT_INDUCTANCE_H

#include "circuit/rails/impedance.h"
#include "circuit/rails/section.h"

/* Cells over the skin depth at the highest frequency: L' within 0.25 %, R' within 0.3 % (curve:
 * docs/theory/circuit.md). */
#define INDUCTANCE_FINENESS 4.0

/* Kerrisk's closed formula for two rectangular perfect conductors, height h, thickness w, separation s [m]: within 1.5
 * % for s/h >= 0.5, up to 4 % off for narrower gaps [H/m]. */
double circuit_inductance_kerrisk(double h, double w, double s);

/* Perfect conductor by a 2-D boundary solution on graded panels [H/m]. */
status circuit_inductance_limit(const circuit_rail_section *s, double *L);

/* At one frequency f >= 0 [Hz], finite: L [H/m], R [ohm/m]. */
status circuit_inductance_at(const circuit_rail_section *s, double f, double fineness, double *L, double *R);

/* The same for all frequencies up to f_top [Hz] at once, by 2-D filaments graded to the skin depth; freed by
 * circuit_impedance_free. */
status circuit_inductance_response(const circuit_rail_section *s, double f_top, double fineness,
                                   circuit_impedance *out);

/* Along the surface from the middle of the bore face over the edge to the middle of the back, at the frequency f [Hz]
 * and a current of 1 A in the rail: current density [A/m^2 per A] and heating [W/m^3 per A^2], both of effective
 * values. */
typedef struct {
    int n;
    double *place;             /* [m], owns all three */
    double *current, *heating; /* in place's block */
} inductance_surface;
status circuit_inductance_surface_at(const circuit_rail_section *s, double f, double fineness, inductance_surface *out);
void circuit_inductance_surface_free(inductance_surface *p);

#endif

/* Inductance and resistance gradients of two equal rectangular rails (per unit length, the pair as one loop).
 *
 * h = height across the bore, w = thickness, s = separation of the facing surfaces [m]. */
#ifndef BREECH_CIRCUIT_INDUCTANCE_H
#define BREECH_CIRCUIT_INDUCTANCE_H

#include "circuit/impedance.h"

/* Kerrisk's closed formula for the perfect conductor: within 1.5 % for s/h >= 0.5, up to 4 % off for narrower gaps (of the
 * boundary solution below; see docs/shot.md) [H/m]. */
double inductance_kerrisk(double h, double w, double s);

/* Perfect conductor by a 2-D boundary solution on graded panels [H/m]. */
status inductance_limit(double h, double w, double s, double *L);

/* Conductor of resistivity [ohm m] at frequency f >= 0 [Hz], finite: 2-D filaments graded to the skin depth.
 * L [H/m], R [ohm/m], both rails. */
status inductance_at(const double section[3] /* h, w, s */, double resistivity, double f, double *L, double *R);

/* The same for all frequencies up to f_top [Hz] at once. */
status inductance_response(const double section[3], double resistivity, double f_top, impedance *out);

#endif

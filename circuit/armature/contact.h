/* SPDX-License-Identifier: BSD-3-Clause */
/* How far the current spreads over a sliding contact: the velocity skin effect (internal to circuit/).
 *
 * Under the contact the rail takes up the current as it passes, K(x) from 0 at the leading edge to I/width at the
 * trailing one, x = l.  Its skin is thin, and what entered at s has had the time (x - s)/v to sink in: surface field
 * E(x) = sqrt(mu0 rho v/pi) int_0^x K'(s)/sqrt(x - s) ds.  An interface of specific resistance r has the voltage r J on
 * it, J = K', and E is what changes it on the way:  r dJ/dx = E.  Hence
 *   J(x) = J(0) E_3/2((x/d)^(3/2)),   d = (r^2/(mu0 rho v))^(1/3)                             (C-22)
 * with Mittag-Leffler's function: even where the contact is shorter than d, (2/3) exp(x/d) where it is much longer, all
 * at the trailing edge where r = 0.  young1982 found the same one parameter, l^3 v over resistivities, for a laminated
 * armature, whose laminations are such an interface.
 * r is taken from the contact voltage, r = (V_c/2) area/I: half of it on each face, over the mean current density.
 * Where n = 4 faces have I/2 each, area is that of the two side by side, n/2 faces.
 * The armature's own skin is not in it: its current has had a millisecond, the rail's a few microseconds.
 * young1982: F. J. Young, W. F. Hughes, IEEE Trans. Magn. 18 (1982) 33. */
#ifndef BREECH_CIRCUIT_CONTACT_H
#define BREECH_CIRCUIT_CONTACT_H

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    double length;      /* l of one face along the rail [m] */
    double interface;   /* r I = (V_c/2) (n/2) area [V m^2]; 0: the current enters evenly at any speed */
    double resistivity; /* of the rail's face [ohm m] */
} circuit_sliding_contact;

/* I over J(l) and the width: the length over which the current enters, 0 .. l [m].  v >= 0 [m/s], I of any sign [A]. */
double circuit_contact_spread(const circuit_sliding_contact *c, double v, double I);

/* Mean of J over J(l) for a contact of z = l/d, 1 at 0, 1/z for z >> 1 [1]. */
double circuit_contact_evenness(double z);

#ifdef __cplusplus
}
#endif

#endif

/* SPDX-License-Identifier: BSD-3-Clause */
/* The melt between a face of the armature and the rail: how thick it is, what it costs to shear it (internal to
 * circuit/).
 *
 * The share f of the heat at the contact melts the face off at the speed w, H its heat of melting a volume:
 *   w = f (tau v + q)/H,    q the current's heat per area                                     (C-20)
 * The melt enters all along the face (length l), the rail drags it backward, and the pressure P pushes it out at both
 * ends. Lubrication with the thickness h the same everywhere, a dry rail in front (what is not yet a full film is
 * carried off in streaks at no pressure, as under cavitation):
 *   h_s = (eta w l^2/P)^(1/3)                       h at which squeezing out alone bears P
 *   w l < v h_s:  2/h = 1/h_s + v/(w l),  tau = eta w l/h^2     the front part is streaks
 *   else:         h = h_s,                tau = eta v/h         full film, some of it goes out in front          (C-21)
 *   eta = eta_0 (1 + 0.0012 Re^0.94),  Re = 2 rho w l/eta_0     turbulent films: ng1965, constantinescu's fit; Re of
 *   the flux that leaves
 * docs/theory/circuit.md derives it.  Sources: melting at the contact stiffler1984; streaks as in elrod1981.
 * Limits that hold: h is below 2 w l/v and below h_s; P -> 0 gives h = 2 w l/v; v -> 0 gives tau -> 0; both laws for
 * tau agree where they meet. stiffler1984: J. Tribology 106, 416.  elrod1981: J. Lubr. Technol. 103, 350.  ng1965: C.
 * W. Ng, C. H. T. Pan, J. Basic Eng. 87, 675. */
#ifndef BREECH_CIRCUIT_FILM_H
#define BREECH_CIRCUIT_FILM_H

typedef struct {
    double viscosity; /* eta_0 of the melt [Pa s] */
    double density;   /* rho [kg/m^3] */
    double melting;   /* H, from before the shot to melt [J/m^3] */
    double length;    /* l [m] */
    double share;     /* f of the contact's heat that melts; > 0 [1] */
} melt_film;

typedef struct {
    double recession; /* w [m/s] */
    double thickness; /* h [m] */
    double shear;     /* tau [Pa] */
} melt_flow;

/* v [m/s], P >= 0 [Pa], q >= 0 [W/m^2].  v <= 0: no film, no shear. */
melt_flow circuit_melt_film_at(const melt_film *f, double v, double P, double q);

#endif

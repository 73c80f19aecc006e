/* SPDX-License-Identifier: BSD-3-Clause */
/* Heat of a passage: how warm the rail is under a place of its face, and how that strains it.
 *
 * The contact comes over the place at time 0 and leaves it after the dwell t_c = length / speed.  Meanwhile the rail's
 * share of the contact's heat enters as a constant flux, which takes the face to the rise R.  From then on the current
 * that the armature has exposed sinks into the rail and heats it.  At the face, after 2 t_c, both are those of (C-17).
 *   T(z, t) = R sqrt(pi) [S(t) - S(t - t_c)] + J [E1(z^2 / (2 D t)) - E1(z^2 / (2 D t_c))]
 *   S(t) = sqrt(t / t_c) ierfc(z / (2 sqrt(kappa t))),  J = mu0 K^2 / (pi rho c),  D = rho_e / mu0             (L-8)
 * the second bracket from t_c on.  The face is no warmer than the film that heats it (C-16):
 *   R = min(2 q sqrt(t_c) / sqrt(pi k rho c), T_film - T_0)                                                    (L-9)
 *
 * The warm layer is thin and cannot expand along the face.  What the metal is strained beyond its free expansion is
 *   xx = yy = -alpha T,   zz = 2 nu alpha T / (1 - nu)                                                         (L-10)
 * and nothing presses on the face.  If it yields, xx stays as it is, and zz comes nearer to 2 alpha T. */
#ifndef BREECH_COUPLING_LIFE_HEAT_H
#define BREECH_COUPLING_LIFE_HEAT_H

typedef struct {
    double dwell;        /* t_c [s] */
    double rise;         /* R [K] */
    double conducts;     /* kappa, of heat [m^2/s] */
    double current_rise; /* J [K] */
    double diffuses;     /* D, of the current [m^2/s] */
} life_heat;

/* What a rail is made of and passed by. */
typedef struct {
    double conductivity, heat_capacity; /* k, rho c [W/(m K), J/(m^3 K)] */
    double resistivity;                 /* rho_e [ohm m] */
} life_heat_metal;

/* Of the flux q [W/m^2], the current K on a metre of the face [A/m] and the rise of the film [K]. */
life_heat life_heat_of(const life_heat_metal *m, double dwell, double flux, double sheet, double film_rise);
/* R by the flux alone. */
double life_heat_flux_rise(const life_heat_metal *m, double dwell, double flux);

double life_heat_rise(const life_heat *h, double depth, double time); /* T [K]; 0 before the contact comes */
/* The largest up to this time, which must not lie before the dwell's end, within a per cent. */
double life_heat_largest_rise(const life_heat *h, double depth, double until);
/* Strain xx, zz, gamma of a rise. */
void life_heat_strain(double rise, double expansion, double poisson, double strain[3]);

#endif

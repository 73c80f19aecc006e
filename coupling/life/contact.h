/* SPDX-License-Identifier: BSD-3-Clause */
/* A load on the face of a half space in plane strain: stress, strain and displacement under it in closed form.
 *
 * x along the face, z into the body.  The face carries a pressure p(x) and a traction q(x) that pulls the body to +x:
 * stress_zz = -p, stress_xz = -q at z = 0.  With  w = x + i z  and the integrals of Boussinesq, Cerruti as potentials
 * (Muskhelishvili, Some basic problems of the mathematical theory of elasticity, ch. 16),
 *   P(w) = 1 / (2 pi i) int p(s) / (s - w) ds,  Q the same of q,  F = -(P - i Q),  H = -(P + i Q)
 *   xx + zz = 4 Re F,   zz + i xz = conj F + H - 2 i z F'                                                        (L-2)
 *   2 G (u_x + i u_z) = (3 - 4 nu) int F - 2 i z conj F - conj int H                                             (L-3)
 * The integral is closed for the two kinds of piece that a load is a sum of:
 *   an ellipse         sqrt(1 - (s - c)^2 / b^2)   Hertz's pressure; Carter's traction is two of them
 *   a straight piece   from one value to another   uniform and tabulated loads
 * Tractions of the three states of rolling contact, mu the friction (Johnson, Contact mechanics, 1985, ch. 8):
 *   frictionless q = 0;  full slip q = mu p;
 *   stick-slip   q = mu p0 [sqrt(1 - x^2/a^2) - (c/a) sqrt(1 - (x + d)^2/c^2)],  c/a = sqrt(1 - Q/(mu P)), d = a - c
 *                Carter's, the second term within the stick zone |x + d| <= c, at the leading edge x = -a      (L-4) */
#ifndef BREECH_COUPLING_LIFE_CONTACT_H
#define BREECH_COUPLING_LIFE_CONTACT_H

#include "coupling/case/case_plain.h"

typedef struct {
    bool ellipse;       /* pressure[0], traction[0] at its middle; else straight from [0] to [1] */
    double from, to;    /* [m] */
    double pressure[2]; /* [Pa] */
    double traction[2]; /* [Pa] */
} contact_piece;

enum { CONTACT_MAX_PIECES = 200 };

typedef struct {
    int n;
    contact_piece piece[CONTACT_MAX_PIECES];
    double half_length; /* a: the load lies in -a .. a [m] */
    double peak;        /* largest pressure p0 [Pa] */
} contact_load;

/* A load that runs along the face at a steady speed v below that of Rayleigh waves, seen from the load: with a_i^2 =
 * 1 - v^2 / c_i^2 of the speeds c_1, c_2 of longitudinal and shear waves, w_i = x + i a_i z and
 *   R = (1 + a_2^2)^2 - 4 a_1 a_2
 *   A = 2 [(1 + a_2^2) P - 2 a_2 i Q] / (G R) at w_1     B = 2 [(1 + a_2^2) i Q - 2 a_1 P] / (G R) at w_2
 *   xx = Re A + a_2 Re B,   zz = -a_1^2 Re A - a_2 Re B,   gamma = -2 a_1 Im A - (1 + a_2^2) Im B               (L-7)
 * after Cole and Huth (Journal of Applied Mechanics 25 (1958) 433).  Under a pressure p alone stress_xx = -K p at the
 * face; K is 1 at rest and grows without limit towards the speed of Rayleigh waves, where R = 0. */
typedef struct {
    double a1, a2, rayleigh; /* rayleigh: R [1] */
    double shear;            /* G [Pa] */
} contact_speed;
contact_speed life_contact_speed(double youngs, double poisson, double density, double speed);
double life_contact_rayleigh(double youngs, double poisson, double density); /* speed of these waves [m/s] */
double life_contact_factor(const contact_speed *s);                          /* K [1] */
/* Strain xx, zz, gamma. */
void life_contact_moving(const contact_load *l, const contact_speed *s, double x, double z, double strain[3]);

/* What the section `life` says: profile, pressure, traction. */
status life_contact_load(const case_life *c, contact_load *out);

/* In full slip under an armature: even but for the ends, where it rises straight over a share `rounding` of the half
 * length, with the mean `pressure` over the whole length. */
contact_load life_contact_armature(double half_length, double rounding, double pressure, double friction);

double life_contact_pressure(const contact_load *l, double x); /* [Pa] */
double life_contact_traction(const contact_load *l, double x); /* [Pa] */
/* Forces on a metre of the slice: int p dx, int q dx [N/m]. */
void life_contact_forces(const contact_load *l, double *normal, double *tangential);

/* Stress xx, zz, xz [Pa]; z >= 0. */
void life_contact_stress(const contact_load *l, double x, double z, double stress[3]);
/* Strain xx, zz and gamma = 2 xz of a stress in plane strain. */
void life_contact_strain(const double stress[3], double youngs, double poisson, double strain[3]);
/* Displacement x, z [m], but for a motion of the whole body, which a plane load leaves open. */
void life_contact_displacement(const contact_load *l, double x, double z, double youngs, double poisson,
                               double displacement[2]);

#endif

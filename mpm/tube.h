/* SPDX-License-Identifier: BSD-3-Clause */
/* A tube of fluid in one dimension: a piston of given mass runs into the column, and its wave meets what closes the
 * tube at the other end.
 *
 *      piston   column of fluid                    far end: wall, free plate, or more fluid
 *     ___________________________________________
 *    |==>|  .  .  .  .  .  .  .  .  .  .  .  .  .|      x = 0 .. length, places of the fluid at rest
 *     -------------------------------------------
 *
 * Waves in a tube are plane until they meet a target that gives way unevenly; until then three dimensions compute the
 * same for a thousand times the work.  The fluid has the solver's own law, equation of state and cavitation, and a
 * viscosity like (M-5).  Cells move with the fluid; of cell j with mass m_j [kg/m2]
 *   M_i dv_i/dt = P_(i-1) - P_i,   P = p + q,   m_j de_j = -P_j (vbar_(j+1) - vbar_j) dt                        (W-1)
 * with vbar = (v_old + v_new)/2,
 * in two stages: P of the first is that at the step's start, of the second the mean of that and what the first has
 * found.  So momentum and energy are kept to rounding, through cavitation too.
 * The acoustic answers it is held against: p = rho c v0 exp(-t/theta) at the piston, theta = M/(rho c), and Taylor's
 * plate. */
#ifndef BREECH_MPM_TUBE_H
#define BREECH_MPM_TUBE_H

#include "mpm/material.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum { TUBE_WALL, TUBE_PLATE, TUBE_GOES_ON } tube_end;

typedef struct {
    const mpm_material *fluid; /* borrowed; a material without strength */
    double piston_mass;        /* on its area [kg/m2] */
    double piston_velocity;    /* at the start [m/s] */
    double length;             /* of the column at rest [m] */
    int end;                   /* tube_end */
    double plate_mass;         /* TUBE_PLATE: on its area [kg/m2] */
    int cells;
} mpm_tube_setup;

typedef struct mpm_tube mpm_tube; /* owns its memory */

/* STATUS_BAD_INPUT names what is out of range. */
status mpm_tube_create(const mpm_tube_setup *setup, mpm_tube **out);
void mpm_tube_free(mpm_tube *t); /* NULL allowed */

void mpm_tube_step(mpm_tube *t);
void mpm_tube_advance(mpm_tube *t, double until); /* steps that end there [s] */

/* With everything per area of the tube. */
typedef struct {
    double time;            /* [s] */
    double piston_velocity; /* [m/s] */
    double piston_pressure; /* in the first cell, with viscosity [Pa] */
    double end_pressure;    /* in the last one [Pa] */
    double end_velocity;    /* of the plate, or of the fluid's last node [m/s] */
    double end_way;         /* how far that has moved [m] */
    double void_length;     /* that cavities take up, fluid at the cavitation pressure beyond its density at rest [m] */
    double momentum_error;  /* over that of the piston at the start [1] */
    double energy_error;    /* the same of energy [1] */
} mpm_tube_state;
mpm_tube_state mpm_tube_now(const mpm_tube *t);

double mpm_tube_time(const mpm_tube *t); /* [s] */
/* In the fluid that lay there at rest [Pa]. */
double mpm_tube_pressure(const mpm_tube *t, double x);

#ifdef __cplusplus
}
#endif

#endif

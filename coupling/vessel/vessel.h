/* SPDX-License-Identifier: BSD-3-Clause */
/* Gas in liquid inside a thin ductile shell, reduced to a handful of numbers: it swells until the shell bursts.
 *
 *        .-- film: strength and failure by the laws of its material
 *       /   .-- liquid: by its equation of state
 *      /   /   .-- bubbles: n_k moles each, all under the same pressure
 *   (film( liquid  (o)  (O) ))       a sphere, or a metre of a cylinder in plane strain (d = 3, 2)
 *
 * At rest at every instant: heat takes a tenth of a second, sound less than a microsecond.  p counts from the ambient
 * pressure p_a.
 *   gas       p + p_a = p_gas(v)                          all bubbles have the molar volume v           (G-1)
 *   volume    V = V_liquid(p) + v sum_k n_k               inside the film                               (G-2)
 *   film      p = sum_j k sigma_j ln(r_j+1/r_j)           layers j of equal, constant volume            (G-3)
 *             sigma_j <= flow stress, of the strain k ln(r/r_0);   k = 2/sqrt(3) in a cylinder, 2 in a sphere
 *   growth    dn_k/dt = A_k (6 Ja^2 alpha/pi)/(R_k v_a)   A_k, R_k of the bubble, v_a at p_a            (G-4)
 *             so that a single bubble in open liquid has R = Ja sqrt(12 alpha t/pi), Plesset and Zwick (1954)
 *   vent      dn_0/dt = -C A_hole (p + p_a) psi/sqrt(R T M)  from the largest bubble, once it has burst  (G-5)
 *             psi of an ideal gas through an orifice, choked or not
 * It bursts when one layer has failed: all of the film is under one pressure, so that the place that loses a layer
 * first is weaker than the rest and does not get its load back.  Then a hole is there; the film around it is as it was,
 * and goes back elastically as the gas leaves. */
#ifndef BREECH_COUPLING_VESSEL_VESSEL_H
#define BREECH_COUPLING_VESSEL_VESSEL_H

#include "coupling/case/case_plain.h"
#include "mpm/law/gas.h"

enum { VESSEL_MAX_BUBBLES = 64, VESSEL_MAX_LAYERS = 256 };

typedef struct {
    double time;           /* [s] */
    double swelling;       /* outer radius over that at the start [1] */
    double pressure;       /* above the ambient one [Pa] */
    double film;           /* thickness [m] */
    double strain, damage; /* equivalent plastic strain, damage of the inner layer [1] */
    double moles;          /* of all bubbles, a metre's in a cylinder [mol] */
    double bubble;         /* radius of the largest [m] */
    double flow;           /* through the hole [mol/s] */
} vessel_state;

typedef struct {
    const case_vessel *is; /* borrowed */
    const mpm_material *film, *liquid;
    void (*step)(void *user, const vessel_state *at); /* after every step of time; NULL: nobody is told */
    bool (*stop)(void);                               /* NULL: never */
    void *user;
} vessel_how;

typedef struct {
    bool burst;
    vessel_state rupture; /* NAN where it has not burst */
    vessel_state end;
    double peak_pressure; /* [Pa] */
    double vent_time;     /* from there until the pressure is half; NAN: not reached [s] */
    double
        laplace; /* largest surface_tension/R of a bubble, twice that of a ball's, left out of all that is above [Pa] */
    int steps;
} vessel_result;

/* The film alone: the pressure that holds it at this swelling after it was swollen without a pause [Pa]. */
status vessel_film_pressure(const vessel_how *how, double swelling, double *pressure);

status vessel_possible(const vessel_how *how);
/* STATUS_STOPPED: `stop` said so.  What was reached stands in *out on error too. */
status vessel_run(const vessel_how *how, vessel_result *out);

#endif

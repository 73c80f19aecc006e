/* SPDX-License-Identifier: BSD-3-Clause */
/* The pair of rails as a moving load: a ladder (circuit/rails/ladder.h) for every slice of rail, each from the instant
 * at which the armature exposes it, summed exactly over all slices.  docs/theory/circuit.md derives it.
 * With j_k the current in rung k's inductance,
 *   Q_k = int_0^x j_k dx',  W_k = int_0^x j_k^2 dx',  tau_k = L_k/R_k,
 *   V_rails = d(L_inf x I + sum L_k Q_k)/dt + R_dc x I
 *   dQ_k/dt = (x I - Q_k)/tau_k + v a_k I,   dW_k/dt = 2 (I Q_k - W_k)/tau_k + v a_k^2 I^2                 (C-1)
 *   F = 1/2 I^2 [L_inf + sum L_k f_k],   heat = R_dc x I^2 + sum R_k (x I^2 - 2 I Q_k + W_k)
 *                                              + 1/2 v I^2 sum L_k (2 a_k - a_k^2 - f_k)                   (C-2)
 *   a = 1 - th (1 - exp(-1/th)),  f = 1 - 2 th + 2 th^2 (1 - exp(-1/th)),  th = v tau_k/contact's spread     (C-12)
 * With a heat capacity, the slices summed up in one memory share a temperature of their own, from their heat E, the
 * heat E_c that their cold resistance would have made, and the length-weighted action G = int x I^2 dt:
 *   rise = E/(C x) E_c/(R_dc G),  R_dc and R_k times 1 + coefficient rise                               (C-24)
 * R_dc: of even current, the ladder's own but where that has the R' of a skin for it.
 * The second factor is all the metal over the area that carries the current, in the mean over the action so far.
 * Laws, for any I(t) and any v >= 0: V_rails I = d(field)/dt + heat + F v, field = 1/2 L_inf x I^2 + 1/2 sum L_k W_k;
 * every part of the heat and of the force is 0 or more. */
#ifndef BREECH_CIRCUIT_RAILS_H
#define BREECH_CIRCUIT_RAILS_H

#include "circuit/armature/contact.h"
#include "circuit/rails/ladder.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    circuit_ladder ladder;           /* no rungs: constant gradients */
    circuit_sliding_contact contact; /* over which the current comes into the rail */
    double heat_capacity;            /* C, of all the metal in a length [J/m/K]; 0: the rails keep their resistance */
    double coefficient;              /* relative rise of the resistance [1/K] */
    double even_resistance;          /* R_dc of (C-24) [ohm/m]; 0: the ladder's */
} circuit_rails_load;

/* What the circuit sees; the current's slope comes on top: V = inductance dI/dt + voltage [V]. */
typedef struct {
    double inductance; /* L_inf x [H] */
    double voltage;    /* V_rails without L_inf x dI/dt [V] */
    double heat;       /* [W] */
    double field;      /* [J] */
} circuit_rails_flow;

/* memory: Q_k, W_k of every rung in turn [A m], [A^2 m]; then E, E_c [J], G [A^2 s m] if there is a heat capacity.
 * x [m], v >= 0 [m/s], I [A]. */
int circuit_rails_memory_size(const circuit_rails_load *r);
void circuit_rails_memory_scale(const circuit_rails_load *r, double x, double I, double E,
                                double *scale);                                                /* largest to expect */
double circuit_rails_memory_rise(const circuit_rails_load *r, double x, const double *memory); /* (C-24) [K] */
double circuit_rails_warming(const circuit_rails_load *r, double x,
                             const double *memory); /* factor of all resistances there [1] */
circuit_rails_flow circuit_rails_flow_at(const circuit_rails_load *r, double x, double v, double I,
                                         const double *memory);
void circuit_rails_memory_rates(const circuit_rails_load *r, double x, double v, double I, const double *memory,
                                double *rates);

/* 2 F/I^2 [H/m]: L' of direct current at rest, L_inf at great speed.  I matters where the contact crowds (contact.h).
 */
double circuit_rails_force_gradient(const circuit_rails_load *r, double v, double I);

/* a_k and f_k of (C-12) at theta = v tau_k/contact's spread >= 0 [1]. */
double circuit_rails_share_at_birth(double theta);
double circuit_rails_share_of_force(double theta);

#ifdef __cplusplus
}
#endif

#endif

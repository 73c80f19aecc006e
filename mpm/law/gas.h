/* SPDX-License-Identifier: BSD-3-Clause */
/* A gas at one temperature in a cavity, by Redlich and Kwong (Chemical Reviews 44 (1949) 233):
 *   p = R T/(v - b) - a/(sqrt(T) v (v + b)),   a = 0.42748 R^2 T_c^2.5/p_c,   b = 0.08664 R T_c/p_c               (G-1)
 * with v the volume of a mole.  a = b = 0 is the ideal gas. */
#ifndef BREECH_MPM_GAS_H
#define BREECH_MPM_GAS_H

typedef struct {
    double temperature; /* [K] */
    double a, b;        /* [Pa m6 K^0.5/mol2, m3/mol] */
    double least; /* volume of a mole below which it is no vapour: where p(v) turns; b where it has no turn [m3/mol] */
} mpm_gas;

/* Of a gas whose critical point is known; NAN, NAN: an ideal gas [K, K, Pa]. */
mpm_gas mpm_gas_make(double temperature, double critical_temperature, double critical_pressure);

double mpm_gas_pressure(const mpm_gas *g, double molar_volume); /* absolute [Pa] */
double mpm_gas_molar_volume(const mpm_gas *g, double pressure); /* of the vapour: the largest [m3/mol] */
/* An orifice: of an ideal gas, from p to p_a, choked or not [mol/s]. */
typedef struct {
    double area, discharge;   /* [m2, 1] */
    double gamma, molar_mass; /* ratio of specific heats [1, kg/mol] */
} mpm_orifice;
double mpm_gas_flow(const mpm_orifice *o, double temperature, double p, double p_a);

double mpm_gas_condenses(const mpm_gas *g); /* pressure beyond which there is no vapour; INFINITY: none [Pa] */

#endif

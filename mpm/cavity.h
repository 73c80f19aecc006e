/* SPDX-License-Identifier: BSD-3-Clause */
/* Cavities: gas between bodies, two numbers each, moles and volume, instead of points.
 *
 *   p = p_gas(V/n) - p_a        at a temperature that stays (law/gas.h), counted from the ambient pressure       (G-6)
 *   m_i dv_i/dt = f_i - p G_i,   G_i = sum_p V_p grad S_ip, at nodes about the cavity                            (G-7)
 *   dV/dt = - sum_i G_i . v_i                                                                                    (G-8)
 *
 *   . . . . . . .    The gradients of a shape function over matter and void together sum to zero, so that of the void
 *   # # # # # . .    is -G_i: the gas pushes on the nodes as if it were there.  Where no void is, G_i is zero but for
 *   # # o o # # .    what points leave of it, so only nodes (o and two around) about empty cells of the cavity are
 *   # o     o # .    taken.  With (G-8) the work of the gas, p dV, is what the nodes get.
 *   # # o o # # .
 *
 * Which cells a cavity has is found every CAVITY_EVERY steps by flooding what no domain of an intact point covers, from
 * what it had.  Two that meet become one, with the holes of both.  Moles come in by `feed`.  The cavity has burst when
 * the intact points of `wall` no longer lie between it and an end of the window that is no mirror, by a flood through
 * all else: by their damage, not by gaps between them.  Then gas leaves through `hole`, as through an orifice; where
 * the void itself comes to the window's end, the cavity is open: its gas has no pressure any more, and moles are only
 * counted, as they came in and left through the hole.
 * Moles and volume are those of the model as computed; the grid has one level. */
#ifndef BREECH_MPM_CAVITY_H
#define BREECH_MPM_CAVITY_H

#include "base/param.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { MPM_MAX_CAVITIES = 15, MPM_CAVITY_EVERY = 20 };

typedef struct {
    char name[BASE_PARAM_TEXT_SIZE];
    int wall;                                       /* body that holds it in; -1: none, it does not burst */
    double place[3];                                /* a point in it at the start [m] */
    double pressure, ambient;                       /* at the start, above the ambient one; that [Pa] */
    double temperature;                             /* [K] */
    double critical_temperature, critical_pressure; /* NAN: an ideal gas [K, Pa] */
    double feed;                                    /* gas that comes in [mol/s] */
    double hole;                                    /* area that opens when it bursts, 0: it keeps its gas [m2] */
    double discharge, molar_mass, gas_gamma;        /* of the flow through it [1, kg/mol, 1] */
} mpm_cavity;

/* From row MPM_CAVITY_KEYED on the rows are keys of a case file too. */
enum { MPM_CAVITY_KEYED = 1 };
extern const base_param mpm_cavity_params[];

/* One of them, now. */
typedef struct {
    double moles, volume; /* [mol, m3] */
    double pressure;      /* above the ambient one [Pa] */
    double burst_time;    /* of the first that has, of those joined here too; NAN: none has [s] */
    double open_hole;     /* area that gas leaves through, of all that have burst [m2] */
    double lost;          /* moles that have left [mol] */
    double found;         /* volume by cells less points, at the last look [m3] */
    int joined;           /* the cavity that it is part of now, which has joined none; -1: none */
    bool open;            /* its void reaches the window's end */
} mpm_cavity_state;

struct mpm;
const mpm_cavity_state *mpm_cavity_of(const struct mpm *m, int cavity); /* borrowed */

#ifdef __cplusplus
}
#endif

#endif

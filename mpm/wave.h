/* SPDX-License-Identifier: BSD-3-Clause */
/* A plane wave that enters a body of fluid through one of its faces (mpm_body.wave_pressure, piston_mass).
 *
 *       p_i(t) -->  |  fluid  . . . . . . . . . . .  |  target
 *                   |                     <-- p_r    |
 *
 * The fluid that would lie before the face is left out.  There the incident wave and what comes back add up: with the
 * incident wave's own velocity, p_i = rho0 (c0 + s u_i) u_i, and the slope of that curve, Z = rho0 (c0 + 2 s u_i),
 *   p = p_0 + p_i + Z (u_i - u)                                                                               (W-2)
 * p_0 the fluid's pressure at the start, u the face's velocity, inwards: u = u_i where nothing has come back, and a
 * wave that comes back leaves.  The fluid left out takes no tension either: p is at least the cavitation pressure.  The
 * load goes with the points of the face.
 * Its work and its impulse are external ones in the ledger. */
#ifndef BREECH_MPM_WAVE_H
#define BREECH_MPM_WAVE_H

#include "mpm/law/law.h"
#include "mpm/tube.h"

#include <math.h>

/* Does a wave enter this body? */
static inline bool mpm_wave_is_wanted(const mpm_body *b)
{
    return !isnan(b->wave_pressure) || !isnan(b->piston_mass);
}

/* STATUS_BAD_INPUT: constants that do not go together, or a body that is no fluid. */
status mpm_wave_check(const mpm_body *b);

/* The incident wave of one body over time: an exponential, or what comes to the end of a piston's tube from the front's
 * arrival on.  The tube is computed as far as it was asked for. */
typedef struct {
    double pressure, rate;   /* an exponential: at first, and one over its decay [Pa, 1/s] */
    int n;                   /* rows of a piston's wave; 0: the exponential */
    double *time, *incident; /* [n] owned [s, Pa] */
    mpm_tube *tube;          /* owned; NULL: the wave has gone by */
    double length;           /* of the tube [m] */
    double arrival;          /* of the front at its end, in the tube's time [s] */
    double longest;          /* the wave is cut off so long after that [s] */
    double acoustic, peak;   /* rho0 c0 v; the largest pressure so far [Pa] */
} mpm_wave;

/* STATUS_BAD_INPUT: a tube of too many cells, or at whose end nothing arrives. */
status mpm_wave_make(const mpm_body *b, const law *k, mpm_wave *out);
status mpm_wave_reach(mpm_wave *w, double t); /* has its rows up to t; STATUS_MEMORY */
void mpm_wave_free(mpm_wave *w);

/* (W-2) over one step: pressure on the face = max(base - Z u, least). */
typedef struct {
    bool on;
    int axis;
    double inwards;        /* 1 or -1: where the face's inner side lies along that axis */
    double base, Z, least; /* [Pa, Pa s/m, Pa] */
} wave_load;
/* After mpm_wave_reach to t. */
wave_load mpm_wave_load(const mpm_wave *w, const mpm_body *b, const law *k, double t);

#endif

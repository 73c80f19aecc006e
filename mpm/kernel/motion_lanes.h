/* SPDX-License-Identifier: BSD-3-Clause */
/* Kinematics of a step.  Over it the places near a point move by x' = F x, F = 1 + dt L, with L the velocity gradient
 * over the places at the start of the step (the weights' places).  The law needs it to second order:
 *   at the end      L F^-1, which the points around have then too, and which goes on as the point's affine part,
 *   in the middle   L (1 + dt L / 2)^-1 = (L + L F^-1)/2 + O(dt^2),
 *   volume          rho = rho / det F.
 * With L alone strain and stress are right to first order only: tests/validate, V1. */
#ifndef BREECH_MPM_MOTION_LANES_H
#define BREECH_MPM_MOTION_LANES_H

#include "mpm/kernel/lanes.h"

typedef struct {
    vd start[9], middle[9], end[9]; /* velocity gradients, [3 i + k] = dv_i/dx_k [1/s] */
    vd growth;                      /* det F, volume after over before [1] */
} motion;

/* A point that would turn inside out is held at a fifth of its volume: what is so far gone is bounded, not described.
 */
#define MOTION_LEAST_GROWTH 0.2

/* inverse x determinant */
LANE_INLINE void adjugate(const vd F[9], vd a[9])
{
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const int r0 = (k + 1) % 3, r1 = (k + 2) % 3, c0 = (i + 1) % 3, c1 = (i + 2) % 3;
            a[3 * i + k] = F[3 * r0 + c0] * F[3 * r1 + c1] - F[3 * r0 + c1] * F[3 * r1 + c0];
        }
}

LANE_INLINE motion motion_of(const vd L[9], double dt)
{
    motion r;
    vd F[9], a[9];
    for (int i = 0; i < 9; i++) F[i] = dt * L[i] + (i % 4 == 0 ? 1.0 : 0.0);
    adjugate(F, a);
    r.growth = vd_max(F[0] * a[0] + F[1] * a[3] + F[2] * a[6], vd_set(MOTION_LEAST_GROWTH));
    const vd scale = 1.0 / r.growth;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++) {
            const int at = 3 * i + k;
            r.start[at] = L[at];
            r.end[at] = scale * (L[3 * i] * a[k] + L[3 * i + 1] * a[3 + k] + L[3 * i + 2] * a[6 + k]);
            r.middle[at] = 0.5 * (L[at] + r.end[at]);
        }
    return r;
}

LANE_INLINE vd trace(const vd L[9])
{
    return L[0] + L[4] + L[8];
}

#endif

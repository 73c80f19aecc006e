/* SPDX-License-Identifier: BSD-3-Clause */
/* Plastic flow: no cell may be so large that the velocity changes by more than `jump` across it,
 *   h <= jump / edot_p,   edot_p = s : D / sigma_y of a point that yields, 0 of another.
 * Points at their yield stress flow now and then in the noise of a contact, so their mean is what counts.  Flow goes on
 * with the velocity of the metal, a fraction of a wave's: it is looked at half as often as a wave, and one cell around
 * it is enough. */
#include "mpm/refine/refine_kinds.h"

typedef struct {
    double jump;
} plastic;

static const base_param params[] = {
    PARAM_DOUBLE(plastic, jump, "m/s", 20.0, 1e-6, 1e6, "velocity across a cell that plastic flow may make"), PARAMS_END
};

static double rate_of(const block *q, int l)
{
    double square = 0;
    const double flow = q->flow[0][l];
    if (q->damage[0][l] >= 1 || !(flow > 0)) return 0;
    for (int i = 0; i < 6; i++) square += (i < 3 ? 1 : 2) * q->s[i][l] * q->s[i][l];
    if (1.5 * square < 0.81 * flow * flow) return 0; /* a point that has just flowed lies a little inside */
    double power = 0;
    for (int i = 0; i < 3; i++) power += q->s[i][l] * q->L[4 * i][l];
    power += q->s[3][l] * (q->L[1][l] + q->L[3][l]) + q->s[4][l] * (q->L[2][l] + q->L[6][l]) +
             q->s[5][l] * (q->L[5][l] + q->L[7][l]);
    return fmax(power, 0) / flow;
}

static void cells(const mpm *m, const mpm_refine *r, int index, double *cell)
{
    const double jump = REFINE_VALUES(plastic, r)->jump;
    for (int l = 0; l < LANES; l++) cell[l] = jump / rate_of(&m->blocks[index], l);
}

const mpm_refine_kind mpm_refine_plastic = { .name = "plastic",
                                             .doc = "where metal flows plastically",
                                             .params = params,
                                             .mean = true,
                                             .buffer = 1,
                                             .every = 2 * MPM_REFINE_EVERY,
                                             .cells = cells };

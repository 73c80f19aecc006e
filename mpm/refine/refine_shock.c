/* SPDX-License-Identifier: BSD-3-Clause */
/* A pressure jump: no cell may be so large that the velocity drops by more than `jump` across it,
 *   h <= jump / -div v. */
#include "mpm/refine/refine_kinds.h"

typedef struct {
    double jump;
} shock;

static const base_param params[] = { PARAM_DOUBLE(shock, jump, "m/s", 20.0, 1e-6, 1e6,
                                                  "drop of velocity across a cell that compression may make"),
                                     PARAMS_END };

static void cells(const mpm *m, const mpm_refine *r, int index, double *cell)
{
    const double jump = REFINE_VALUES(shock, r)->jump;
    double(*const L)[LANES] = m->blocks[index].L;
    for (int l = 0; l < LANES; l++) cell[l] = jump / fmax(-(L[0][l] + L[4][l] + L[8][l]), 0);
}

const mpm_refine_kind mpm_refine_shock = { .name = "shock",
                                           .doc = "where a pressure jump passes",
                                           .params = params,
                                           .buffer = 2,
                                           .every = MPM_REFINE_EVERY,
                                           .cells = cells };

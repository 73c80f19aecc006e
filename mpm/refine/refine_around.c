/* SPDX-License-Identifier: BSD-3-Clause */
/* A body and what lies near it, whatever happens there. */
#include "mpm/refine/refine_kinds.h"

typedef struct {
    double within;
} around;

static const base_param params[] = { PARAM_DOUBLE(around, within, "m", 0.0, 0.0, 1e3, "of any of the body's points"),
                                     PARAMS_END };

static double reach(const mpm_refine *r)
{
    return REFINE_VALUES(around, r)->within;
}

static void cells(const mpm *m, const mpm_refine *r, int index, double *cell)
{
    (void)m, (void)index;
    for (int l = 0; l < LANES; l++) cell[l] = r->cell;
}

const mpm_refine_kind mpm_refine_around = { .name = "around",
                                            .doc = "around a body",
                                            .params = params,
                                            .of_body = true,
                                            .buffer = 2,
                                            .every = MPM_REFINE_EVERY,
                                            .reach = reach,
                                            .cells = cells };

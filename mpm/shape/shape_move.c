/* SPDX-License-Identifier: BSD-3-Clause */
/* Move: a solid shifted. */
#include "mpm/shape/shape.h"

typedef struct {
    double offset[3];
} move;

static const base_param params[] = { SHAPE_POINT(move, offset, REQUIRED, "by which it is shifted"), PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const double *o = SHAPE_VALUES(move, s)->offset;
    return mpm_solid_inside(mpm_solid_part(s, 0), (const double[3]){ x[0] - o[0], x[1] - o[1], x[2] - o[2] });
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const double *o = SHAPE_VALUES(move, s)->offset;
    mpm_solid_bounds(mpm_solid_part(s, 0), lo, hi);
    for (int k = 0; k < 3; k++) lo[k] += o[k], hi[k] += o[k];
}

const mpm_solid_kind mpm_shape_move = {
    .name = "move", .doc = "a solid shifted", .params = params, .parts = 1, .inside = inside, .bounds = bounds
};

/* SPDX-License-Identifier: BSD-3-Clause */
/* Minus: the first solid without the second. */
#include "mpm/shape/shape.h"

static const base_param params[] = { PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const double a = mpm_solid_inside(mpm_solid_part(s, 0), x), b = mpm_solid_inside(mpm_solid_part(s, 1), x);
    return fmin(a, -b);
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    mpm_solid_bounds(mpm_solid_part(s, 0), lo, hi);
}

const mpm_solid_kind mpm_shape_minus = { .name = "minus",
                                         .doc = "the first solid without the second",
                                         .params = params,
                                         .parts = 2,
                                         .inside = inside,
                                         .bounds = bounds };

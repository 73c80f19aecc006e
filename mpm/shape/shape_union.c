/* SPDX-License-Identifier: BSD-3-Clause */
/* Union: what lies in either of two solids. */
#include "mpm/shape/shape.h"

static const base_param params[] = { PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const double a = mpm_solid_inside(mpm_solid_part(s, 0), x), b = mpm_solid_inside(mpm_solid_part(s, 1), x);
    return fmax(a, b);
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    double other_lo[3], other_hi[3];
    mpm_solid_bounds(mpm_solid_part(s, 0), lo, hi);
    mpm_solid_bounds(mpm_solid_part(s, 1), other_lo, other_hi);
    for (int k = 0; k < 3; k++) lo[k] = fmin(lo[k], other_lo[k]), hi[k] = fmax(hi[k], other_hi[k]);
}

const mpm_solid_kind mpm_shape_union = { .name = "union",
                                         .doc = "what lies in either of two solids",
                                         .params = params,
                                         .parts = 2,
                                         .inside = inside,
                                         .bounds = bounds };

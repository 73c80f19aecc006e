/* SPDX-License-Identifier: BSD-3-Clause */
/* Pit: a hemisphere upside down, its flat face up, its middle at `center`; height is its depth.
 * Signed distance as mpm_shape_dome. */
#include "mpm/shape/shape.h"

typedef struct {
    double center[3], radius, height;
} pit;

static const base_param params[] = { SHAPE_POINT(pit, center, 0, "middle of its flat face"),
                                     SHAPE_LENGTH(pit, radius, "of the flat face"),
                                     SHAPE_LENGTH(pit, height, "its depth"), PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const pit *b = SHAPE_VALUES(pit, s);
    const double r = hypot(x[0] - b->center[0], x[2] - b->center[2]);
    return mpm_shape_dome(b->radius, b->height, r, b->center[1] - x[1]);
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const pit *b = SHAPE_VALUES(pit, s);
    const double flat[3] = { b->radius, 0.0, b->radius }, round[3] = { b->radius, b->height, b->radius };
    mpm_shape_box_about(b->center, round, flat, lo, hi);
}

const mpm_solid_kind mpm_shape_pit = { .name = "pit",
                                       .doc = "half an ellipsoid of revolution about y, flat face up",
                                       .params = params,
                                       .inside = inside,
                                       .bounds = bounds };

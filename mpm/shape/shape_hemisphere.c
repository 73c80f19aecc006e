/* SPDX-License-Identifier: BSD-3-Clause */
/* Hemisphere: flat face down, its middle at `center`; with height != radius the upper half of an ellipsoid of
 * revolution about y.  Signed distance as mpm_shape_dome. */
#include "mpm/shape/shape.h"

typedef struct {
    double center[3], radius, height;
} hemisphere;

static const base_param params[] = { SHAPE_POINT(hemisphere, center, 0, "middle of its flat face"),
                                     SHAPE_LENGTH(hemisphere, radius, "of the flat face"),
                                     SHAPE_LENGTH(hemisphere, height, "from the flat face to the top"), PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const hemisphere *b = SHAPE_VALUES(hemisphere, s);
    const double r = hypot(x[0] - b->center[0], x[2] - b->center[2]);
    return mpm_shape_dome(b->radius, b->height, r, x[1] - b->center[1]);
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const hemisphere *b = SHAPE_VALUES(hemisphere, s);
    const double flat[3] = { b->radius, 0.0, b->radius }, round[3] = { b->radius, b->height, b->radius };
    mpm_shape_box_about(b->center, flat, round, lo, hi);
}

const mpm_solid_kind mpm_shape_hemisphere = { .name = "hemisphere",
                                              .doc = "half an ellipsoid of revolution about y, flat face down",
                                              .params = params,
                                              .inside = inside,
                                              .bounds = bounds };

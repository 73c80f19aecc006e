/* SPDX-License-Identifier: BSD-3-Clause */
/* Ridge: half a cylinder extruded along z, flat face down, its middle at `center`; radius is half its width along x.
 * With height != radius its section is half an ellipse.  Signed distance as mpm_shape_dome. */
#include "mpm/shape/shape.h"

typedef struct {
    double center[3], radius, height, half_length;
} ridge;

static const base_param params[] = { SHAPE_POINT(ridge, center, 0, "middle of its base"),
                                     SHAPE_LENGTH(ridge, radius, "half of its width along x"),
                                     SHAPE_LENGTH(ridge, height, "from the base to the top"),
                                     SHAPE_LENGTH(ridge, half_length, "half of its length along z"), PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const ridge *b = SHAPE_VALUES(ridge, s);
    const double r = fabs(x[0] - b->center[0]), y = x[1] - b->center[1];
    const double profile = mpm_shape_dome(b->radius, b->height, r, y);
    return mpm_shape_extrude(profile, b->half_length - fabs(x[2] - b->center[2]));
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const ridge *b = SHAPE_VALUES(ridge, s);
    const double down[3] = { b->radius, 0.0, b->half_length }, up[3] = { b->radius, b->height, b->half_length };
    mpm_shape_box_about(b->center, down, up, lo, hi);
}

const mpm_solid_kind mpm_shape_ridge = { .name = "ridge",
                                         .doc = "half an ellipse extruded along z, flat face down",
                                         .params = params,
                                         .inside = inside,
                                         .bounds = bounds };

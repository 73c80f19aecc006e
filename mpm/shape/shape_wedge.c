/* SPDX-License-Identifier: BSD-3-Clause */
/* Wedge: a triangle extruded along z, its base down, the middle of the base at `center`, its edge at height above it;
 * radius is half its width along x.  Signed distance exact. */
#include "mpm/shape/shape.h"

typedef struct {
    double center[3], radius, height, half_length;
} wedge;

static const base_param params[] = { SHAPE_POINT(wedge, center, 0, "middle of its base"),
                                     SHAPE_LENGTH(wedge, radius, "half of its width along x"),
                                     SHAPE_LENGTH(wedge, height, "from the base to the top"),
                                     SHAPE_LENGTH(wedge, half_length, "half of its length along z"), PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const wedge *b = SHAPE_VALUES(wedge, s);
    const double section[] = { -b->radius, 0.0, b->radius, 0.0, 0.0, b->height };
    const double profile = mpm_shape_polygon(3, section, x[0] - b->center[0], x[1] - b->center[1]);
    return mpm_shape_extrude(profile, b->half_length - fabs(x[2] - b->center[2]));
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const wedge *b = SHAPE_VALUES(wedge, s);
    const double down[3] = { b->radius, 0.0, b->half_length }, up[3] = { b->radius, b->height, b->half_length };
    mpm_shape_box_about(b->center, down, up, lo, hi);
}

const mpm_solid_kind mpm_shape_wedge = {
    .name = "wedge", .doc = "triangle extruded along z, base down", .params = params, .inside = inside, .bounds = bounds
};

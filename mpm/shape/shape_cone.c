/* SPDX-License-Identifier: BSD-3-Clause */
/* Cone: base down, its middle at `center`, tip above it.  Signed distance exact. */
#include "mpm/shape/shape.h"

typedef struct {
    double center[3], radius, height;
} cone;

static const base_param params[] = { SHAPE_POINT(cone, center, 0, "middle of its base"),
                                     SHAPE_LENGTH(cone, radius, "of the base"),
                                     SHAPE_LENGTH(cone, height, "from the base to the tip"), PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const cone *b = SHAPE_VALUES(cone, s);
    const double section[] = { -b->radius, 0.0, b->radius, 0.0, 0.0, b->height };
    const double r = hypot(x[0] - b->center[0], x[2] - b->center[2]);
    return mpm_shape_polygon(3, section, r, x[1] - b->center[1]);
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const cone *b = SHAPE_VALUES(cone, s);
    const double flat[3] = { b->radius, 0.0, b->radius }, round[3] = { b->radius, b->height, b->radius };
    mpm_shape_box_about(b->center, flat, round, lo, hi);
}

const mpm_solid_kind mpm_shape_cone = {
    .name = "cone", .doc = "cone about y on its base, tip up", .params = params, .inside = inside, .bounds = bounds
};

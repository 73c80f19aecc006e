/* SPDX-License-Identifier: BSD-3-Clause */
/* Cylinder: axis along y, middle of its lower face at `center`.  Signed distance exact. */
#include "mpm/shape/shape.h"

typedef struct {
    double center[3], radius, height;
} cylinder;

static const base_param params[] = { SHAPE_POINT(cylinder, center, 0, "middle of its lower face"),
                                     SHAPE_LENGTH(cylinder, radius, "of the section"),
                                     SHAPE_LENGTH(cylinder, height, "from the lower face to the upper"), PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const cylinder *b = SHAPE_VALUES(cylinder, s);
    const double r = hypot(x[0] - b->center[0], x[2] - b->center[2]);
    const double y = x[1] - b->center[1];
    return mpm_shape_extrude(b->radius - r, fmin(y, b->height - y));
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const cylinder *b = SHAPE_VALUES(cylinder, s);
    const double flat[3] = { b->radius, 0.0, b->radius }, round[3] = { b->radius, b->height, b->radius };
    mpm_shape_box_about(b->center, flat, round, lo, hi);
}

const mpm_solid_kind mpm_shape_cylinder = { .name = "cylinder",
                                            .doc = "cylinder along y on its lower face",
                                            .params = params,
                                            .inside = inside,
                                            .bounds = bounds };

/* SPDX-License-Identifier: BSD-3-Clause */
/* Sphere.  Signed distance exact. */
#include "mpm/shape/shape.h"

typedef struct {
    double center[3], radius;
} sphere;

static const base_param params[] = { SHAPE_POINT(sphere, center, 0, "its middle"),
                                     SHAPE_LENGTH(sphere, radius, "its radius"), PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const sphere *b = SHAPE_VALUES(sphere, s);
    const double dx = x[0] - b->center[0], dy = x[1] - b->center[1], dz = x[2] - b->center[2];
    return b->radius - sqrt(dx * dx + dy * dy + dz * dz);
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const sphere *b = SHAPE_VALUES(sphere, s);
    for (int k = 0; k < 3; k++) lo[k] = b->center[k] - b->radius, hi[k] = b->center[k] + b->radius;
}

const mpm_solid_kind mpm_shape_sphere = {
    .name = "sphere", .doc = "sphere about a middle", .params = params, .inside = inside, .bounds = bounds
};

/* SPDX-License-Identifier: BSD-3-Clause */
/* Box: between two corners.  Signed distance exact. */
#include "mpm/shape/shape.h"

typedef struct {
    double lo[3], hi[3];
} box;

static const base_param params[] = { SHAPE_POINT(box, lo, REQUIRED, "corner at the lower ends"),
                                     SHAPE_POINT(box, hi, REQUIRED, "corner at the upper ends"), PARAMS_END };

static double inside(const mpm_solid *s, const double x[3])
{
    const box *b = SHAPE_VALUES(box, s);
    double least = INFINITY, outside2 = 0.0;
    for (int k = 0; k < 3; k++) {
        const double d = fmin(x[k] - b->lo[k], b->hi[k] - x[k]);
        least = fmin(least, d);
        if (d < 0.0) outside2 += d * d;
    }
    return least >= 0.0 ? least : -sqrt(outside2);
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const box *b = SHAPE_VALUES(box, s);
    for (int k = 0; k < 3; k++) lo[k] = b->lo[k], hi[k] = b->hi[k];
}

static status check(const mpm_solid *s, const char *name)
{
    const box *b = SHAPE_VALUES(box, s);
    for (int k = 0; k < 3; k++)
        CHECK(b->lo[k] < b->hi[k], STATUS_BAD_INPUT, "%s: hi along %c, %g m, must lie above lo, %g m", name, "xyz"[k],
              b -> hi[k], b -> lo[k]);
    return status_ok();
}

const mpm_solid_kind mpm_shape_box = { .name = "box",
                                       .doc = "box between two corners",
                                       .params = params,
                                       .inside = inside,
                                       .bounds = bounds,
                                       .check = check };

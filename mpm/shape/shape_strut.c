/* SPDX-License-Identifier: BSD-3-Clause */
/* Strut: a cylinder between the middles of its two end faces, along any direction.  Signed distance exact. */
#include "mpm/shape/shape.h"

typedef struct {
    double from[3], to[3], radius;
} strut;

static const base_param params[] = { SHAPE_POINT(strut, from, REQUIRED, "middle of one end face"),
                                     SHAPE_POINT(strut, to, REQUIRED, "middle of the other"),
                                     SHAPE_LENGTH(strut, radius, "of its section"), PARAMS_END };

/* Its length and its direction. */
static double length_of(const strut *b, double n[3])
{
    for (int k = 0; k < 3; k++) n[k] = b->to[k] - b->from[k];
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    for (int k = 0; k < 3; k++) n[k] /= length;
    return length;
}

static double inside(const mpm_solid *s, const double x[3])
{
    const strut *b = SHAPE_VALUES(strut, s);
    double n[3], along = 0.0, off2 = 0.0;
    const double length = length_of(b, n);
    for (int k = 0; k < 3; k++) along += n[k] * (x[k] - b->from[k]);
    for (int k = 0; k < 3; k++) {
        const double off = x[k] - b->from[k] - along * n[k];
        off2 += off * off;
    }
    return mpm_shape_extrude(b->radius - sqrt(off2), fmin(along, length - along));
}

/* A disk with normal n reaches radius sqrt(1 - n_k^2) along axis k. */
static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const strut *b = SHAPE_VALUES(strut, s);
    double n[3];
    length_of(b, n);
    for (int k = 0; k < 3; k++) {
        const double reach = b->radius * hypot(n[(k + 1) % 3], n[(k + 2) % 3]);
        lo[k] = fmin(b->from[k], b->to[k]) - reach;
        hi[k] = fmax(b->from[k], b->to[k]) + reach;
    }
}

static status check(const mpm_solid *s, const char *name)
{
    const strut *b = SHAPE_VALUES(strut, s);
    double n[3];
    CHECK(length_of(b, n) > 0.0, STATUS_BAD_INPUT, "%s: from and to are the same point", name);
    return status_ok();
}

const mpm_solid_kind mpm_shape_strut = { .name = "strut",
                                         .doc = "cylinder between two points",
                                         .params = params,
                                         .inside = inside,
                                         .bounds = bounds,
                                         .check = check };

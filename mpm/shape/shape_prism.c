/* SPDX-License-Identifier: BSD-3-Clause */
/* Prism: a polygon extruded between two planes along an axis.
 *
 * The corners stand in order round the section, either sense, as (x, y) of a prism along z, (y, z) along x, (z, x)
 * along y.  Sides must not cross.  Signed distance exact. */
#include "mpm/shape/shape.h"

enum { CORNERS = 16 };

typedef struct {
    double lo, hi, along[3], corners[2 * CORNERS];
} prism;

static const base_param params[] = {
    SHAPE_PLANE(prism, lo, "lower end along the axis"), SHAPE_PLANE(prism, hi, "upper end along the axis"),
    PARAM_VEC3(prism, along, "1", 0, 0, 1, "the axis: one number is 1; all 0: z"),
    PARAM_PAIRS(prism, corners, "m", -SHAPE_FARTHEST, SHAPE_FARTHEST, "corners of the section, in order"), PARAMS_END
};

static int axis_of(const prism *b)
{
    return b->along[0] > 0.0 ? 0 : b->along[1] > 0.0 ? 1 : 2;
}

static double inside(const mpm_solid *s, const double x[3])
{
    const prism *b = SHAPE_VALUES(prism, s);
    const int k = axis_of(b), n = base_param_pairs(b->corners, CORNERS);
    const double profile = mpm_shape_polygon(n, b->corners, x[(k + 1) % 3], x[(k + 2) % 3]);
    return mpm_shape_extrude(profile, fmin(x[k] - b->lo, b->hi - x[k]));
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const prism *b = SHAPE_VALUES(prism, s);
    const int k = axis_of(b), n = base_param_pairs(b->corners, CORNERS);
    lo[k] = b->lo, hi[k] = b->hi;
    for (int q = 0; q < 2; q++) {
        const int u = (k + 1 + q) % 3;
        lo[u] = INFINITY, hi[u] = -INFINITY;
        for (int i = 0; i < n; i++)
            lo[u] = fmin(lo[u], b->corners[2 * i + q]), hi[u] = fmax(hi[u], b->corners[2 * i + q]);
    }
}

/* On which side of the line from a to b does c lie?  > 0: left. */
static double side(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static bool sides_cross(const double *a, const double *b, const double *c, const double *d)
{
    return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

static double area_of(int n, const double *corner)
{
    double twice = 0.0;
    for (int i = 0; i < n; i++) twice += side(corner, corner + 2 * i, corner + 2 * ((i + 1) % n));
    return 0.5 * twice;
}

static status check(const mpm_solid *s, const char *name)
{
    const prism *b = SHAPE_VALUES(prism, s);
    const int n = base_param_pairs(b->corners, CORNERS);
    CHECK(b->lo < b->hi, STATUS_BAD_INPUT, "%s: hi = %g m must lie above lo = %g m", name, b->hi, b->lo);
    const double *a = b->along;
    const double sum = a[0] + a[1] + a[2];
    CHECK((sum == 0.0 || sum == 1.0) && a[0] * a[1] + a[1] * a[2] + a[2] * a[0] == 0.0, STATUS_BAD_INPUT,
          "%s.along = [%g, %g, %g]: must be an axis, [1, 0, 0], [0, 1, 0] or [0, 0, 1]; turn it for others", name, a[0],
          a[1], a[2]);
    CHECK(n >= 3 && area_of(n, b->corners) != 0.0, STATUS_BAD_INPUT,
          "%s.corners: %d of them make no section, at least 3 that are not in line must be given", name, n);
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            CHECK(!sides_cross(b->corners + 2 * i, b->corners + 2 * ((i + 1) % n), b->corners + 2 * j,
                               b->corners + 2 * ((j + 1) % n)),
                  STATUS_BAD_INPUT, "%s.corners: the sides from corner %d and from corner %d cross", name, i + 1,
                  j + 1);
    return status_ok();
}

const mpm_solid_kind mpm_shape_prism = { .name = "prism",
                                         .doc = "polygon extruded between two planes along an axis",
                                         .params = params,
                                         .inside = inside,
                                         .bounds = bounds,
                                         .check = check };

/* SPDX-License-Identifier: BSD-3-Clause */
/* Repeat: copies of a solid at equal distances along the axes, the first where it stands: lattices.
 *
 * A copy that begins more than a pitch beyond x is farther from x than the copy between them.  So only the copies whose
 * bounds hold x, and the next on either side, are evaluated along each axis: of copies that overlap, all that do. */
#include "mpm/shape/shape.h"

typedef struct {
    double pitch[3], count[3];
} repeat;

static const base_param params[] = { SHAPE_POINT(repeat, pitch, 0, "from copy to copy along x, y, z"),
                                     PARAM_VEC3(repeat, count, "1", 1, 1, 10000, "copies along x, y, z, whole numbers"),
                                     PARAMS_END };

/* The first and the last copy to evaluate along axis k. */
static void range(const repeat *r, int k, double x, double lo, double hi, double ends[2])
{
    ends[0] = 0.0, ends[1] = r->count[k] - 1.0;
    if (ends[1] == 0.0) return;
    const double p = r->pitch[k], a = (x - hi) / p, b = (x - lo) / p;
    ends[0] = fmax(0.0, fmin(ends[1], floor(fmin(a, b))));
    ends[1] = fmax(0.0, fmin(ends[1], ceil(fmax(a, b))));
}

static double inside(const mpm_solid *s, const double x[3])
{
    const repeat *r = SHAPE_VALUES(repeat, s);
    const mpm_solid *part = mpm_solid_part(s, 0);
    double lo[3], hi[3], ends[3][2], largest = -INFINITY;
    mpm_solid_bounds(part, lo, hi);
    for (int k = 0; k < 3; k++) range(r, k, x[k], lo[k], hi[k], ends[k]);
    for (double i = ends[0][0]; i <= ends[0][1]; i++)
        for (double j = ends[1][0]; j <= ends[1][1]; j++)
            for (double l = ends[2][0]; l <= ends[2][1]; l++) {
                const double y[3] = { x[0] - i * r->pitch[0], x[1] - j * r->pitch[1], x[2] - l * r->pitch[2] };
                largest = fmax(largest, mpm_solid_inside(part, y));
            }
    return largest;
}

static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const repeat *r = SHAPE_VALUES(repeat, s);
    mpm_solid_bounds(mpm_solid_part(s, 0), lo, hi);
    for (int k = 0; k < 3; k++) {
        const double way = (r->count[k] - 1.0) * r->pitch[k];
        lo[k] += fmin(way, 0.0), hi[k] += fmax(way, 0.0);
    }
}

/* Copies along axis k that range takes at most. */
static double most_copies(const repeat *r, int k, double extent)
{
    return r->count[k] == 1.0 ? 1.0 : fmin(r->count[k], ceil(extent / fabs(r->pitch[k])) + 2.0);
}

static double looks(const mpm_solid *s)
{
    const repeat *r = SHAPE_VALUES(repeat, s);
    const mpm_solid *part = mpm_solid_part(s, 0);
    double lo[3], hi[3], n = mpm_solid_looks(part);
    mpm_solid_bounds(part, lo, hi);
    for (int k = 0; k < 3; k++) n *= most_copies(r, k, hi[k] - lo[k]);
    return n;
}

static status check(const mpm_solid *s, const char *name)
{
    static const double MOST_LOOKS = 10000.0;
    const repeat *r = SHAPE_VALUES(repeat, s);
    for (int k = 0; k < 3; k++) {
        const double n = r->count[k];
        CHECK(n == floor(n), STATUS_BAD_INPUT, "%s.count along %c = %g: must be a whole number", name, "xyz"[k], n);
        CHECK(n == 1.0 || r->pitch[k] != 0.0, STATUS_BAD_INPUT, "%s.pitch along %c = 0 m: %g copies must stand apart",
              name, "xyz"[k], n);
    }
    const double n = s->part[0] > 0 ? looks(s) : 0.0;
    CHECK(n <= MOST_LOOKS, STATUS_BAD_INPUT,
          "%s.pitch = %g %g %g m: so many copies overlap that up to %.3g shapes would be looked at for one place, at "
          "most "
          "%g: give a larger pitch or a smaller count",
          name, r->pitch[0], r->pitch[1], r->pitch[2], n, MOST_LOOKS);
    return status_ok();
}

const mpm_solid_kind mpm_shape_repeat = {
    .name = "repeat",
    .doc = "copies of a solid at equal distances along the axes; where they overlap, at most 10000 shapes at a place",
    .params = params,
    .parts = 1,
    .inside = inside,
    .bounds = bounds,
    .check = check,
    .looks = looks
};

/* SPDX-License-Identifier: BSD-3-Clause */
#include "mpm/shape/shape_lattice.h"

typedef struct {
    double lo[3], hi[3], cell, radius;
} lattice;

const base_param mpm_shape_lattice_params[] = {
    SHAPE_POINT(lattice, lo, REQUIRED, "corner of the box at the lower ends"),
    SHAPE_POINT(lattice, hi, REQUIRED, "corner of the box at the upper ends"),
    SHAPE_LENGTH(lattice, cell, "edge of a cubic cell"), SHAPE_LENGTH(lattice, radius, "of the struts"), PARAMS_END
};

/* Square of the distance to a strut's middle line, both in cells. */
static double distance2(const lattice_strut *b, const double u[3])
{
    double along = 0.0, length2 = 0.0, sum = 0.0;
    for (int k = 0; k < 3; k++) {
        const double d = b->to[k] - b->from[k];
        along += d * (u[k] - b->from[k]);
        length2 += d * d;
    }
    const double part = fmin(fmax(along / length2, 0.0), 1.0);
    for (int k = 0; k < 3; k++) {
        const double off = u[k] - b->from[k] - part * (b->to[k] - b->from[k]);
        sum += off * off;
    }
    return sum;
}

/* Outside, the distance to the nearest strut is exact; inside, near a node, a bound. */
double mpm_shape_lattice_inside(const mpm_solid *s, const double x[3], const lattice_strut *strut, int struts)
{
    const lattice *b = SHAPE_VALUES(lattice, s);
    double u[3], box = INFINITY, least = INFINITY;
    for (int k = 0; k < 3; k++) {
        const double t = (x[k] - b->lo[k]) / b->cell, in_cell = t - floor(t);
        u[k] = fmin(in_cell, 1.0 - in_cell);
        box = fmin(box, fmin(x[k] - b->lo[k], b->hi[k] - x[k]));
    }
    for (int i = 0; i < struts; i++) least = fmin(least, distance2(&strut[i], u));
    return fmin(box, b->radius - b->cell * sqrt(least));
}

void mpm_shape_lattice_bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const lattice *b = SHAPE_VALUES(lattice, s);
    for (int k = 0; k < 3; k++) lo[k] = b->lo[k], hi[k] = b->hi[k];
}

status mpm_shape_lattice_check(const mpm_solid *s, const char *name)
{
    const lattice *b = SHAPE_VALUES(lattice, s);
    for (int k = 0; k < 3; k++)
        CHECK(b->lo[k] < b->hi[k], STATUS_BAD_INPUT, "%s: hi along %c, %g m, must lie above lo, %g m", name, "xyz"[k],
              b -> hi[k], b -> lo[k]);
    CHECK(b->radius < 0.25 * b->cell, STATUS_BAD_INPUT,
          "%s.radius = %g m: must be below a quarter of the cell, %g m: thicker struts leave no lattice", name,
          b->radius, b->cell);
    return status_ok();
}

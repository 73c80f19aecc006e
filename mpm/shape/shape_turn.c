/* SPDX-License-Identifier: BSD-3-Clause */
/* Turn: a solid turned by an angle about an axis through a point, by the right-hand rule. */
#include "mpm/shape/shape.h"

typedef struct {
    double axis[3], angle, about[3];
} turn;

static const base_param params[] = {
    PARAM_VEC3(turn, axis, "1", REQUIRED, -SHAPE_FARTHEST, SHAPE_FARTHEST, "direction of the axis, of any length"),
    PARAM_DOUBLE(turn, angle, "rad", REQUIRED, -1e3, 1e3, "right-handed about the axis"),
    SHAPE_POINT(turn, about, 0, "a point of the axis"), PARAMS_END
};

static double length_of(const double a[3])
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/* y = about + cos d + sin (n x d) + (1 - cos) n (n . d),  d = x - about,  n along the axis            (Rodrigues) */
static void turned(const turn *t, double angle, const double x[3], double y[3])
{
    const double c = cos(angle), sine = sin(angle), length = length_of(t->axis);
    double n[3], d[3], along = 0.0;
    for (int k = 0; k < 3; k++) n[k] = t->axis[k] / length, d[k] = x[k] - t->about[k], along += n[k] * d[k];
    for (int k = 0; k < 3; k++) {
        const int u = (k + 1) % 3, v = (k + 2) % 3;
        y[k] = t->about[k] + c * d[k] + sine * (n[u] * d[v] - n[v] * d[u]) + (1.0 - c) * along * n[k];
    }
}

static double inside(const mpm_solid *s, const double x[3])
{
    const turn *t = SHAPE_VALUES(turn, s);
    double y[3];
    turned(t, -t->angle, x, y);
    return mpm_solid_inside(mpm_solid_part(s, 0), y);
}

/* The box that holds the turned corners of its part's box. */
static void bounds(const mpm_solid *s, double lo[3], double hi[3])
{
    const turn *t = SHAPE_VALUES(turn, s);
    double from[2][3];
    mpm_solid_bounds(mpm_solid_part(s, 0), from[0], from[1]);
    for (int k = 0; k < 3; k++) lo[k] = INFINITY, hi[k] = -INFINITY;
    for (int corner = 0; corner < 8; corner++) {
        const double x[3] = { from[corner & 1][0], from[corner >> 1 & 1][1], from[corner >> 2][2] };
        double y[3];
        turned(t, t->angle, x, y);
        for (int k = 0; k < 3; k++) lo[k] = fmin(lo[k], y[k]), hi[k] = fmax(hi[k], y[k]);
    }
}

static status check(const mpm_solid *s, const char *name)
{
    CHECK(length_of(SHAPE_VALUES(turn, s)->axis) > 0.0, STATUS_BAD_INPUT, "%s.axis = [0, 0, 0]: has no direction",
          name);
    return status_ok();
}

const mpm_solid_kind mpm_shape_turn = { .name = "turn",
                                        .doc = "a solid turned about an axis through a point",
                                        .params = params,
                                        .parts = 1,
                                        .inside = inside,
                                        .bounds = bounds,
                                        .check = check };
